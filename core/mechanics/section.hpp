#pragma once
// Sections of prismatic bars, square or round: what they have to say to tension, bending and torsion.
// Timoshenko and Goodier, Theory of Elasticity, 3rd ed., sections 102 and 109

#include <limits>
#include <numbers>
#include <span>

#include "core/base/types.hpp"

namespace beadwork {

struct Section {
  Real area;           ///< [m^2]
  Real second_moment;  ///< about an axis through its centre, I = M/(E kappa) [m^4]
  Real torsion;        ///< J = T/(G twist); of a square the section warps [m^4]
};

/// By the area, as I and J of a given shape go with its square.
inline Section square_section(Real area) {
  constexpr Real twisted = 0.1405770149551555;  // Saint-Venant: 1/3 - 64/pi^5 sum tanh(n pi/2)/n^5, n odd
  return {area, area * area / 12, twisted * area * area};
}
inline Section round_section(Real area) {
  return {area, area * area / (4 * std::numbers::pi), area * area / (2 * std::numbers::pi)};
}

/// When a quantity first passes `level` on its way up, by straight lines between the times; NaN if it never does.
inline Real passing_time(std::span<const Real> time, std::span<const Real> value, Real level) {
  for (std::size_t k = 1; k < value.size() && k < time.size(); ++k)
    if (value[k - 1] < level && value[k] >= level)
      return time[k - 1] + (time[k] - time[k - 1]) * (level - value[k - 1]) / (value[k] - value[k - 1]);
  return std::numeric_limits<Real>::quiet_NaN();
}

}  // namespace beadwork
