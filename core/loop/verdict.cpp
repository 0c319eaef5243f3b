#include "core/loop/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace beadwork {

namespace {

struct Stretch {
  Index begin, end;
};

[[noreturn]] void refuse_number(const Domain& domain, const BondTable* table, Index row) {
  const auto id = domain.elements().column("id").view<Index>();
  throw std::runtime_error(
      table ? fmt::format("the utilisation of bond {} of '{}', between elements {} and {}, is no number",
                          table->id()[row], table->name(), id[table->first()[row]], id[table->second()[row]])
            : fmt::format("the utilisation of element {} is no number", id[row]));
}

// Each stretch of rows by itself, then the stretches in order: threads change nothing.
template <class Use>
void read(const Domain& domain, BondTable* table, const std::vector<Stretch>& stretches, const Use& use_of,
          Verdict& all) {
  std::vector<Verdict> parts(stretches.size());
  each_shared(static_cast<Index>(stretches.size()), [&](Index s) {
    Verdict part;
    const Stretch& stretch = stretches[static_cast<std::size_t>(s)];
    for (Index row = stretch.begin; row < stretch.end; ++row) {
      const Real use = use_of(row);
      if (use > part.highest.utilisation) part.highest = {table, row, use};
      if (use < 1) continue;
      part.fallen.push_back({table, row, use});
    }
    parts[static_cast<std::size_t>(s)] = std::move(part);
  });
  for (const Verdict& part : parts) {
    for (const Judged& each : part.fallen)
      if (std::isnan(each.utilisation)) refuse_number(domain, table, each.row);
    all.fallen.insert(all.fallen.end(), part.fallen.begin(), part.fallen.end());
    if (part.highest.utilisation > all.highest.utilisation) all.highest = part.highest;
  }
}

}  // namespace

Verdict read_verdict(const Failure& failure, Domain& domain, std::span<const char> held) {
  const std::string& name = failure.utilisation.field().name;
  const bool some_spared = failure.spares_some();
  Verdict all;
  std::vector<Stretch> stretches;
  if (failure.judges_elements()) {
    const auto utilisation = domain.elements().column(name).view<Real>();
    for (Index row = 0; row < domain.size(); row += 1024)
      stretches.push_back({row, std::min(row + 1024, domain.size())});
    const auto use_of = [&](Index row) {
      if (!held[static_cast<std::size_t>(row)] || (some_spared && failure.spares(row))) utilisation[row] = 0;
      return Real(utilisation[row]);
    };
    read(domain, nullptr, stretches, use_of, all);
    return all;
  }
  for (const std::string& family : failure.families()) {
    BondTable* table = domain.find_family(family);
    stretches.clear();
    for (const Chunk& chunk : table->chunks()) stretches.push_back({chunk.begin, chunk.live_end});
    const auto utilisation = table->rows().column(name).view<Real>();
    const auto use_of = [&](Index row) {
      if (some_spared && failure.spares(*table, row)) utilisation[row] = 0;
      return Real(utilisation[row]);
    };
    read(domain, table, stretches, use_of, all);
  }
  return all;
}

}  // namespace beadwork
