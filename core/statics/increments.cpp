#include "core/statics/increments.hpp"

#include <cmath>

namespace beadwork {

std::optional<Real> time_of_displacement(std::span<const Constraint> constraints, Real now, Real displacement) {
  const auto gone = [&](Real time) {
    Real most = 0;
    for (const Constraint& c : constraints)
      if (c.pulls()) most = std::max(most, std::abs(c.at(time).displacement - c.at(now).displacement));
    return most;
  };
  // whatever the scale of the loads' course is
  Real low = 0, high = 1e-12;
  while (gone(now + high) < displacement) {
    low = high;
    if ((high *= 2) > 1e12) return std::nullopt;
  }
  for (int k = 0; k < 60 && low < high; ++k) {
    const Real middle = 0.5 * (low + high);
    (gone(now + middle) < displacement ? low : high) = middle;
  }
  return now + high;
}

}  // namespace beadwork
