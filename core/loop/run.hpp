#pragma once
// Runs a scene: fills it, goes through its stages step by step, lets watchers look, saves checkpoints. One way, from
// the scene to the record.

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>

#include "core/base/failure.hpp"
#include "core/base/headway.hpp"
#include "core/io/checkpoint.hpp"
#include "core/io/curve.hpp"
#include "core/io/recorder.hpp"
#include "core/io/run_folder.hpp"
#include "core/base/repeats.hpp"
#include "core/loop/frame_now.hpp"
#include "core/loop/free_motion.hpp"
#include "core/loop/largest_use.hpp"
#include "core/loop/ledger.hpp"
#include "core/loop/offered.hpp"
#include "core/loop/quality.hpp"
#include "core/loop/same_deck.hpp"
#include "core/loop/scene.hpp"

namespace beadwork {

/// What the user can paste into a shell.
struct Commands {
  std::string go_on;        ///< from the newest checkpoint
  std::string begin_again;  ///< over what has been written
};

struct RunOptions {
  int threads = 1;
  bool resume = false;
  Commands commands;
  Real checkpoint_seconds = 600;                ///< wall time between checkpoints
  Real first_checkpoint_seconds = 60;           ///< until the first one, where that is less
  const std::atomic<int>* interrupt = nullptr;  ///< not zero: write a checkpoint and stop
  std::function<void(const std::string&)> say = [](const std::string&) {};
  std::function<void(const std::string&)> warn = [](const std::string&) {};
  TellHeadway progress = [](const Headway&) {};
};

/// What a run did, for summary.json.
struct RunFigures {
  std::string status = "running";
  std::string exit_reason;
  std::optional<ExitCode> exit_code;        ///< once it has ended: by whose fault
  Real wall_seconds = 0, loop_seconds = 0;  ///< the loop's are those of steps and looks, without filling and checkpoints
  Real bond_updates = 0;
  std::vector<std::string> packing_reports;  ///< JSON objects
  std::vector<std::string> notes;            ///< what is to be known of the record, a sentence each
  std::vector<std::pair<const Failure*, LargestUse>> largest_uses;  ///< by criterion, in the order of the deck
  QualityFigures quality;
};

/// What a few steps of the first stage tell of a run, for `plan`.
struct Trial {
  Real fill_seconds = 0;  ///< filling, bonding, finding the time step
  Real time_step = 0;     ///< [s]
  std::string limited_by;
  int steps = 0;
  Real seconds_per_step = 0;  ///< without the looks of watchers
  std::vector<std::pair<const Watcher*, Real>> seconds_per_look;
};

class Run final : private Workings, private Sight {
 public:
  Run(Scene& scene, const Catalogue& catalogue, RunFolder& folder, RunOptions options);
  ~Run() override;

  /// To the end of the last stage. Throws PhysicsFailure, Interrupted or MachineFailure; what was reached is then saved,
  /// as far as the machine lets it.
  void all();
  /// Instead of all(): fills, bonds, goes on for some seconds of wall time, and has each watcher look some times, be it beyond the
  /// end of the stage. What watchers record goes to the run's folder, which is of no use afterwards.
  Trial trial(Real seconds);
  const RunFigures& figures() const { return figures_; }

 private:
  using Clock = std::chrono::steady_clock;

  // the loop (run.cpp)
  void begin();
  void go_through_stages();
  void enter(Stage& stage, bool resumed);
  void connect(Stage& stage);
  bool over();
  void step();
  void evaluate(bool settle) override;
  void act(Evaluation how);
  void complete();
  void complete_if_possible();
  bool reads_rates(const Stage& stage) const;
  void break_bonds();
  void heed_events();
  Verdict judge(Failure& failure);
  void look(std::size_t first = 0);
  void look_at_end();
  void show_to(std::size_t watcher);
  void note_marks(std::size_t watcher);
  bool due(std::size_t watcher) const;
  void tell_of_missed_moments() const;
  bool came(const Watcher& watcher, std::size_t mark) const;
  void bind_all();
  void derive_for(const Plugin& reader);
  void offer_to(const Plugin& reader);
  void offer();
  Real wall_seconds() const;
  bool sections_wanted() const;

  // a trial (run_trial.cpp)
  Real try_looks(Watcher& watcher);
  Real try_steps(Real seconds, int& steps);

  // before the loop (run_setup.cpp)
  void fill();
  void pause() const;
  void add_state_columns();
  void create_families(Stage& stage);
  void require_room(const BondLaw& law, std::size_t pairs) const;
  void gather_constraints();
  void begin_constraints();
  void check_constraints() const;
  void check_constraints(const Stage& stage, std::span<const Constraint> constraints) const;
  void foresee_families() const;

