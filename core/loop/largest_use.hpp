#pragma once
// The largest utilisation that a criterion has found so far, and where: it tells how near to breaking a run came that
// broke nothing.

#include <string>

#include "core/domain/kept.hpp"
#include "core/domain/moment.hpp"
#include "core/loop/verdict.hpp"

namespace beadwork {

struct LargestUse {
  Kept value;
  Kept time;  ///< [s]
  Kept step;
  Kept bond;           ///< id; -1 where there is none
  Kept first, second;  ///< ids of its elements
  Kept element;        ///< id, of a criterion that judges elements; -1 where there is none
  Kept x, y, z;        ///< the middle of the bond, or the place of the element [m]

  LargestUse() { bond = -1, element = -1; }
  /// Takes its row in the list of criteria.
  LargestUse(Table& criteria, Index row);
  bool is_there() const { return bond >= 0 || element >= 0; }
  /// Takes what a criterion has found, where it is larger. To be called before anything breaks of it, while rows stand
  /// as they were judged.
  void note(const Judged& highest, const Domain& domain, const Moment& moment);
};

/// "largest utilisation of <bond-stress of="resin"> (axial): 0.873 at step 580 (1.16e-04 s), bond 7 between elements 3
/// and 4, at ..."
std::string sentence(const LargestUse& use, const Failure& failure);

}  // namespace beadwork
