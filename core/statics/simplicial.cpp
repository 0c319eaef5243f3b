// Eigen's L D L^T: no pivoting, no BLAS; the smallest scenes need no more.

#include <Eigen/SparseCholesky>
#include <cmath>

#include "core/statics/linear_solver.hpp"

namespace beadwork {

namespace {

class Simplicial final : public LinearSolver {
 public:
  void analyse(const SymmetricMatrix& pattern) override { ldlt_.analyzePattern(pattern.lower()); }

  Factored factor(const SymmetricMatrix& matrix) override {
    Factored result;
    ldlt_.factorize(matrix.lower());
    if (ldlt_.info() != Eigen::Success) return {false, -1, where_it_broke_down()};
    const Vector pivots = ldlt_.vectorD();
    Eigen::Index weakest = 0;
    Real least = std::numeric_limits<Real>::infinity();
    for (Eigen::Index k = 0; k < pivots.size(); ++k) {
      if (pivots[k] < 0) ++result.negative;
      const auto unknown = ldlt_.permutationPinv().indices()[k];
      const Real share = std::abs(pivots[k]) / std::abs(matrix.diagonal(unknown));
      if (share < least) least = share, weakest = unknown;
    }
    if (least < 1e-12) result.weakest = static_cast<int>(weakest);
    return result;
  }

  bool solve(Vector& b) override {
    b = ldlt_.solve(b).eval();
    return true;
  }

 private:
  // The first pivot that is nothing at all; those behind it were not found.
  int where_it_broke_down() const {
    const Vector pivots = ldlt_.vectorD();
    for (Eigen::Index k = 0; k < pivots.size(); ++k)
      if (pivots[k] == 0) return static_cast<int>(ldlt_.permutationPinv().indices()[k]);
    return -1;
  }

  Eigen::SimplicialLDLT<Eigen::SparseMatrix<Real>, Eigen::Lower> ldlt_;
};

}  // namespace

std::unique_ptr<LinearSolver> make_simplicial() { return std::make_unique<Simplicial>(); }

}  // namespace beadwork
