#pragma once
// A full sphere, which every element is.

#include <numbers>

#include "core/base/types.hpp"

namespace beadwork {

/// [kg]
inline Real sphere_mass(Real density, Real radius) {
  return density * 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}

/// [m^3]
inline Real sphere_volume(Real radius) { return sphere_mass(1, radius); }

/// Moment of inertia about any axis through the centre [kg m^2].
inline Real sphere_inertia(Real mass, Real radius) { return 0.4 * mass * radius * radius; }

}  // namespace beadwork
