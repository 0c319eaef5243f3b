#pragma once
// Stiffness of a cohesive beam about a state: the Euler-Bernoulli beam along the present chord.
//                                                                                     docs/theory/cohesive-beam.md

#include "core/mechanics/beam.hpp"
#include "core/mechanics/stiffness.hpp"

namespace beadwork {

/// Second derivative of (B1) with small angles, d = x2 - x1 as it is now, never negative. A beam that is pulled resists being
/// moved across its chord by N/l besides: part of the secant, and of the stiffest once it is a hundredth of k_n.
inline Matrix12 beam_stiffness(const BeamRest<Real>& rest, const Vec3& d, Slope slope) {
  const Real l = d.norm();
  const Vec3 e = d / l;
  const Mat3 along = e * e.transpose();
  const Mat3 across = stiffness::across(e);

  // dt_i = across dtheta_i - e x (dx2 - dx1)/l, from (B2)
  stiffness::Matrix3x12 t1 = stiffness::Matrix3x12::Zero();
  t1.block<3, 3>(0, 0) = stiffness::skew(e) / l;
  t1.block<3, 3>(0, 6) = -stiffness::skew(e) / l;
  stiffness::Matrix3x12 t2 = t1;
  t1.block<3, 3>(0, 3) = across;
  t2.block<3, 3>(0, 9) = across;

  const Real tension = stiffness::tension_across(rest.axial, rest.length, l, slope);
  Matrix12 k = stiffness::between_centres(rest.axial * along + tension * across);
  k += rest.bending * (stiffness::square(t1) + stiffness::square(t2) + stiffness::square(t1 + t2));
  k.block<3, 3>(3, 3) += rest.torsion * along;
  k.block<3, 3>(9, 9) += rest.torsion * along;
  k.block<3, 3>(3, 9) -= rest.torsion * along;
  k.block<3, 3>(9, 3) -= rest.torsion * along;
  return k;
}

}  // namespace beadwork
