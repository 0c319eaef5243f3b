#pragma once
// Values as colours: one scale for a field over all frames that are shown, so that they can be compared.

#include <string>
#include <vector>

#include "workbench/report/canvas.hpp"

namespace beadwork::report {

struct ColorScale {
  Real low = 0, high = 0;
  bool below = false, above = false;  ///< some values lie beyond low, or high, and have the colour of that end

  /// Two colours that part at zero where both signs occur, else dark to light. Both are told apart by lightness too.
  bool diverging() const { return low < 0 && high > 0; }
  bool constant() const { return !(high > low); }
  Color operator()(Real value) const;  ///< grey where the value is not a number
  /// "linear-gradient(to right, #440154 0%, ...)"
  std::string css() const;
};

/// Covers the values but for the lowest and highest half of a percent, so that one splinter does not make all others
/// alike; equal room on both sides of zero where both signs occur.
ColorScale scale_over(std::vector<Real> values);

/// "#rrggbb"
std::string css(Color);

}  // namespace beadwork::report
