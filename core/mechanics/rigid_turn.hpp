#pragma once
// What stands on a rigid body that turns about an axis of the coordinates through a fixed point: its place, velocity
// and acceleration by the angle and its rates. Places follow from where the turn began, whatever steps led there.
// docs/theory/verlet.md

#include <cmath>

#include "core/mechanics/rotation.hpp"

namespace beadwork {

/// Of an angle: cosine less one, to all digits however small the angle, and sine.
struct Turned {
  Real less, sine;
};

/// Any angle [rad]. Quarter turns are taken off in two parts, of which the first is exact for half a million of them;
/// what is left goes through the series of `increment`, whose bits no library chooses.
inline Turned turned(Real angle) {
  constexpr Real quarter = 1.57079632673412561417, rest = 6.07710050650619224932e-11;  // of pi/2
  const Real quarters = std::nearbyint(angle / (quarter + rest));
  const Real left = (angle - quarters * quarter) - quarters * rest;
  const Quat half = increment<Real>(Vec3(left, 0, 0));
  const Real less = -2 * half.v[0] * half.v[0], sine = 2 * half.v[0] * half.w;
  switch (static_cast<int>(std::fmod(quarters, 4) + 4) % 4) {
    case 0: return {less, sine};
    case 1: return {-sine - 1, 1 + less};
    case 2: return {-less - 2, -sine};
    default: return {sine - 1, -less - 1};
  }
}

/// About axis 0 x, 1 y or 2 z.
class Circles {
 public:
  Circles(int axis, const Vec3& about) : axis_(axis), p_((axis + 1) % 3), q_((axis + 2) % 3), about_(about) {}

  int axis() const { return axis_; }
  /// From the axis to a place, across the axis.
  Vec3 arm(const Vec3& place) const {
    Vec3 arm = place - about_;
    arm[axis_] = 0;
    return arm;
  }
  Vec3 place(const Vec3& from, const Turned& by) const {
    const Vec3 r = arm(from);
    return from + by.less * r + by.sine * across(r);
  }
  Vec3 velocity(const Vec3& arm, Real w) const { return w * across(arm); }
  /// Angular and centripetal.
  Vec3 acceleration(const Vec3& arm, Real w, Real alpha) const { return alpha * across(arm) - w * w * arm; }
  Real torque(const Vec3& arm, const Vec3& force) const { return arm[p_] * force[q_] - arm[q_] * force[p_]; }

 private:
  // The axis times the arm: a quarter turn.
  Vec3 across(const Vec3& arm) const {
    Vec3 turned = Vec3::Zero();
    turned[p_] = -arm[q_];
    turned[q_] = arm[p_];
    return turned;
  }
  int axis_, p_, q_;
  Vec3 about_;
};

}  // namespace beadwork
