#pragma once
// Stiffness of a central spring about a state.

#include "core/mechanics/spring.hpp"
#include "core/mechanics/stiffness.hpp"

namespace beadwork {

/// k_n along the chord and, if asked for, N/l across it.
inline Matrix12 spring_stiffness(const SpringRest<Real>& rest, const Vec3& d, bool with_tension = false) {
  const Real l = d.norm();
  const Vec3 e = d / l;
  const Real tension = with_tension ? rest.axial * (l - rest.length) / l : 0;
  return stiffness::between_centres(rest.axial * (e * e.transpose()) + tension * stiffness::across(e));
}

}  // namespace beadwork
