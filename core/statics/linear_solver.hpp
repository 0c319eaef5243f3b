#pragma once
// The linear algebra of static movers, behind three words: analyse, factor, solve. docs/decisions/linear-algebra.md

#include <memory>
#include <string>
#include <vector>

#include "core/statics/symmetric_matrix.hpp"

namespace beadwork {

/// What came of a factorisation.
struct Factored {
  bool whole = true;  ///< false: it broke down, and nothing can be solved
  int negative = 0;   ///< pivots below zero; -1: the method does not tell
  int weakest = -1;   ///< the unknown with the smallest pivot, where that is as good as nothing; -1: none is
};

/// Solves systems with one symmetric matrix. Same numbers, same bits.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  /// Finds the order of elimination; of the matrix its pattern alone counts.
  virtual void analyse(const SymmetricMatrix& pattern) = 0;
  /// What `factor` will take, known once analysed [bytes]; 0: not known.
  virtual Real memory() const { return 0; }
  virtual Factored factor(const SymmetricMatrix& matrix) = 0;
  /// b becomes the solution. False where an iteration does not come to its end.
  virtual bool solve(Vector& b) = 0;
  /// False: a matrix with negative pivots is beyond it.
  virtual bool takes_indefinite() const { return true; }
};

/// Names of those that there are, the one that is taken by itself first.
const std::vector<std::string>& linear_solvers();
/// Throws std::logic_error for a name that is none of them.
std::unique_ptr<LinearSolver> linear_solver(const std::string& name);

// One file each.
std::unique_ptr<LinearSolver> make_multifrontal();
std::unique_ptr<LinearSolver> make_simplicial();
std::unique_ptr<LinearSolver> make_conjugate_gradients();

}  // namespace beadwork
