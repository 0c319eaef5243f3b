#pragma once
// Section <load>: what moves, holds or pushes.

#include "core/domain/constraint.hpp"
#include "core/domain/moment.hpp"
#include "core/plugin/plugin.hpp"

namespace beadwork {

class Load : public Plugin {
 public:
  static constexpr Kind its_kind = Kind::load;
  Load() : Plugin(its_kind) {}
  /// Before the first `start` of the stage: clears what the starts of several loads add up.
  virtual void clear(Domain&) {}
  /// Once, at the start of its stage: initial velocities and the like.
  virtual void start(Domain&) {}
  virtual std::vector<Constraint> constraints() const { return {}; }
  /// Adds forces, at every evaluation.
  virtual void push(Domain&, const Moment&) {}
  /// After every accepted step: accumulates the work of `push`. Velocities and spins stand for the end of the step
  /// where the load declares that it `Reads` them (`Keeps` does not count), or a derived field that is found from them.
  virtual void account(const Domain&, const Moment&) {}
};

}  // namespace beadwork
