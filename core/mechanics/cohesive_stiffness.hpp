#pragma once
// Stiffness of a cohesive contact about a state. docs/theory/cohesive-contact.md

#include "core/mechanics/cohesive.hpp"
#include "core/mechanics/stiffness.hpp"

namespace beadwork {

enum class CohesiveSlope {
  sound,    ///< k0, as if nothing were damaged: what a time step must be stable for
  secant,   ///< F/u, never negative: a Newton iteration that does not diverge
  tangent,  ///< dF/du: -F_c/(u_p - u_e) while softening goes on
};

/// Stiffness per area of one mode at an opening, given the accepted history [N/m^3].
inline Real traction_slope(const Softening<Real>& law, Real opening, Real history, CohesiveSlope slope) {
  if (slope == CohesiveSlope::sound || opening < 0) return law.stiffness;
  const bool softens = opening >= history && opening > law.onset && opening < law.open;
  if (slope == CohesiveSlope::tangent && softens) return -law.stiffness * law.onset / (law.open - law.onset);
  return law.stiffness * soundness(law, max(history, opening));
}

/// The normal law alone. The pull across the chord, F/l, is part of the secant and the tangent.
inline Matrix12 cohesive_stiffness(const Softening<Real>& law, const CohesiveRest<Real>& rest, const Vec3& d,
                                   Real history, CohesiveSlope slope) {
  const Real l = d.norm();
  const Vec3 n = d / l;
  const Real u_n = l - rest.length;
  const Real along = rest.area * traction_slope(law, u_n, history, slope);
  const Real pull = slope == CohesiveSlope::sound ? 0 : rest.area * traction(law, u_n, history) / l;
  return stiffness::between_centres(along * (n * n.transpose()) + pull * stiffness::across(n));
}

/// Shear law, or both. What the present forces add by turning is left out for the shear.
template <CohesiveModes modes>
Matrix12 cohesive_stiffness(const CohesiveLaws<Real>& laws, const CohesiveRest<Real>& rest,
                            const ContactArms<Real>& arms, const Vec3& d, const Quat& q1, const Quat& q2,
                            const Openings<Real>& history, CohesiveSlope slope) {
  const ContactState<Real> at = contact_state<Real>(rest, arms, d, q1, q2);
  const Openings<Real> next = next_history<modes>(laws, at.opening, history);
  const bool failed = slope != CohesiveSlope::sound && has_failed<modes>(laws, next);

  Matrix12 k = Matrix12::Zero();
  if constexpr (modes == CohesiveModes::both) {
    Softening<Real> normal = laws.normal;
    if (failed && at.opening.normal >= 0) normal.stiffness = 0;
    k += cohesive_stiffness(normal, rest, d, history.normal, slope);
  }
  if (failed) return k;

  // du_s = P ((1 - u.n/l) (dx2 - dx1) + dtheta2 x a2 - dtheta1 x a1)
  const Mat3 across = stiffness::across(at.normal);
  const Real share = 1 - at.along / at.length;
  stiffness::Matrix3x12 slip;
  slip << -share * across, across * stiffness::skew(at.arm1), share * across,
      -across * stiffness::skew(at.arm2);
  const Real secant =
      laws.shear.stiffness * soundness(laws.shear, slope == CohesiveSlope::sound ? 0 : next.shear);
  Mat3 shear = secant * Mat3::Identity();
  if (at.opening.shear > 0) {
    const Vec3 way = at.slip / at.opening.shear;
    shear += (traction_slope(laws.shear, at.opening.shear, history.shear, slope) - secant) *
             (way * way.transpose());
  }
  k += rest.area * slip.transpose() * shear * slip;
  return k;
}

}  // namespace beadwork
