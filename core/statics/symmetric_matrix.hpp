#pragma once
// A sparse symmetric matrix as solvers take it: its lower triangle, column by column, the diagonal first in each.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "core/base/types.hpp"

namespace beadwork {

using Vector = Eigen::VectorXd;

struct SymmetricMatrix {
  std::vector<int> begin{0};  ///< of each column in `row` and `value`, and one more
  std::vector<int> row;       ///< ascending in each column
  std::vector<Real> value;

  int size() const { return static_cast<int>(begin.size()) - 1; }
  Real diagonal(int k) const { return value[static_cast<std::size_t>(begin[static_cast<std::size_t>(k)])]; }
  /// The same numbers, for Eigen.
  Eigen::Map<const Eigen::SparseMatrix<Real>> lower() const {
    return {size(), size(), static_cast<Eigen::Index>(value.size()), begin.data(), row.data(), value.data()};
  }
};

}  // namespace beadwork
