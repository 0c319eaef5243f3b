#include "core/statics/supports.hpp"

#include <Eigen/LU>
#include <boost/container_hash/hash.hpp>

namespace beadwork {

Real Supports::sign() const {
  std::size_t sign = boost::hash_range(fixed.begin(), fixed.end());
  for (const Mean& mean : means) {
    boost::hash_range(sign, mean.unknowns.begin(), mean.unknowns.end());
    boost::hash_combine(sign, mean.pinned);
  }
  return static_cast<Real>(sign >> 12);
}

Real Supports::mean_of(const Mean& mean, const Vector& x) {
  Real sum = 0;
  for (const int k : mean.unknowns) sum += x[k];
  return sum / static_cast<Real>(mean.unknowns.size());
}

void Supports::add_mean(const Mean& mean, Real value, Vector& x) const {
  for (const int k : mean.unknowns)
    if (!is_fixed(k)) x[k] += value / static_cast<Real>(mean.unknowns.size());
}

Vector Supports::unbalanced(const Vector& forces) const {
  Vector left = forces;
  for (int k = 0; k < static_cast<int>(left.size()); ++k)
    if (is_fixed(k)) left[k] = 0;
  const auto m = static_cast<Eigen::Index>(means.size());
  if (m == 0) return left;
  Eigen::MatrixXd squared(m, m);
  Vector of_means(m);
  for (Eigen::Index k = 0; k < m; ++k) {
    Vector one = Vector::Zero(left.size());
    add_mean(means[static_cast<std::size_t>(k)], 1, one);
    for (Eigen::Index j = 0; j < m; ++j) squared(j, k) = mean_of(means[static_cast<std::size_t>(j)], one);
    of_means[k] = mean_of(means[static_cast<std::size_t>(k)], left);
  }
  const Vector taken = squared.partialPivLu().solve(of_means);
  for (Eigen::Index k = 0; k < m; ++k) add_mean(means[static_cast<std::size_t>(k)], -taken[k], left);
  return left;
}

}  // namespace beadwork
