#pragma once
// Stiffness of a cohesive contact about a state. docs/theory/cohesive-contact.md

#include "core/mechanics/cohesive_modes.hpp"
#include "core/mechanics/stiffness.hpp"

namespace beadwork {

enum class CohesiveSlope {
  undamaged,  ///< k0, as if nothing were damaged: what a time step must be stable for
  secant,     ///< F/u, never negative: a Newton iteration that does not diverge
  tangent,    ///< dF/du: -F_c/(u_p - u_e) while softening goes on
};

/// Stiffness per area of one mode at an opening, given the accepted history [N/m^3].
inline Real traction_slope(const Softening<Real>& law, Real opening, Real history, CohesiveSlope slope) {
  if (slope == CohesiveSlope::undamaged || opening < 0) return law.stiffness;
  const bool softens = opening >= history && opening > law.onset && opening < law.open;
  if (slope == CohesiveSlope::tangent && softens) return -law.stiffness * law.onset / (law.open - law.onset);
  return law.stiffness * integrity(law, max(history, opening));
}

/// The normal law alone. The pull across the chord, F/l, is part of the secant and the tangent.
inline Matrix12 cohesive_stiffness(const Softening<Real>& law, const CohesiveRest<Real>& rest, const Vec3& d,
                                   Real history, CohesiveSlope slope) {
  const Real l = d.norm();
  const Vec3 n = d / l;
  const Real u_n = l - rest.length;
  const Real along = rest.area * traction_slope(law, u_n, history, slope);
  const Real pull = slope == CohesiveSlope::undamaged ? 0 : rest.area * traction(law, u_n, history) / l;
  return stiffness::between_centres(along * (n * n.transpose()) + pull * stiffness::across(n));
}

/// How an opening of the faces follows the twelve coordinates: du_n = normal . dx, du_s = slip dx.
struct OpeningRows {
  Eigen::Matrix<Real, 1, 12> normal;
  stiffness::Matrix3x12 slip;
};

/// du_n = n.(dx2 - dx1),  du_s = P ((1 - u.n/l) (dx2 - dx1) + dtheta2 x a2 - dtheta1 x a1)
inline OpeningRows opening_rows(const PairFaces<Real>& at) {
  const Mat3 across = stiffness::across(at.normal);
  const Real share = 1 - at.along / at.length;
  OpeningRows rows;
  rows.normal << -at.normal.transpose(), Vec3::Zero().transpose(), at.normal.transpose(), Vec3::Zero().transpose();
  rows.slip << -share * across, across * stiffness::skew(at.arm1), share * across, -across * stiffness::skew(at.arm2);
  return rows;
}

/// du = dx2 - dx1 + dtheta2 x a2 - dtheta1 x a1,  dn = P (dtheta1 x n1 + dtheta2 x n2)/|n1 + n2|,
/// du_n = n.du + u_s.dn,  du_s = P du - n (u_s.dn) - u_n dn
inline OpeningRows opening_rows(const CarriedFaces<Real>& at) {
  const Mat3 across = stiffness::across(at.normal);
  stiffness::Matrix3x12 opening, turn;
  opening << -Mat3::Identity(), stiffness::skew(at.arm1), Mat3::Identity(), -stiffness::skew(at.arm2);
  turn << Mat3::Zero(), -across * stiffness::skew(at.normal1), Mat3::Zero(), -across * stiffness::skew(at.normal2);
  turn /= at.length;
  const Eigen::Matrix<Real, 1, 12> by_turning = at.slip.transpose() * turn;
  OpeningRows rows;
  rows.normal = at.normal.transpose() * opening + by_turning;
  rows.slip = across * opening - at.normal * by_turning - at.opening.normal * turn;
  return rows;
}

/// As if nothing were damaged: what a time step must be stable for. What the present forces add by turning is left out.
template <class Modes, class Faces>
Matrix12 undamaged_stiffness(const Modes& modes, const Faces& at, Real area) {
  const OpeningRows rows = opening_rows(at);
  Matrix12 k = Matrix12::Zero();
  if constexpr (Modes::opens) k += area * modes.normal.stiffness * rows.normal.transpose() * rows.normal;
  if constexpr (Modes::slides) k += area * modes.shear.stiffness * stiffness::square(rows.slip);
  return k;
}

/// Of a pair's independent modes. What the present forces add by turning is left out for the shear.
template <CohesiveModes modes>
Matrix12 cohesive_stiffness(const IndependentModes<modes>& laws, const CohesiveRest<Real>& rest,
                            const PairFaces<Real>& at, const Openings<Real>& history, CohesiveSlope slope) {
  const Openings<Real> next = laws.next(at.opening, history);
  const bool failed = slope != CohesiveSlope::undamaged && laws.failed(next);
  Matrix12 k = Matrix12::Zero();
  if constexpr (IndependentModes<modes>::opens) {
    Softening<Real> normal = laws.normal;
    if (failed && at.opening.normal >= 0) normal.stiffness = 0;
    k += cohesive_stiffness(normal, rest, at.length * at.normal, history.normal, slope);
  }
  if constexpr (IndependentModes<modes>::slides) {
    if (failed) return k;
    const Real secant =
        laws.shear.stiffness * integrity(laws.shear, slope == CohesiveSlope::undamaged ? 0 : next.shear);
    Mat3 shear = secant * Mat3::Identity();
    if (at.opening.shear > 0) {
      const Vec3 way = at.slip / at.opening.shear;
      shear += (traction_slope(laws.shear, at.opening.shear, history.shear, slope) - secant) * (way * way.transpose());
    }
    const stiffness::Matrix3x12 slip = opening_rows(at).slip;
    k += rest.area * slip.transpose() * shear * slip;
  }
  return k;
}

}  // namespace beadwork
