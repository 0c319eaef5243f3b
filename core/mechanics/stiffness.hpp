#pragma once
// What the stiffness of a bond is made of, rows and columns (x1, theta1, x2, theta2); angles are increments
// seen from the world. Only for time steps and static movers: none of this runs in the loop over steps.

#include "core/mechanics/lane.hpp"

namespace beadwork {

using Matrix12 = Eigen::Matrix<Real, 12, 12>;

/// Which slope of the forces is meant by a stiffness.
enum class Slope {
  stiffest,  ///< that a bond can come to have from here on: what a time step must be stable for
  secant,    ///< never negative: what a Newton iteration does not diverge by
  /// The derivative of the forces at the state and the accepted history, with what the present forces do by turning.
  consistent,
};

namespace stiffness {

using Matrix3x12 = Eigen::Matrix<Real, 3, 12>;

/// The vector d x a as a matrix times a.
inline Mat3 skew(const Vec3& d) {
  Mat3 m;
  m << 0, -d[2], d[1], d[2], 0, -d[0], -d[1], d[0], 0;
  return m;
}

/// 1 - n n.
inline Mat3 across(const Vec3& n) { return Mat3::Identity() - n * n.transpose(); }

/// The same 3 x 3 stiffness between the two centres, no rotations.
inline Matrix12 between_centres(const Mat3& k) {
  Matrix12 block = Matrix12::Zero();
  block.block<3, 3>(0, 0) = block.block<3, 3>(6, 6) = k;
  block.block<3, 3>(0, 6) = block.block<3, 3>(6, 0) = -k;
  return block;
}

/// N/l of a bond that is pulled from its length at rest, N = k (l - L), where a slope that is never negative takes it up.
inline Real tension_across(Real axial, Real rest_length, Real length, Slope slope) {
  const Real strain = (length - rest_length) / length;
  return strain > (slope == Slope::stiffest ? 0.01 : 0) ? axial * strain : 0;
}

/// a^T a, written out: the three terms of each sum are too few for a general product.
inline Matrix12 square(const Matrix3x12& a) {
  Matrix12 product;
  for (int c = 0; c < 12; ++c)
    for (int r = 0; r < 12; ++r) product(r, c) = a(0, r) * a(0, c) + a(1, r) * a(1, c) + a(2, r) * a(2, c);
  return product;
}

}  // namespace stiffness
}  // namespace beadwork
