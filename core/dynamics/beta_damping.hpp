#pragma once
// What beta below 1 takes: (1 - beta)/(2 beta^2) m |v' - v|^2 a step.   docs/theory/verlet.md

#include <vector>

#include "core/base/sums.hpp"
#include "core/dynamics/grips.hpp"
#include "core/dynamics/motion.hpp"

namespace beadwork {

class BetaDamping {
 public:
  /// Before the step.
  void remember(const Motion& all) {
    before_.resize(static_cast<std::size_t>(all.count) * 2);
    for (Index i = 0; i < all.count; ++i) {
      before_[static_cast<std::size_t>(i) * 2] = all.velocity[i];
      if (all.spin) before_[static_cast<std::size_t>(i) * 2 + 1] = all.spin[i];
    }
  }

  /// After it: energy taken by the step [J].
  Real taken(const Motion& all, const Grips& grips, Real beta) const {
    const auto change = [&](const View<Vec3>& rate, Index i, int first_axis) {
      const Vec3& before = before_[static_cast<std::size_t>(i) * 2 + static_cast<std::size_t>(first_axis / 3)];
      Real squared = 0;
      for (int axis = 0; axis < 3; ++axis)
        if (!grips.drives(i, first_axis + axis))
          squared += (rate.at(i, axis) - before[axis]) * (rate.at(i, axis) - before[axis]);
      return squared;
    };
    return (1 - beta) / (2 * beta * beta) * fixed_sum(all.count, [&](Index i) {
             Real squared = all.mass[i] * change(all.velocity, i, 0);
             if (all.spin) squared += all.inertia[i] * change(all.spin, i, 3);
             return squared;
           });
  }

 private:
  std::vector<Vec3> before_;  // velocity and spin of each element
};

}  // namespace beadwork
