#pragma once
// Which bonds have broken, and where along an axis: those broken from the start (<defects>) do not count.

#include <algorithm>
#include <string>
#include <vector>

#include "core/domain/domain.hpp"

namespace beadwork {

struct Broken {
  std::vector<Real> places;  ///< middles along the axis [m], in the order of the breaks
  Real sound = 0;            ///< bonds of the families that were there to break

  Broken(const Domain& domain, const std::vector<std::string>& families, int axis) {
    std::vector<char> counts;
    for (const BondTable* table : domain.families()) {
      counts.push_back(std::find(families.begin(), families.end(), table->name()) != families.end());
      if (counts.back()) sound += static_cast<Real>(table->size());
    }
    const BreakLog& log = domain.breaks();
    for (const Break& b : log.breaks) {
      if (!counts[static_cast<std::size_t>(b.family)]) continue;
      if (log.modes[static_cast<std::size_t>(b.mode)] == flaw_mode)
        sound -= 1;
      else
        places.push_back(b.place[axis]);
    }
  }
};

}  // namespace beadwork
