#pragma once
// How fast the motion itself is, against the step: the Rayleigh quotient of the stiffness in the direction in which the
// elements move, found from the forces of two steps alone and so without any tangent that a bond law states.
// docs/theory/verlet.md

#include <vector>

#include "core/base/sums.hpp"
#include "core/dynamics/grips.hpp"
#include "core/dynamics/motion.hpp"

namespace beadwork {

class RayleighQuotient {
 public:
  /// Before the step.
  void remember(const Motion& all) {
    before_.resize(static_cast<std::size_t>(all.count) * 2);
    for (Index i = 0; i < all.count; ++i) {
      before_[static_cast<std::size_t>(i) * 2] = all.force[i];
      if (all.torque) before_[static_cast<std::size_t>(i) * 2 + 1] = all.torque[i];
    }
  }
  bool remembers() const { return !before_.empty(); }

  /// After it, with the new forces and the velocities at half of it: dt^2/4 (-dF.dx)/(dx.M dx). In a stable run it
  /// stays below 1, for it is no larger than for the fastest mode. What is prescribed has no force of its own, but its
  /// inertia counts.
  Real of_step(const Motion& all, const Grips& grips, Real dt) {
    const auto opposed = [&](const View<Vec3>& rate, const View<Vec3>& load, Index i, int first_axis) {
      const Vec3& before = before_[static_cast<std::size_t>(i) * 2 + static_cast<std::size_t>(first_axis / 3)];
      Real sum = 0;
      for (int axis = 0; axis < 3; ++axis)
        if (!grips.drives(i, first_axis + axis)) sum -= (load.at(i, axis) - before[axis]) * rate.at(i, axis);
      return sum;
    };
    const Real stiff = fixed_sum(all.count, [&](Index i) {
      Real sum = opposed(all.velocity, all.force, i, 0);
      if (all.spin) sum += opposed(all.spin, all.torque, i, 3);
      return sum;
    });
    const Real inert = fixed_sum(all.count, [&](Index i) {
      Real sum = all.mass[i] * all.velocity[i].squaredNorm();
      if (all.spin) sum += all.inertia[i] * all.spin[i].squaredNorm();
      return sum;
    });
    before_.clear();
    return inert > 0 ? 0.25 * dt * stiff / inert : 0;
  }

 private:
  std::vector<Vec3> before_;  // force and torque of each element
};

}  // namespace beadwork
