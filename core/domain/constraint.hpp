#pragma once
// What is prescribed of the elements: rows (element, degree of freedom, coefficient) = value(t).

#include <functional>
#include <limits>
#include <string>

#include "core/base/prescribed_motion.hpp"
#include "core/domain/kept.hpp"

namespace beadwork {

enum class Grip {
  each,  ///< every element of the set moves alike
  mean,  ///< the mean over the set does; each element is free otherwise
};

/// One row for each element of the set, or one over its mean.
struct Constraint {
  std::string by;     ///< id of the load
  std::string place;  ///< of the load in the deck; set by the loop
  std::string set;
  int axis = 0;  ///< 0 x, 1 y, 2 z; 3 4 5 the turns about them, which can be held only
  Grip grip = Grip::each;
  bool driven = false;                           ///< it moves (pull), as against holding still
  std::function<PrescribedMotion(Real)> motion;  ///< displacement, velocity, acceleration by the time since it began
  Real reach = std::numeric_limits<Real>::infinity();  ///< farthest that it ever gets from where it has been [m]
  Real began = 0;                                      ///< start of the first stage in which the load stands [s]
  Kept reaction;  ///< sum of the forces that keep it, at the last accepted step [N]
  Kept work;      ///< of these forces so far [J]

  /// Throws PhysicsFailure, with the load's place in the deck, if the motion fails or is no number.
  PrescribedMotion at(Real time) const;
};

}  // namespace beadwork
