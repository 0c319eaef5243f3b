#pragma once
// The stiffness that a law has at a state, found from the law itself: it is run with numbers that carry their slopes.

#include "core/bonds/ends.hpp"
#include "core/mechanics/dual.hpp"
#include "core/mechanics/stiffness.hpp"

namespace beadwork {

/// One bond, for a law that is differentiated: its columns are constants, and nothing is written.
template <int N>
struct OneDual {
  using Number = Dual<N>;
  One one;

  Number operator()(const View<const Real>& column) const { return one(column); }
  Vec<Number> operator()(const View<const Vec3>& column) const {
    const Vec3 v = one(column);
    return {v[0], v[1], v[2]};
  }
  Quaternion<Number> operator()(const View<const Quat>& column) const {
    const Quat q = one(column);
    return {q.w, {q.v[0], q.v[1], q.v[2]}};
  }
  template <class Column>
  void store(const Column&, const Number&) const {}
  template <class Mask>
  void flag(const Mask&) const {}
};

/// Loads = -K moves at this state, rows and columns (x1, theta1, x2, theta2): the derivative of the law's `act` at fixed
/// history and fixed velocities. Not symmetric where moments of present forces turn with the ends.
template <class Law>
Matrix12 consistent_stiffness(const Law& law, const One& at, const EndsOf<Law, Real>& ends) {
  using Number = Dual<12>;
  EndsOf<Law, Number> moved;
  for (int c = 0; c < 3; ++c) {
    moved.apart[c] = Number::coordinate(ends.apart[c], 6 + c);
    moved.apart[c].slope[static_cast<std::size_t>(c)] = -1;
  }
  if constexpr (Law::turns) {
    // q' = (1, dtheta/2) q: a small turn seen from the world
    const auto turned = [](const Quat& q, std::size_t first) {
      const Mat3 by = 0.5 * (q.w * Mat3::Identity() - stiffness::skew(q.v));
      Quaternion<Number> result{q.w, {q.v[0], q.v[1], q.v[2]}};
      for (int k = 0; k < 3; ++k) {
        result.w.slope[first + static_cast<std::size_t>(k)] = -0.5 * q.v[k];
        for (int c = 0; c < 3; ++c) result.v[c].slope[first + static_cast<std::size_t>(k)] = by(c, k);
      }
      return result;
    };
    moved.q1 = turned(ends.q1, 3);
    moved.q2 = turned(ends.q2, 9);
  }
  if constexpr (sees_rates<Law>()) {
    const auto constant = [](const Vec3& v) { return Vec<Number>{v[0], v[1], v[2]}; };
    moved.v1 = constant(ends.v1), moved.v2 = constant(ends.v2);
    if constexpr (Law::turns) moved.w1 = constant(ends.w1), moved.w2 = constant(ends.w2);
  }
  const Wrench<Number> wrench = law.template act<Pass{}>(OneDual<12>{at}, moved);
  Matrix12 k;
  for (int c = 0; c < 3; ++c)
    for (int j = 0; j < 12; ++j) {
      const auto slope = static_cast<std::size_t>(j);
      k(c, j) = wrench.force[c].slope[slope];
      k(3 + c, j) = -wrench.torque1[c].slope[slope];
      k(6 + c, j) = -wrench.force[c].slope[slope];
      k(9 + c, j) = -wrench.torque2[c].slope[slope];
    }
  return k;
}

}  // namespace beadwork
