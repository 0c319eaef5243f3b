#include "core/domain/flaws.hpp"

#include <algorithm>

namespace beadwork {

Index flaws(const Domain& domain, const BondTable& table) {
  Index broken = 0;
  for (Index row = 0; row < table.size(); ++row) broken += table.state()[row] == State::broken;
  const auto& breaks = domain.breaks().breaks;
  const auto logged = std::count_if(breaks.begin(), breaks.end(), [&](const Break& b) {
    return domain.families()[static_cast<std::size_t>(b.family)] == &table;
  });
  return broken - static_cast<Index>(logged);
}

}  // namespace beadwork
