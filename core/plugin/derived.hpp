#pragma once
// Section <derive>: fields found from others.

#include "core/plugin/pair_law.hpp"

namespace beadwork {

/// Provides a field that somebody reads, in just the steps in which it is read. It is added by itself; a deck names it
/// only to set its parameters.
class Derived : public Plugin {
 public:
  static constexpr Kind its_kind = Kind::derive;
  Derived() : Plugin(its_kind) {}
  virtual void derive(const Domain& domain) = 0;
  /// Of one that reads sums over bonds: whether the forces of this law count in them.
  virtual bool sums_over(const PairLaw& law) const { return law.is_in_stress(); }
};

}  // namespace beadwork
