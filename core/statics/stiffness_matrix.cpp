#include "core/statics/stiffness_matrix.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/failure.hpp"

namespace beadwork {

// Solvers count in 32 bits, and those that order by graphs count each number off the diagonal twice.
std::size_t numbers_of_stiffness(std::size_t elements, std::size_t pairs, bool turning) {
  constexpr std::size_t most = std::numeric_limits<int>::max() / 2;
  const std::size_t d = turning ? 6 : 3, numbers = d * (d + 1) / 2 * elements + d * d * pairs;
  if (numbers > most)
    throw MachineFailure(
        fmt::format("the stiffness of {} elements with {} pairs of them that hold one another has {} numbers, and no "
                    "more than {} can be counted: <verlet> needs none",
                    elements, pairs, numbers, most));
  return numbers;
}

using Block = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;

StiffnessMatrix::StiffnessMatrix(Index elements, const std::vector<std::pair<Index, Index>>& pairs, Real length)
    : per_element_(length > 0 ? 6 : 3), length_(length) {
  matrix_.row.reserve(numbers_of_stiffness(static_cast<std::size_t>(elements), pairs.size(), length > 0));
  begin_.assign(static_cast<std::size_t>(elements) + 1, 0);
  for (const auto& [first, second] : pairs) {
    ++begin_[static_cast<std::size_t>(first) + 1];
    below_.push_back(second);
  }
  for (std::size_t k = 1; k < begin_.size(); ++k) begin_[k] += begin_[k - 1];

  const int d = per_element_;
  matrix_.begin.assign(1, 0);
  for (Index element = 0; element < elements; ++element)
    for (int c = 0; c < d; ++c) {
      for (int r = c; r < d; ++r) matrix_.row.push_back(d * element + r);
      for (Index k = begin_[static_cast<std::size_t>(element)]; k < begin_[static_cast<std::size_t>(element) + 1]; ++k)
        for (int r = 0; r < d; ++r) matrix_.row.push_back(d * below_[static_cast<std::size_t>(k)] + r);
      matrix_.begin.push_back(static_cast<int>(matrix_.row.size()));
    }
  clear();
}

void StiffnessMatrix::clear() { matrix_.value.assign(matrix_.row.size(), 0); }

// The numbers of a bond are those of (x1, theta1, x2, theta2).
void StiffnessMatrix::add_diagonal(Index element, const Matrix12& bond, int from) {
  for (int c = 0; c < per_element_; ++c) {
    Real* column =
        &matrix_.value[static_cast<std::size_t>(matrix_.begin[static_cast<std::size_t>(per_element_ * element + c)])];
    for (int r = c; r < per_element_; ++r) column[r - c] += bond(from + r, from + c);
  }
}

void StiffnessMatrix::add(Index first, Index second, const Matrix12& bond) {
  Matrix12 k = 0.5 * (bond + bond.transpose());
  if (per_element_ == 6)
    for (const int turn : {3, 9}) {
      k.middleRows<3>(turn) /= length_;
      k.middleCols<3>(turn) /= length_;
    }
  add_diagonal(first, k, 0);
  add_diagonal(second, k, 6);
  const auto begin = below_.begin() + begin_[static_cast<std::size_t>(first)];
  const auto end = below_.begin() + begin_[static_cast<std::size_t>(first) + 1];
  const auto block = static_cast<int>(std::lower_bound(begin, end, second) - begin);
  for (int c = 0; c < per_element_; ++c) {
    Real* column = &matrix_.value[static_cast<std::size_t>(
        matrix_.begin[static_cast<std::size_t>(per_element_ * first + c)] + (per_element_ - c) + per_element_ * block)];
    for (int r = 0; r < per_element_; ++r) column[r] += k(6 + r, c);
  }
}

// The null space of each element's own block: what nothing at all resists, however its neighbours move.
void StiffnessMatrix::hold_idle() {
  const int d = per_element_;
  const Real spring = largest() > 0 ? largest() : 1;
  for (int first = 0; first < matrix_.size(); first += d) {
    Block block(d, d);
    for (int c = 0; c < d; ++c)
      for (int r = c; r < d; ++r)
        block(r, c) = block(c, r) =
            matrix_.value[static_cast<std::size_t>(matrix_.begin[static_cast<std::size_t>(first + c)] + r - c)];
    const Eigen::LDLT<Block> quick(block);
    if (quick.vectorD().minCoeff() > 1e-9 * spring) continue;
    const Eigen::SelfAdjointEigenSolver<Block> modes(block);
    for (int k = 0; k < d; ++k) {
      if (std::abs(modes.eigenvalues()[k]) > 1e-12 * spring) continue;
      const Eigen::Matrix<Real, Eigen::Dynamic, 1, 0, 6, 1> idle = modes.eigenvectors().col(k);
      for (int c = 0; c < d; ++c)
        for (int r = c; r < d; ++r)
          matrix_.value[static_cast<std::size_t>(matrix_.begin[static_cast<std::size_t>(first + c)] + r - c)] +=
              spring * idle[r] * idle[c];
    }
  }
}

Real StiffnessMatrix::largest() const {
  Real largest = 0;
  for (int k = 0; k < matrix_.size(); ++k)
    if (k % per_element_ < 3) largest = std::max(largest, std::abs(matrix_.diagonal(k)));
  return largest;
}

}  // namespace beadwork
