#pragma once
// Stiffness of a central spring about a state.

#include "core/mechanics/spring.hpp"
#include "core/mechanics/stiffness.hpp"

namespace beadwork {

/// k_n along the chord and, of what a pulled spring does across it, N/l: see beam_stiffness.
inline Matrix12 spring_stiffness(const SpringRest<Real>& rest, const Vec3& d, Slope slope) {
  const Real l = d.norm();
  const Vec3 e = d / l;
  const Real tension = stiffness::tension_across(rest.axial, rest.length, l, slope);
  return stiffness::between_centres(rest.axial * (e * e.transpose()) + tension * stiffness::across(e));
}

}  // namespace beadwork
