#pragma once
// How a cloud of points spreads: the plane or the line of least squares through it.

#include <array>
#include <span>

#include <Eigen/Eigenvalues>

#include "core/base/types.hpp"

namespace beadwork {

/// The plane of least squares goes through `middle` with the normal direction[0], the line along direction[2].
struct Spread {
  Vec3 middle;
  std::array<Vec3, 3> direction;  ///< unit, at right angles, of either sign
  std::array<Real, 3> rms;        ///< distance from the middle along each, ascending [m]
};

/// Of at least one point.
inline Spread spread_of(std::span<const Vec3> points) {
  const auto count = static_cast<Real>(points.size());
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : points) middle += p / count;
  Mat3 moment = Mat3::Zero();
  for (const Vec3& p : points) moment += (p - middle) * (p - middle).transpose() / count;
  const Real scale =
      moment.trace() > 0 ? moment.trace() : 1;  // squares of micrometres stay far from the tolerance of the solver
  const Eigen::SelfAdjointEigenSolver<Mat3> solved(Mat3(moment / scale));
  Spread spread{middle, {}, {}};
  for (int k = 0; k < 3; ++k) {
    spread.direction[static_cast<std::size_t>(k)] = solved.eigenvectors().col(k);
    spread.rms[static_cast<std::size_t>(k)] = std::sqrt(std::max(Real(0), solved.eigenvalues()[k]) * scale);
  }
  return spread;
}

}  // namespace beadwork
