#pragma once
// What the stresses of elements share: which bonds count, and the volume of an element.

#include <algorithm>
#include <limits>

#include "core/domain/vocabulary.hpp"
#include "core/mechanics/sphere.hpp"
#include "core/mechanics/virial.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork {

/// Found from a sum over the bonds of an element.   docs/theory/stress.md
class OverBonds : public Derived {
 public:
  Param<std::vector<std::string>> of{this,
                                     {.name = "of",
                                      .doc = "Families of bonds whose forces count; where absent, all but cohesive "
                                             "contacts",
                                      .optional = true,
                                      .role = Role::family}};
  Reads<Real> radius{this, field::radius};

  bool sums_over(const PairLaw& law) const override {
    return of.given() ? std::find(of->begin(), of->end(), law.family()) != of->end() : law.is_in_stress();
  }

 protected:
  /// Omega of Eq (6): that of the sphere. Of a wall, which has no stress, infinite.
  Real volume(Index row) const {
    return radius[row] > 0 ? sphere_volume(radius[row]) : std::numeric_limits<Real>::infinity();
  }
};

}  // namespace beadwork
