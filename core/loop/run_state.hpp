#pragma once
// What a run must remember, and where it stands. Its numbers are columns of the scene, so that a checkpoint has them
// all and nothing is copied to and fro.

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/loop/largest_use.hpp"
#include "core/loop/scene.hpp"

namespace beadwork {

/// What a stage remembers of one of its watchers.
struct WatcherState {
  Kept last_look;            ///< step; -1: it has not looked
  std::vector<Kept> looked;  ///< by moment of its 'at': 1 once it had its look
};

/// A bond law that acts in the present stage.
using ActingLaw = std::pair<PairLaw*, BondTable*>;

class RunState {
 public:
  /// Where the loop is: what is left when something fails may be saved between two steps alone.
  enum class Phase { within_step, between_steps, after_stage };

  /// Makes its columns. The scene outlives it.
  explicit RunState(Scene& scene);
  RunState(const RunState&) = delete;
  RunState& operator=(const RunState&) = delete;

  Scene& scene;
  Moment moment;
  Phase phase = Phase::within_step;
  std::vector<std::vector<Constraint>> constraints;         ///< by stage
  std::vector<std::vector<Peak>> peaks;                     ///< by stage, of driven sets
  std::vector<std::vector<WatcherState>> watchers;          ///< by stage
  std::vector<std::pair<const Failure*, LargestUse>> uses;  ///< by criterion, in the order of the deck
  std::vector<Kept> released;  ///< by family: of broken bonds, and of all once they act no longer [J]
  Kept bond_updates, loop_seconds,
      wall_seconds;             ///< the loop's are those of steps and looks, without filling and checkpoints
  Kept initial_energy;          ///< there without any work [J]
  Kept looks_owed;              ///< watchers of the stage that have not had their turn at this step, last in the order
  Kept breaks_searched;         ///< breaks that were there when pairs that may touch were last looked for
  Kept searches;                ///< how often they were
  std::vector<ActingLaw> laws;  ///< of the present stage

  /// The mover of the stage has asked for the next moment, and meets it: none counts as reached half a step before.
  bool meets_moments = false;
  Moment moment_for_marks() const {
    Moment now = moment;
    if (meets_moments) now.time_step *= 1e-9;
    return now;
  }

  Domain& domain() const { return *scene.domain; }
  std::size_t stage_number() const { return static_cast<std::size_t>(moment.stage); }
  Stage& stage() const { return scene.stages[stage_number()]; }
  Mover& mover() const { return stage().mover(); }
  std::vector<Constraint>& held() { return constraints[stage_number()]; }  ///< of the present stage
  const std::vector<Constraint>& held() const { return constraints[stage_number()]; }

  /// The number of a family among those of the scene.
  Index number_of(const BondTable& table) const;
  Kept& released_by(const BondTable& table) { return released[static_cast<std::size_t>(number_of(table))]; }
  /// The number that the watcher of this name told at its last look in this stage; nothing before the first.
  std::optional<Real> told_by(const std::string& watcher) const;
  /// The lists that there are now are the run's own; what a mover lists for itself ends with its stage.
  void note_lists();
  void forget_lists_of_movers();
  /// Most constraints of any stage.
  std::size_t most_held() const;

 private:
  std::vector<std::string> lists_;  ///< that are the run's own
  void keep_constraints();
  void keep_peaks();
  void keep_watchers();
  void keep_uses();
};

}  // namespace beadwork
