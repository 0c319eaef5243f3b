#pragma once
// Where something that is moved along stands, how fast it is, and how fast that changes.

#include "core/base/types.hpp"

namespace beadwork {

struct PrescribedMotion {
  Real displacement, velocity, acceleration;  ///< [m], [m/s], [m/s2], or of a turn [1], [1/s], [1/s2]
};

}  // namespace beadwork
