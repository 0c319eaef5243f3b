#pragma once
// Who looks when: watchers by their cadence, at the moments of their 'at', and at the end of each stage.

#include "core/loop/balance.hpp"
#include "core/loop/record.hpp"

namespace beadwork {

/// What a watcher sees, and where it writes.
class Seen final : public Sight {
 public:
  Seen(const RunState& state, const Balance& balance, Record& record)
      : state_(state), balance_(balance), record_(record) {}
  const Domain& domain() const override { return state_.domain(); }
  const Moment& moment() const override { return state_.moment; }
  std::span<const Constraint> constraints() const override { return state_.held(); }
  void energies(EnergySink& sink) const override { balance_.energies(sink); }
  Real initial_energy() const override { return state_.initial_energy; }
  void frame(const FramePlan& plan) override { record_.frame(plan); }

 private:
  const RunState& state_;
  const Balance& balance_;
  Record& record_;
};

class Looks {
 public:
  Looks(RunState& state, Fresh& fresh, const Offered& offered, Sight& sight, const Log& log)
      : state_(state), fresh_(fresh), offered_(offered), sight_(sight), log_(log) {}

  /// Those look whose turn it is.
  void look() { look_from(0); }
  /// After a restart: those look that had not had their turn when the checkpoint was written.
  void look_owed();
  /// The last state of a stage is seen by all its watchers, whatever their cadence.
  void look_at_end();
  /// Nobody looks: moments of 'at' that have come are over.
  void pass();
  /// The watcher looks, due or not.
  void show_to(Watcher& watcher);
  /// Whether a watcher is due that reads what laws offer of each bond.
  bool offer_is_due() const;
  /// The first moment up to `until`, after the present, that the end of the stage or an 'at' waits for [s]. Who asks
  /// meets it: from now on none counts as reached half a step before.
  Real next_moment(Real until) const;
  /// Moments of 'at' that never came, told at the end of the last stage in which their watcher stands.
  void tell_of_missed_moments(const std::string& instead) const;

 private:
  void look_from(std::size_t first);
  void turn_of(std::size_t watcher);
  bool due(std::size_t watcher) const;
  void note_marks(std::size_t watcher);
  std::vector<Mark> awaited() const;
  bool came(const Watcher& watcher, std::size_t mark) const;
  std::vector<WatcherState>& remembered() const { return state_.watchers[state_.stage_number()]; }

  RunState& state_;
  Fresh& fresh_;
  const Offered& offered_;
  Sight& sight_;
  const Log& log_;
};

}  // namespace beadwork
