#pragma once
// Prescribed motion: a velocity that sets in smoothly, and a velocity given by a table. Both with exact
// integrals, so that a place prescribed at time t does not depend on the steps that led there.

#include <limits>
#include <vector>

#include "core/base/prescribed_motion.hpp"

namespace beadwork {

/// s(x) = 10 x^3 - 15 x^4 + 6 x^5: from 0 to 1 with no slope and no curvature at either end.
inline Real smooth_step(Real x) {
  if (x <= 0) return 0;
  if (x >= 1) return 1;
  return x * x * x * (10 + x * (-15 + 6 * x));
}

/// ds/dx.
inline Real smooth_step_slope(Real x) {
  if (x <= 0 || x >= 1) return 0;
  const Real y = x * (1 - x);
  return 30 * y * y;
}

/// The integral of s from 0 to x.
inline Real smooth_step_integral(Real x) {
  if (x <= 0) return 0;
  if (x >= 1) return x - 0.5;
  return x * x * x * x * (2.5 + x * (-3 + x));
}

/// A velocity that grows from 0 to `velocity` over the time `rise` and then stays; rise 0 sets it in at once.
struct SmoothRamp {
  Real velocity;
  Real rise;

  PrescribedMotion at(Real t) const {
    if (t <= 0) return {0, rise > 0 ? 0 : velocity, 0};
    if (!(rise > 0)) return {velocity * t, velocity, 0};
    const Real x = t / rise;
    return {velocity * rise * smooth_step_integral(x), velocity * smooth_step(x),
            velocity * smooth_step_slope(x) / rise};
  }
  /// Farthest that it ever gets from where it has been.
  Real reach() const { return velocity == 0 ? 0 : std::numeric_limits<Real>::infinity(); }
};

/// Velocity by straight lines between rows (time, velocity), held before the first and after the last.
class VelocityTable {
 public:
  struct Row {
    Real time, velocity;
  };

  /// Rows in increasing time, at least one.
  explicit VelocityTable(std::vector<Row> rows);

  /// Displacement counts from the first row's time; before it, the first velocity runs backwards.
  PrescribedMotion at(Real t) const;
  /// Farthest that it ever gets, from the first row's time on, from where it has been; infinite if it ends in motion.
  Real reach() const;

 private:
  std::vector<Row> rows_;
  std::vector<Real> travelled_;  ///< displacement at each row
};

}  // namespace beadwork
