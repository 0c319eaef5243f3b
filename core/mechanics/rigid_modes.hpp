#pragma once
// Which motions of a body as a whole its supports leave free: the rank of what they prescribe on the six rigid motions.
// docs/theory/quasi-static.md
//
// A rigid motion is q = (u, L w): displacement u of the body's centre and turn w about it, times a length L of the
// body, so that all six numbers are lengths. A point at the arm d from the centre moves by u + w x d.

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <string>
#include <vector>

#include "core/mechanics/stiffness.hpp"

namespace beadwork {

using Rigid = Eigen::Matrix<Real, 6, 1>;
using RigidMatrix = Eigen::Matrix<Real, 6, 6>;
using RigidModes = Eigen::Matrix<Real, 6, Eigen::Dynamic>;  ///< a motion a column

/// What each rigid motion moves a point at the arm d: 3 x 6.
inline Eigen::Matrix<Real, 3, 6> rigid_at(const Vec3& arm, Real length) {
  Eigen::Matrix<Real, 3, 6> at;
  at.leftCols<3>().setIdentity();
  at.rightCols<3>() = stiffness::skew(arm).transpose() / length;  // w x d = -d x w
  return at;
}

/// Orthonormal motions that have inertia and that no support feels. `held`: sum over supports of r r^T, r the motion
/// that each feels, of order 1; `inertia`: likewise, over the mass of the body. Motions without inertia (a straight
/// chain of points about itself) are none.
inline RigidModes free_modes(const RigidMatrix& held, const RigidMatrix& inertia) {
  constexpr Real none = 1e-9;  // squared: a support of a thirty-thousandth of the body's length still holds a turn
  const auto columns_where = [](const RigidModes& vectors, const Eigen::VectorXd& values, const auto& wanted) {
    RigidModes kept(6, 0);
    for (Index k = 0; k < static_cast<Index>(values.size()); ++k) {
      if (!wanted(values[k])) continue;
      kept.conservativeResize(6, kept.cols() + 1);
      kept.col(kept.cols() - 1) = vectors.col(k);
    }
    return kept;
  };
  const Eigen::SelfAdjointEigenSolver<RigidMatrix> heavy(inertia);
  const RigidModes moving =
      columns_where(heavy.eigenvectors(), heavy.eigenvalues(), [](Real value) { return value > none; });
  if (moving.cols() == 0) return moving;
  const Eigen::MatrixXd seen = moving.transpose() * held * moving;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> felt(seen);
  return columns_where(moving * felt.eigenvectors(), felt.eigenvalues(), [](Real value) { return value < none; });
}

namespace rigid {

/// The directions that an orthonormal set of vectors spans: axes by name where they lie in it, others by their numbers.
std::vector<std::string> directions(const Eigen::Matrix<Real, 3, Eigen::Dynamic>& span);

}  // namespace rigid

/// In words: "move along x", "turn about z"; turns are about some line with that direction.
std::vector<std::string> names_of(const RigidModes& modes);

}  // namespace beadwork
