#pragma once
// The energies of a run: they are asked of the plugins, held against what was brought, and tell with what else is seen
// how good the run is. docs/theory/time-step.md, quasi-static.md

#include "core/base/log.hpp"
#include "core/loop/free_motion.hpp"
#include "core/loop/fresh.hpp"
#include "core/loop/ledger.hpp"
#include "core/loop/quality.hpp"

namespace beadwork {

class Balance {
 public:
  Balance(RunState& state, Fresh& fresh, const Log& log);

  /// Asks every plugin for its share.
  void energies(EnergySink& sink) const;

  /// The stage that begins has begun: what came without work is counted, what nothing holds is named.
  void begin_stage();
  /// After every step.
  void note_work();
  /// Whether it is time to look, which costs as much as some steps.
  bool is_due() const { return Ledger::due(state_.moment.step - state_.moment.stage_step); }
  /// Looks. Energy from nothing is told once; throws PhysicsFailure where there is more of it than was ever brought and
  /// it grows.
  void check();
  /// Looks, and leaves it at that.
  Ledger::Verdict look();
  /// Does `breaking`, which takes away forces that bonds had at the end of the step: what this costs by the size of the
  /// step is booked.
  template <class F>
  void over_break(const F& breaking) {
    fresh_.complete();  // with the forces of the bonds that break
    look_at_first_break();
    const Mover& mover = state_.mover();
    const Real before = mover.shadow_energy();
    breaking();
    ledger_.note_break(before, mover.shadow_energy());
  }
  /// A stage has ended: families that do not stand in the next one pull no longer.
  void release(const Stage& next);

  QualityFigures quality(bool failed) const;
  const FreeMotions& free_motions() const { return free_; }
  void restore(FreeMotions free) { free_ = std::move(free); }

 private:
  Real beyond_work() const;
  void count_brought();
  void find_free_motions();
  void look_at_first_break();
  void look_at_quality(const EnergySums& sums);
  bool prescribes() const;
  Real farthest_prescribed() const;
  Real round_off() const;
  std::string suspect() const;

  RunState& state_;
  Fresh& fresh_;
  const Log& log_;
  Ledger ledger_;
  Quality quality_;
  FreeMotions free_;            ///< of the present stage
  Real left_at_stage_end_ = 0;  ///< beyond_work() when the stage before ended [J]
};

}  // namespace beadwork
