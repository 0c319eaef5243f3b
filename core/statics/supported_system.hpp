#pragma once
// K du = f with supports: fixed unknowns are eliminated, and means are brought in by bordering, so that a mean over a
// thousand elements costs a solve and no thousand times thousand numbers.        docs/theory/statics.md

#include <Eigen/LU>
#include <memory>

#include "core/statics/linear_solver.hpp"
#include "core/statics/supports.hpp"

namespace beadwork {

class SupportedSystem {
 public:
  explicit SupportedSystem(std::unique_ptr<LinearSolver> solver) : solver_(std::move(solver)) {}

  /// Takes the pattern of the matrices to come; what factors of it will take in memory is known then [bytes].
  Real analyse(const SymmetricMatrix& pattern);
  /// Factors K, of that pattern, where it is free.
  Factored factor(const SymmetricMatrix& k, const Supports& supports);
  /// What was factored last.
  const SymmetricMatrix& stiffness() const { return whole_; }
  /// du with K du + C^T lambda = f where it is free, du and C du as lacking. False where an iteration does not end.
  bool solve(const Vector& f, const Lacking& lacking, Vector& du);

 private:
  bool is_fixed(int unknown) const { return supports_.is_fixed(unknown); }
  void border();
  void multiply(const Vector& x, Vector& y) const;

  std::unique_ptr<LinearSolver> solver_;
  Supports supports_;
  SymmetricMatrix whole_, free_;  ///< K, and K with ones in the place of what is fixed
  Real spring_ = 0;               ///< of the pins of means [N/m]
  Eigen::MatrixXd shifts_;        ///< K'^-1 (spring of each pin, means)
  Eigen::PartialPivLU<Eigen::MatrixXd> small_;
};

}  // namespace beadwork
