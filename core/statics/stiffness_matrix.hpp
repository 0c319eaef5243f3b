#pragma once
// The stiffness of a whole scene, put together from that of its bonds. Unknowns stand element by element: places, then,
// where elements turn, turns in units of a length, so that all are lengths and all stiffnesses N/m.

#include <cstddef>
#include <utility>
#include <vector>

#include "core/mechanics/stiffness.hpp"
#include "core/statics/symmetric_matrix.hpp"

namespace beadwork {

/// How many numbers such a matrix of so many elements and pairs holds. Throws MachineFailure if solvers cannot count them.
std::size_t numbers_of_stiffness(std::size_t elements, std::size_t pairs, bool turning);

class StiffnessMatrix {
 public:
  StiffnessMatrix() = default;
  /// With room for the stiffness between these pairs of elements, first < second, ascending, each named once.
  /// `length`: that of the unknown of a turn of 1 rad; 0 where elements do not turn [m].
  StiffnessMatrix(Index elements, const std::vector<std::pair<Index, Index>>& pairs, Real length);

  void clear();
  /// The symmetric part of what a bond between two of the pairs resists with.
  void add(Index first, Index second, const Matrix12& bond);
  /// Gives stiffness where an element has none at all, so that it stays: turns of elements that only springs hold, and
  /// contacts that do not touch. No force asks for a motion there.
  void hold_idle();
  const SymmetricMatrix& matrix() const { return matrix_; }
  /// Its largest diagonal number among places [N/m].
  Real largest() const;

 private:
  void add_diagonal(Index element, const Matrix12& bond, int from);

  int per_element_ = 3;
  Real length_ = 0;
  SymmetricMatrix matrix_;
  std::vector<Index> begin_, below_;  ///< by element: the elements behind it that it is paired with, ascending
};

}  // namespace beadwork