  // what is saved (run_record.cpp)
  void open_record();
  std::vector<std::filesystem::path> curves_to_cut() const;
  void frame_anew();
  std::string curve_ends();
  void store_state();
  void restore_state();
  void save();
  void load();
  void check_restored(const CheckpointMeta& meta) const;
  std::optional<std::string> ended_summary() const;
  void leave_as_found() const;
  bool save_now_and_then(Clock::time_point now);  ///< whether it saved
  void write_summary();
  std::string summary() const;
  void close(const std::string& status, ExitCode code, const std::string& reason);
  void rescue(const std::string& reason);
  bool can_be_saved() const;
  void reserve_room() const;
  void show_progress();
  RunMeta meta() const;

  // the balance (run_energy.cpp)
  void release(const Stage& next);
  void count_brought();
  Real beyond_work() const;
  void note_work();
  void check_balance();
  Ledger::Verdict look_at_balance();
  void find_free_motions();
  void look_at_quality(const EnergySums& sums);
  void look_at_first_break();
  bool prescribes() const;
  Real farthest_prescribed() const;
  QualityFigures quality() const;
  Real round_off() const;

  // Workings
  Domain& domain() override { return *scene_.domain; }
  Moment& moment() override { return moment_; }
  std::vector<Constraint>& constraints() override { return constraints_[stage_number()]; }
  std::span<const std::pair<BondLaw*, BondTable*>> laws() const override { return laws_; }
  void say(const std::string& line) override { options_.say(line); }
  void warn(const std::string& line) override { options_.warn(line); }
  void say_once(const std::string& subject, const std::string& line) override { repeats_.say(subject, line); }

  // Sight
  const Domain& domain() const override { return *scene_.domain; }
  const Moment& moment() const override { return moment_; }
  std::span<const Constraint> constraints() const override { return constraints_[stage_number()]; }
  const BondLaw* law(const std::string& family) const override { return scene_.law_of(family); }
  void energies(EnergySink& sink) const override;
  Real initial_energy() const override { return initial_energy_; }
  CurveSink& curve(const CurvePlan& plan) override;
  void frame(const FramePlan& plan) override;

  std::size_t stage_number() const { return static_cast<std::size_t>(moment_.stage); }
  Stage& stage() { return scene_.stages[stage_number()]; }
  Real& state(const std::string& name);

  Scene& scene_;
  const Catalogue& catalogue_;
  RunFolder& folder_;
  RunOptions options_;
  RunFigures figures_;
  FileSums files_;  ///< that the deck names for data
  Moment moment_;
  std::vector<std::vector<Constraint>> constraints_;  ///< by stage
  std::vector<std::vector<Peak>> peaks_;              ///< by stage
  std::vector<std::pair<BondLaw*, BondTable*>> laws_;
  std::vector<std::vector<std::vector<Real>>> looked_;  ///< by stage, watcher and moment of its 'at': 1 once it has looked
  std::vector<std::vector<Real>> last_look_;            ///< by stage and watcher: the step
  std::set<const Derived*> derived_now_;                ///< fields that stand for the present state
  Offered offered_;
  Real wall_before_ = 0;                                ///< seconds of the sessions before a restart
  std::size_t owed_ = 0;                                ///< watchers of this stage that have not had their turn at this step, last in the order
  bool rates_are_read_ = false;  ///< by loads or criteria of the stage
  bool whole_ = false;                                  ///< the state is that at the end of a step
  bool ending_ = false;                                 ///< watchers see the last state of a stage, of which there is a checkpoint
  std::map<const BondTable*, Real> released_;           ///< energy of broken bonds, and of families that act no longer [J]
  Real initial_energy_ = 0;                             ///< there without any work [J]
  Real left_at_stage_end_ = 0;                          ///< beyond_work() when the stage before ended [J]
  Ledger ledger_;
  Quality quality_;
  FreeMotions free_;  ///< of the present stage
  std::map<const BondTable*, Index> live_;
  struct OpenCurve;
  std::map<std::string, std::unique_ptr<OpenCurve>> curves_;
  std::map<std::string, CurveEnd> curve_ends_;  ///< when the newest checkpoint was written
  FrameNow frame_now_;
  Repeats repeats_;
  std::optional<Recorder> recorder_;
  bool watched_ = true;  ///< false in a trial: no watcher looks by itself
  bool has_checkpoint_ = false;
  std::optional<std::string> former_summary_;  ///< of the run that is resumed, as long as no step has been made
  std::int64_t saved_step_ = 0;  ///< of the newest checkpoint
  Clock::time_point began_, saved_, shown_;
};

}  // namespace beadwork
