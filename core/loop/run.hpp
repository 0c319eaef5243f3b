#pragma once
// Runs a scene: fills it, goes through its stages step by step, lets watchers look, saves checkpoints. One way, from
// the scene to the record.

#include <optional>

#include "core/loop/breaking.hpp"
#include "core/loop/contacts.hpp"
#include "core/loop/looks.hpp"

namespace beadwork {

/// What a few steps of the first stage tell of a run, for `plan`.
struct Trial {
  Real fill_seconds = 0;  ///< filling, bonding, finding the time step
  Real time_step = 0;     ///< [s]
  std::string limited_by;
  int steps = 0;
  Real seconds_per_step = 0;  ///< without the looks of watchers
  std::vector<std::pair<const Watcher*, Real>> seconds_per_look;
};

class Run final : private Workings {
 public:
  Run(Scene& scene, const Catalogue& catalogue, RunFolder& folder, RunOptions options);

  /// To the end of the last stage. Throws PhysicsFailure, Interrupted or MachineFailure; what was reached is then
  /// saved, as far as the machine lets it.
  void all();
  /// Instead of all(): fills, bonds, goes on for some seconds of wall time, and has each watcher look some times, be it
  /// beyond the end of the stage. What watchers record goes to the run's folder, which is of no use afterwards.
  Trial trial(Real seconds);
  const RunFigures& figures() { return record_.figures(); }

 private:
  using Clock = Record::Clock;

  void begin();
  void go_through_stages();
  void enter_stage(std::size_t number, bool resumed);
  void begin_stage();
  void resume_stage();
  void look_again();
  void prepare_stage(bool resumed);
  void go_on_to_end();
  bool over();
  void step();
  void advance();
  void fail(const std::exception& failure);

  // trial (trial.cpp)
  Real try_steps(Real seconds, int& steps);
  Real try_looks(Watcher& watcher);

  // Workings
  Domain& domain() override { return state_.domain(); }
  Moment& moment() override { return state_.moment; }
  std::vector<Constraint>& constraints() override { return state_.held(); }
  std::span<const ActingLaw> laws() const override { return state_.laws; }
  Log& log() override { return options_.log; }
  void evaluate(bool settle) override;
  Real utilisation() override;
  Real next_moment(Real until) const override;
  void pause() override;
  Real reach() const override { return contacts_.reach(); }

  RunOptions options_;
  std::optional<Clock::time_point> asked_to_stop_;  ///< first seen in the middle of a step
  RunState state_;
  Offered offered_;
  Forces forces_;
  Fresh fresh_;
  Balance balance_;
  Breaking breaking_;
  Contacts contacts_;
  Record record_;
  Seen seen_;
  Looks looks_;
};

}  // namespace beadwork
