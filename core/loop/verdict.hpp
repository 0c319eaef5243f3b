#pragma once
// What a criterion has found, read off the utilisations that it has filled.

#include <span>
#include <vector>

#include "core/plugin/failure.hpp"

namespace beadwork {

/// A bond of a family, or an element.
struct Judged {
  BondTable* table = nullptr;  ///< null for an element
  Index row = -1;
  Real utilisation = 0;
};

struct Verdict {
  std::vector<Judged> fallen;  ///< utilisation 1 and more, in the order of the families and of their rows
  Judged highest;              ///< row -1 where nothing is under load
};

/// Of elements only those count that a bond which may break holds: the others have nothing to lose, and their
/// utilisation is set to 0. `held` tells of each; it is not looked at where bonds are judged. Throws std::runtime_error,
/// naming the bond or the element, where a utilisation is no number.
Verdict read_verdict(const Failure& failure, Domain& domain, std::span<const char> held);

}  // namespace beadwork
