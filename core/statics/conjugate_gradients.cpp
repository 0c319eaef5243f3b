// Conjugate gradients, preconditioned by an incomplete Cholesky factor: takes little memory, and definite matrices only.

#include <Eigen/IterativeLinearSolvers>

#include "core/statics/linear_solver.hpp"

namespace beadwork {

namespace {

class ConjugateGradients final : public LinearSolver {
 public:
  ConjugateGradients() { cg_.setTolerance(1e-10); }

  void analyse(const SymmetricMatrix&) override {}

  Factored factor(const SymmetricMatrix& matrix) override {
    // both triangles: a product with half of the matrix would write where it reads
    matrix_ = matrix.lower().selfadjointView<Eigen::Lower>();
    cg_.setMaxIterations(20000);
    cg_.compute(matrix_);
    return {cg_.info() == Eigen::Success, -1, -1};
  }

  bool solve(Vector& b) override {
    b = cg_.solve(b).eval();
    return cg_.info() == Eigen::Success;
  }

  bool takes_indefinite() const override { return false; }

 private:
  Eigen::SparseMatrix<Real> matrix_;
  Eigen::ConjugateGradient<Eigen::SparseMatrix<Real>, Eigen::Lower | Eigen::Upper, Eigen::IncompleteCholesky<Real>> cg_;
};

}  // namespace

std::unique_ptr<LinearSolver> make_conjugate_gradients() { return std::make_unique<ConjugateGradients>(); }

}  // namespace beadwork
