#pragma once
// What has broken: bonds, and where along an axis; the area of an interface. Bonds that were broken from the start
// (<defects>) have not broken.

#include <algorithm>
#include <string>
#include <vector>

#include "core/domain/flaws.hpp"

namespace beadwork {

struct Broken {
  std::vector<Real> places;  ///< middles along the axis [m], in the order of the breaks
  Real breakable = 0;        ///< bonds of the families that were sound at the start

  Broken(const Domain& domain, const std::vector<std::string>& families, int axis) {
    std::vector<char> counts;
    for (const BondTable* table : domain.families()) {
      counts.push_back(std::find(families.begin(), families.end(), table->name()) != families.end());
      if (counts.back()) breakable += static_cast<Real>(table->size() - flaws(domain, *table));
    }
    for (const Break& b : domain.breaks().breaks)
      if (counts[static_cast<std::size_t>(b.family)]) places.push_back(b.place[axis]);
  }
};

/// Areas of the contacts of an interface [m2].
struct LostArea {
  Real all = 0, damaged = 0, open = 0;

  /// A contact that has left its pair tells no damage any more.
  LostArea(const BondTable& table, View<const Real> area, View<const Real> damage) {
    for (Index b = 0; b < table.size(); ++b) {
      const Real lost = table.state()[b] == State::broken ? 1 : damage[b];
      all += area[b];
      if (lost > 0) damaged += area[b];
      if (lost >= 1) open += area[b];
    }
  }
};

}  // namespace beadwork
