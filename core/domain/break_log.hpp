#pragma once
// Every bond that ever broke: when, which, how, where, and the energy that went with it. Rows are only ever appended.

#include <string>
#include <vector>

#include "core/base/types.hpp"

namespace beadwork {

struct Break {
  Real time = 0;  ///< [s]
  std::int64_t step = 0;
  Index family = 0;           ///< place of the family in Domain::families
  Index bond = 0;             ///< stable id
  Index mode = 0;             ///< place of the mode's name in BreakLog::modes
  Vec3 place = zero<Vec3>();  ///< middle of the bond [m]
  Real energy = 0;            ///< released with this break [J]
  Index element = -1;         ///< stable id of the element that failed; -1 where it was the bond
};

struct BreakLog {
  std::vector<std::string> modes;
  std::vector<Break> breaks;

  /// Number of the mode of this name, which is made if it is new.
  Index mode(const std::string& name) {
    for (std::size_t m = 0; m < modes.size(); ++m)
      if (modes[m] == name) return static_cast<Index>(m);
    modes.push_back(name);
    return static_cast<Index>(modes.size()) - 1;
  }
};

}  // namespace beadwork
