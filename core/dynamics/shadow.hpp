#pragma once
// What velocity Verlet keeps is not the energy but the energy less dt^2/8 sum |F|^2/m: near the stable limit the
// balance swings by as much as the fastest modes hold, and nothing is wrong. docs/theory/verlet.md

#include "core/base/sums.hpp"
#include "core/dynamics/grips.hpp"
#include "core/dynamics/motion.hpp"

namespace beadwork {

/// dt^2/8 sum |F|^2/m over what is free to move, torques likewise [J]. Local damping books its power with velocities,
/// which widens the swing by up to (1 + alpha)/(1 - alpha).
inline Real shadow(const Motion& all, const Grips& grips, Real dt, Real local_damping) {
  const auto free = [](const Vec3& load, unsigned held) {
    Real squared = 0;
    for (int axis = 0; axis < 3; ++axis)
      if (!(held >> axis & 1)) squared += load[axis] * load[axis];
    return squared;
  };
  const Real twice_power = fixed_sum(all.count, [&](Index i) {
    Real sum = free(all.force[i], grips.driven(i)) / all.mass[i];
    if (all.spin) sum += free(all.torque[i], grips.driven(i) >> 3) / all.inertia[i];
    return sum;
  });
  return dt * dt / 8 * twice_power * (1 + local_damping) / (1 - local_damping);
}

}  // namespace beadwork
