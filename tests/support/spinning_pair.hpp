#pragma once
// Two bonded elements that go around one another for ever, by the laws and the steps of the program.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/mechanics/beam.hpp"
#include "core/mechanics/verlet.hpp"

namespace beadwork::test {

class SpinningPair {
 public:
  static constexpr int steps_of_a_turn = 200;
  static constexpr Real dt = 2 * std::numbers::pi / steps_of_a_turn;  ///< one turn takes 2 pi

  /// Each end on its circle at the stretch where the pull keeps it there: k (l - 1) = m l/2.
  SpinningPair() {
    const Real l = 1 / (1 - mass / (2 * rest_.axial));
    x1_ = Vec3(-l / 2, 0, 0), x2_ = Vec3(l / 2, 0, 0);
    v1_ = Vec3(0, -l / 2, 0), v2_ = Vec3(0, l / 2, 0);
    on_ = beam_wrench(rest_, x2_ - x1_, q1_, q2_);
  }

  bool is_stable() const { return dt < 2 / std::sqrt(2 * rest_.axial / mass); }
  Real energy() const {
    return 0.5 * (mass * (v1_.squaredNorm() + v2_.squaredNorm()) + inertia * (w1_.squaredNorm() + w2_.squaredNorm())) +
           beam_energy(rest_, x2_ - x1_, q1_, q2_).total();
  }
  Vec3 spin() const { return mass * (cross(x1_, v1_) + cross(x2_, v2_)) + inertia * (w1_ + w2_); }
  /// What has left the plane.
  Real tilt() const { return std::max({std::abs(x1_[2]), std::abs(x2_[2]), std::abs(w1_[0]), std::abs(w1_[1])}); }
  /// How far a quaternion's squared length is from 1.
  Real stretch_of_quaternions() const {
    return std::max(std::abs(squared_norm(q1_) - 1), std::abs(squared_norm(q2_) - 1));
  }

  void turn_once() {
    for (int step = 0; step < steps_of_a_turn; ++step) {
      x1_ = advance<Real>(x1_, v1_, -on_.force / mass, dt);
      x2_ = advance<Real>(x2_, v2_, on_.force / mass, dt);
      q1_ = turn<Real>(q1_, w1_, on_.torque1 / inertia, dt);
      q2_ = turn<Real>(q2_, w2_, on_.torque2 / inertia, dt);
      const auto next = beam_wrench(rest_, x2_ - x1_, q1_, q2_);
      v1_ = correct<Real>(v1_, -on_.force / mass, -next.force / mass, 1, dt);
      v2_ = correct<Real>(v2_, on_.force / mass, next.force / mass, 1, dt);
      w1_ = correct<Real>(w1_, on_.torque1 / inertia, next.torque1 / inertia, 1, dt);
      w2_ = correct<Real>(w2_, on_.torque2 / inertia, next.torque2 / inertia, 1, dt);
      on_ = next;
    }
  }

 private:
  static constexpr Real mass = 1, inertia = 0.1;
  BeamRest<Real> rest_ = round_beam(Vec3(1, 0, 0), 100, 0.3, 0.4);
  Vec3 x1_, x2_, v1_, v2_, w1_{0, 0, 1}, w2_{0, 0, 1};
  Quat q1_ = identity(), q2_ = identity();
  Wrench<Real> on_;
};

}  // namespace beadwork::test
