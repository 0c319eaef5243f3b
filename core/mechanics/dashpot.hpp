#pragma once
// Viscous bonds as matrices: loads = -C rates, with the rates (v1, w1, v2, w2) of the two ends.   docs/theory/verlet.md

#include <algorithm>
#include <cmath>

#include "core/mechanics/stiffness.hpp"

namespace beadwork {

/// What a bond's dashpots are worth.
struct DashpotRates {
  Real along = 0, across = 0;      ///< c_n, c_t [N s/m]
  Real bending = 0, twisting = 0;  ///< c_b, c_w [N m s]
};

/// From the stiffness of a bond (x1, theta1, x2, theta2) with d = x2 - x1, and 1/m1 + 1/m2 [1/kg] and 1/I1 + 1/I2
/// [1/(kg m^2)], the latter 0 where nothing turns.
inline DashpotRates dashpot_rates(const Matrix12& k, const Vec3& d, Real zeta, Real lightness, Real looseness) {
  const Vec3 n = d.normalized();
  const Mat3 moved = k.block<3, 3>(6, 6);
  const Mat3 turned = 0.25 * (k.block<3, 3>(3, 3) - k.block<3, 3>(3, 9) - k.block<3, 3>(9, 3) + k.block<3, 3>(9, 9));
  const Real along = n.dot(moved * n), twist = n.dot(turned * n);
  const auto rate = [&](Real stiffness, Real mobility) {
    return 2 * zeta * std::sqrt(std::max(Real(0), stiffness) / mobility);
  };
  DashpotRates c{rate(along, lightness), 0, 0, 0};
  if (looseness == 0) return c;
  c.across = rate(0.5 * (moved.trace() - along),
                  lightness + 0.25 * d.squaredNorm() * looseness);  // slip moves and turns both ends
  c.bending = rate(0.5 * (turned.trace() - twist), looseness);
  c.twisting = rate(twist, looseness);
  return c;
}

/// The matrix C of dashpots between two ends that are d = x2 - x1 apart.
inline Matrix12 dashpot_matrix(const DashpotRates& c, const Vec3& d) {
  const Vec3 n = d.normalized();
  Eigen::Matrix<Real, 3, 12> parting = Eigen::Matrix<Real, 3, 12>::Zero(), turning = parting;
  parting.block<3, 3>(0, 0) = -Mat3::Identity();
  parting.block<3, 3>(0, 6) = Mat3::Identity();
  parting.block<3, 3>(0, 3) = parting.block<3, 3>(0, 9) = 0.5 * stiffness::skew(d);  // -(w x d)/2 = (d x w)/2
  turning.block<3, 3>(0, 3) = -Mat3::Identity();
  turning.block<3, 3>(0, 9) = Mat3::Identity();
  const Mat3 weight = c.along * n * n.transpose() + c.across * stiffness::across(n);
  const Mat3 twist = c.twisting * n * n.transpose() + c.bending * stiffness::across(n);
  return parting.transpose() * weight * parting + turning.transpose() * twist * turning;
}

}  // namespace beadwork
