#pragma once
// What is prescribed of the unknowns: some are fixed, of some the mean is.

#include <vector>

#include "core/statics/symmetric_matrix.hpp"

namespace beadwork {

struct Supports {
  struct Mean {
    std::vector<int> unknowns;
    int pinned = -1;  ///< one of them, which is held by a spring while the others are eliminated
  };
  enum Fixed : char { is_free = 0, prescribed = 1, kept = 2 };
  std::vector<char> fixed;  ///< by unknown: prescribed, or kept where it is because nothing holds it
  std::vector<Mean> means;

  bool is_fixed(int unknown) const { return fixed[static_cast<std::size_t>(unknown)] != 0; }
  /// The same for the same supports, and hardly for others; of 52 bits, which a number of a checkpoint holds.
  Real sign() const;
  /// C x: the mean of all its unknowns.
  static Real mean_of(const Mean& mean, const Vector& x);
  /// x + C^T value, where it is free.
  void add_mean(const Mean& mean, Real value, Vector& x) const;
  /// What of the forces no support takes: f - C^T lambda where it is free, with the lambda that leaves least.
  Vector unbalanced(const Vector& forces) const;
};

/// What they still have to move.
struct Lacking {
  Vector fixed;  ///< by unknown; of those that are fixed alone it counts
  Vector means;  ///< by mean
};

}  // namespace beadwork
