#pragma once
// Stiffness of a cohesive contact about a state, never negative. docs/theory/cohesive-contact.md
// The derivative of its force, which is negative while it softens, comes of the law itself (core/bonds/slope.hpp).

#include "core/mechanics/cohesive_modes.hpp"
#include "core/mechanics/stiffness.hpp"

namespace beadwork {

/// The normal law alone: undamaged, or F/u of what is left, with the pull across the chord, F/l.
inline Matrix12 opening_stiffness(const Softening<Real>& law, const CohesiveRest<Real>& rest, const Vec3& d,
                                  Real history, Slope slope) {
  const Real l = d.norm();
  const Vec3 n = d / l;
  if (slope == Slope::stiffest) return stiffness::between_centres(rest.area * law.stiffness * (n * n.transpose()));
  const Real u_n = l - rest.length;
  const Real left = u_n < 0 ? 1 : integrity(law, max(history, u_n));
  const Real pull = max(0.0, rest.area * traction(law, u_n, history) / l);
  return stiffness::between_centres(rest.area * left * law.stiffness * (n * n.transpose()) +
                                    pull * stiffness::across(n));
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

/// With a share of the stiffness of each mode; all of it is what a time step must be stable for. What the present forces do
/// by turning is left out.
template <class Modes, class Faces>
Matrix12 shared_stiffness(const Modes& modes, const Faces& at, Real area, const Openings<Real>& share) {
  const OpeningRows rows = opening_rows(at);
  Matrix12 k = Matrix12::Zero();
  if constexpr (Modes::opens) k += area * share.normal * modes.normal.stiffness * rows.normal.transpose() * rows.normal;
  if constexpr (Modes::slides) k += area * share.shear * modes.shear.stiffness * stiffness::square(rows.slip);
  return k;
}

}  // namespace beadwork
