#include "core/domain/pair_list.hpp"

#include <algorithm>

#include "core/domain/domain.hpp"
#include "core/domain/joined.hpp"

namespace beadwork {

void rename_rows(PairList& pairs, std::span<const Index> row_of) {
  for (auto& [first, second] : pairs) {
    const Index a = row_of[static_cast<std::size_t>(first)], b = row_of[static_cast<std::size_t>(second)];
    first = std::min(a, b), second = std::max(a, b);
  }
  std::sort(pairs.begin(), pairs.end());
}

std::vector<Index> chains(const Domain& domain) {
  if (domain.pairs().empty()) return {};
  Joined chain_of(domain.size());
  std::vector<char> listed(static_cast<std::size_t>(domain.size()), 0);
  for (const auto& [name, pairs] : domain.pairs())
    for (const auto& [first, second] : pairs) {
      chain_of.join(first, second);
      listed[static_cast<std::size_t>(first)] = listed[static_cast<std::size_t>(second)] = 1;
    }
  std::vector<Index> chain(static_cast<std::size_t>(domain.size()), -1);
  for (Index row = 0; row < domain.size(); ++row)
    if (listed[static_cast<std::size_t>(row)]) chain[static_cast<std::size_t>(row)] = chain_of.lowest(row);
  return chain;
}

}  // namespace beadwork
