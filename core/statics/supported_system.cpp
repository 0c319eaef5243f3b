#include "core/statics/supported_system.hpp"

#include <algorithm>
#include <cmath>

namespace beadwork {

using Eigen::MatrixXd;

Real SupportedSystem::analyse(const SymmetricMatrix& pattern) {
  solver_->analyse(pattern);
  // the factor, and K as it is, as it is reduced and as it is put together, with its rows
  return solver_->memory() + 3 * static_cast<Real>(pattern.value.size()) * (sizeof(Real) + sizeof(int));
}

Factored SupportedSystem::factor(const SymmetricMatrix& k, const Supports& supports) {
  supports_ = supports;
  whole_ = k;
  free_ = k;
  Real largest = 0;
  for (int u = 0; u < k.size(); ++u) largest = std::max(largest, std::abs(k.diagonal(u)));
  if (largest == 0) largest = 1;  // all has broken
  spring_ = largest;
  for (int column = 0; column < k.size(); ++column) {
    const bool gone = is_fixed(column);
    const auto begin = static_cast<std::size_t>(k.begin[static_cast<std::size_t>(column)]);
    const auto end = static_cast<std::size_t>(k.begin[static_cast<std::size_t>(column) + 1]);
    for (std::size_t n = begin; n < end; ++n)
      if (gone || is_fixed(k.row[n])) free_.value[n] = 0;
    if (gone) free_.value[begin] = largest;
  }
  for (const Supports::Mean& mean : supports.means)
    free_.value[static_cast<std::size_t>(free_.begin[static_cast<std::size_t>(mean.pinned)])] += spring_;
  const Factored result = solver_->factor(free_);
  if (result.whole) border();
  return result;
}

// K' = K + s sum e e^T, e of the pins: K du + C^T lambda = f, C du = v and xi = E^T du are
// du = K'^-1 (f + s E xi - C^T lambda), two small systems for xi and lambda.
void SupportedSystem::border() {
  const auto m = static_cast<Eigen::Index>(supports_.means.size());
  if (m == 0) return;
  shifts_ = MatrixXd::Zero(whole_.size(), 2 * m);
  MatrixXd small = MatrixXd::Zero(2 * m, 2 * m);
  for (Eigen::Index k = 0; k < m; ++k) {
    const Supports::Mean& mean = supports_.means[static_cast<std::size_t>(k)];
    Vector pin = Vector::Zero(whole_.size()), pull = Vector::Zero(whole_.size());
    pin[mean.pinned] = spring_;
    supports_.add_mean(mean, -spring_, pull);  // the multiplier in units of the spring
    solver_->solve(pin);
    solver_->solve(pull);
    shifts_.col(k) = pin;
    shifts_.col(m + k) = pull;
  }
  for (Eigen::Index j = 0; j < m; ++j) {
    const Supports::Mean& mean = supports_.means[static_cast<std::size_t>(j)];
    for (Eigen::Index k = 0; k < 2 * m; ++k) {
      small(j, k) = shifts_(mean.pinned, k) - (j == k ? 1 : 0);
      small(m + j, k) = Supports::mean_of(mean, shifts_.col(k));  // what is fixed stands still in it
    }
  }
  small_.compute(small);
}

void SupportedSystem::multiply(const Vector& x, Vector& y) const {
  for (int column = 0; column < whole_.size(); ++column) {
    const auto begin = static_cast<std::size_t>(whole_.begin[static_cast<std::size_t>(column)]);
    const auto end = static_cast<std::size_t>(whole_.begin[static_cast<std::size_t>(column) + 1]);
    const Real here = x[column];
    Real sum = whole_.value[begin] * here;
    for (std::size_t n = begin + 1; n < end; ++n) {
      sum += whole_.value[n] * x[whole_.row[n]];
      y[whole_.row[n]] += whole_.value[n] * here;
    }
    y[column] += sum;
  }
}

bool SupportedSystem::solve(const Vector& f, const Lacking& lacking, Vector& du) {
  Vector given = Vector::Zero(f.size());
  bool moved = false;
  for (Eigen::Index k = 0; k < f.size(); ++k)
    if (is_fixed(static_cast<int>(k))) moved |= (given[k] = lacking.fixed[k]) != 0;
  du = f;
  if (moved) {
    Vector pulled = Vector::Zero(f.size());
    multiply(given, pulled);
    du -= pulled;
  }
  for (Eigen::Index k = 0; k < f.size(); ++k)
    if (is_fixed(static_cast<int>(k))) du[k] = 0;
  bool done = solver_->solve(du);
  const auto m = static_cast<Eigen::Index>(supports_.means.size());
  if (m > 0) {
    Vector wanted(2 * m);
    for (Eigen::Index k = 0; k < m; ++k) {
      const Supports::Mean& mean = supports_.means[static_cast<std::size_t>(k)];
      wanted[k] = -du[mean.pinned];
      wanted[m + k] = lacking.means[k] - Supports::mean_of(mean, du) - Supports::mean_of(mean, given);
    }
    du += shifts_ * small_.solve(wanted);
  }
  return done && (du += given).allFinite();
}

}  // namespace beadwork
