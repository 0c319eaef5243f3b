#pragma once
// What is prescribed of the elements: rows (element, degree of freedom, coefficient) = value(t).

#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "core/base/prescribed_motion.hpp"
#include "core/domain/kept.hpp"

namespace beadwork {

enum class Grip {
  each,  ///< every element of the set moves alike
  mean,  ///< the mean over the set does; each element is free otherwise
};

/// A set that turns about an axis as one rigid body: places go round on circles, and all turns follow.
struct RigidTurn {
  Vec3 about;                    ///< a point of the axis [m]
  std::string from;              ///< column of the elements: their places when the turn began
  bool along = true;             ///< places along the axis are held too
  std::array<Kept, 3> forces{};  ///< sums of the forces that keep it, at the last accepted step [N]
};

/// One row for each element of the set, or one over its mean.
struct Constraint {
  std::string by;     ///< id of the load
  std::string place;  ///< of the load in the deck; set by the loop
  std::string set;
  int axis = 0;  ///< 0 x, 1 y, 2 z; 3 4 5 the turns about them
  Grip grip = Grip::each;
  std::optional<RigidTurn> body = {};            ///< of a turn; absent: each element turns about its own centre
  bool driven = false;                           ///< it moves (pull, turn), as against holding still
  std::function<PrescribedMotion(Real)> motion;  ///< displacement, velocity, acceleration by the time since it began
  Real reach = std::numeric_limits<Real>::infinity();  ///< farthest that it ever gets from where it has been [m]
  Real began = 0;                                      ///< start of the first stage in which the load stands [s]
  Real lever = 0;  ///< of a turn: from its axis to the farthest rim of the set [m]; set by the loop
  Kept
      reaction;  ///< sum of the forces that keep it, or their torque about the axis, at the last accepted step [N, N.m]
  Kept work;     ///< of these forces so far [J]
  Kept
      pinned;  ///< of a mean: row of the element by which a static mover holds it while it eliminates, and one; 0: none

  /// Throws PhysicsFailure, with the load's place in the deck, if the motion fails or is no number.
  PrescribedMotion at(Real time) const;

  bool turns() const { return axis >= 3; }
  /// It moves its set along an axis: what a displacement in a deck means.
  bool pulls() const { return driven && !turns(); }
  /// Bit k: degree of freedom k of each element of the set is prescribed, or has its part in a mean that is.
  unsigned prescribes() const;
  /// Sum of the forces that keep it [N].
  Vec3 force() const;
  /// What it carries, as a force: the torque that turns something as a force on the farthest rim [N].
  Real load() const;
};

}  // namespace beadwork
