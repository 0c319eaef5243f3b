#include "core/domain/bodies.hpp"

#include <algorithm>
#include <unordered_set>

#include "core/domain/joined.hpp"

namespace beadwork {

namespace {

std::unordered_set<Index> broken_later(const Domain& domain, const BondTable& table, std::int64_t when) {
  std::unordered_set<Index> ids;
  for (const Break& b : domain.breaks().breaks)
    if (b.step > when && domain.families()[static_cast<std::size_t>(b.family)] == &table) ids.insert(b.bond);
  return ids;
}

}  // namespace

std::vector<Index> bodies(const Domain& domain, std::span<const BondTable* const> tables, std::int64_t when) {
  Joined body(domain.size());
  for (const BondTable* table : tables) {
    if (table->is_of_contacts()) continue;  // what touches does not hang together
    const auto later = broken_later(domain, *table, when);
    for (Index b = 0; b < table->size(); ++b) {
      if (table->state()[b] == State::broken && !later.contains(table->id()[b])) continue;
      body.join(table->first()[b], table->second()[b]);
    }
  }
  std::vector<Index> lowest(static_cast<std::size_t>(domain.size()));
  for (Index row = 0; row < domain.size(); ++row) lowest[static_cast<std::size_t>(row)] = body.lowest(row);
  return lowest;
}

Set without_debris(const Set& set, const std::vector<Index>& body) {
  std::vector<Index> members(body.size(), 0);
  for (const Index of : body) ++members[static_cast<std::size_t>(of)];
  const auto size = [&](Index row) { return members[static_cast<std::size_t>(body[static_cast<std::size_t>(row)])]; };
  Index largest = 1;
  for (const Index row : set) largest = std::max(largest, size(row));
  if (largest == 1) return set;
  Set kept;
  std::copy_if(set.begin(), set.end(), std::back_inserter(kept),
               [&](Index row) { return size(row) > 1 && size(row) >= largest / 100; });
  return kept;
}

}  // namespace beadwork
