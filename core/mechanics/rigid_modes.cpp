#include "core/mechanics/rigid_modes.hpp"

#include <fmt/format.h>

namespace beadwork {

namespace rigid {

std::vector<std::string> directions(const Eigen::Matrix<Real, 3, Eigen::Dynamic>& span) {
  std::vector<std::string> names;
  Mat3 left = span * span.transpose();  // what of the span has no name yet
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 unit = Vec3::Unit(axis);
    if ((left * unit - unit).norm() > 1e-4) continue;
    names.push_back(std::string(1, "xyz"[axis]));
    left -= unit * unit.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> rest(left);
  for (int k = 0; k < 3; ++k) {
    if (rest.eigenvalues()[k] < 0.5) continue;
    Vec3 d = rest.eigenvectors().col(k);
    Eigen::Index largest = 0;
    d.cwiseAbs().maxCoeff(&largest);
    if (d[largest] < 0) d = -d;
    names.push_back(fmt::format("({:.2f} {:.2f} {:.2f})", d[0] + 0.0, d[1] + 0.0, d[2] + 0.0));
  }
  return names;
}

}  // namespace rigid

std::vector<std::string> names_of(const RigidModes& modes) {
  if (modes.cols() == 0) return {};
  constexpr Real turning = 1e-4;  // less than this share of a motion in turns is none
  const Eigen::JacobiSVD<Eigen::MatrixXd> turns(modes.bottomRows<3>(), Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Index rank = 0;
  while (rank < turns.singularValues().size() && turns.singularValues()[rank] > turning) ++rank;
  std::vector<std::string> names;
  for (const std::string& d : rigid::directions(modes.topRows<3>() * turns.matrixV().rightCols(modes.cols() - rank)))
    names.push_back("move along " + d);
  for (const std::string& d : rigid::directions(turns.matrixU().leftCols(rank))) names.push_back("turn about " + d);
  return names;
}

}  // namespace beadwork
