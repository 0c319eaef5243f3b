#pragma once
// What an explicit mover moves: the elements' places and turns, their rates and loads, and what they weigh.

#include "core/plugin/kinds.hpp"

namespace beadwork {

struct Motion {
  Index count = 0;
  View<Vec3> place, velocity, force;
  View<Quat> orientation;  ///< with spin, torque and inertia: null where nothing turns
  View<Vec3> spin, torque;
  View<const Real> mass, inertia, radius;
};

}  // namespace beadwork
