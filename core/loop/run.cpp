#include "core/loop/run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/failure.hpp"
#include "core/base/parallel.hpp"
#include "core/loop/blame.hpp"
#include "core/loop/filling.hpp"
#include "core/loop/stage_start.hpp"

namespace beadwork {

Run::Run(Scene& scene, const Catalogue& catalogue, RunFolder& folder, RunOptions options)
    : options_(std::move(options)),
      state_(scene),
      offered_(scene),
      forces_(state_, offered_),
      fresh_(state_, offered_, forces_, *this),
      balance_(state_, fresh_, options_.log),
      breaking_(state_, offered_, fresh_, balance_),
      contacts_(state_, options_.log),
      record_(state_, catalogue, folder, options_, fresh_, balance_),
      seen_(state_, balance_, record_),
      looks_(state_, fresh_, offered_, seen_, options_.log) {
  state_.note_lists();
  use_threads(options_.threads);
  scene.bind();
}

void Run::all() {
  if (options_.resume) record_.load();  // what is refused here leaves the folder as it was
  try {
    try {
      begin();
      go_through_stages();
      record_.close("done", ExitCode::done, record_.figures().exit_reason);
    } catch (const Interrupted& stop) {
      if (state_.phase == RunState::Phase::between_steps) record_.save();
      record_.close("interrupted", stop.code(), stop.what());
      throw;
    } catch (const MachineFailure&) {
      throw;
    } catch (const std::exception& failure) {
      fail(failure);
      throw;
    }
  } catch (const MachineFailure& failure) {
    record_.rescue(failure.what());
    throw;
  }
}

void Run::begin() {
  pause_before_first_step(options_);
  if (!options_.resume) fill(state_, options_, record_.figures().packing_reports);
  record_.open();
}

void Run::go_through_stages() {
  const auto first = state_.stage_number();
  for (std::size_t s = first; s < state_.scene.stages.size(); ++s) {
    if (s > first) balance_.release(state_.scene.stages[s]);
    enter_stage(s, options_.resume && s == first);
    go_on_to_end();
  }
}

void Run::enter_stage(std::size_t number, bool resumed) {
  state_.phase = RunState::Phase::within_step;
  state_.meets_moments = false;
  state_.moment.stage = static_cast<int>(number);
  try {
    resumed ? resume_stage() : begin_stage();
    record_.reserve_room();
    resumed ? look_again() : looks_.look();
  } catch (const DeckFailure& refused) {
    if (number == 0) throw;
    throw PhysicsFailure(fmt::format("{}\nso stage '{}' cannot begin, at step {}", refused.what(), state_.stage().name,
                                     state_.moment.step));
  }
}

void Run::begin_stage() {
  Moment& now = state_.moment;
  now.stage_start = now.time;
  now.stage_step = now.step;
  state_.forget_lists_of_movers();
  create_families(state_, options_);
  let_laws_act(state_);
  fresh_.begin_stage();
  if (now.step == 0 && now.stage == 0) fresh_.derive_all();  // where all begins
  connect(state_, options_.log);
  breaking_.break_flaws(options_.log);
  contacts_.begin_stage();
  prepare_stage(false);
  balance_.begin_stage();
  state_.phase = RunState::Phase::between_steps;
}

void Run::resume_stage() {
  let_laws_act(state_);
  fresh_.begin_stage();
  contacts_.resume_stage();
  prepare_stage(true);
  state_.phase = RunState::Phase::between_steps;
}

void Run::look_again() {
  record_.frame_anew();
  looks_.look_owed();
}

void Run::prepare_stage(bool resumed) {
  begin_constraints(state_);
  breaking_.begin_stage();
  Mover& mover = state_.mover();
  blaming(mover, state_.moment, [&] { mover.prepare(*this, resumed); });
}

void Run::go_on_to_end() {
  auto from = Clock::now();
  while (!over()) {
    step();
    const auto now = Clock::now();
    state_.loop_seconds += std::chrono::duration<Real>(now - from).count();
    from = record_.save_now_and_then(now) ? Clock::now() : now;  // a checkpoint is no part of the loop
  }
  record_.figures().exit_reason =
      fmt::format("stage '{}' reached {}", state_.stage().name, state_.stage().until->met());
  record_.save();  // before the last looks, so that a run that is given another end goes on as if it had never stopped
  state_.phase = RunState::Phase::after_stage;
  balance_.check();
  looks_.look_at_end();
  looks_.tell_of_missed_moments(record_.figures().exit_reason);
}

bool Run::over() {
  if (options_.is_interrupted()) {
    fresh_.complete();
    throw Interrupted(
        fmt::format("interrupted at step {}; go on with: {}", state_.moment.step, options_.commands.go_on));
  }
  std::vector<Peak>& peaks = state_.peaks[state_.stage_number()];
  raise(peaks, state_.moment, state_.held());
  return state_.stage().until->reached(state_.moment_for_marks(), state_.held(), peaks,
                                       [this](const std::string& name) { return state_.told_by(name); });
}

void Run::step() {
  advance();
  looks_.look();
  record_.note_step();
}

// Table 1 of the paper: predict, forces, Newton's law, correct; then what may break.
void Run::advance() {
  state_.phase = RunState::Phase::within_step;
  fresh_.begin_step();
  contacts_.follow();
  Mover& mover = state_.mover();
  blaming(mover, state_.moment, [&] { mover.step(*this); });
  state_.bond_updates += breaking_.live();
  breaking_.heed_events();
  breaking_.judge();
  for (Load* load : state_.stage().loads) {
    fresh_.for_account(*load);
    blaming(*load, state_.moment, [&] { load->account(state_.domain(), state_.moment); });
  }
  state_.phase = RunState::Phase::between_steps;
  balance_.note_work();
  if (balance_.is_due()) balance_.check();
}

void Run::evaluate(bool settle) {
  const bool offering = offered_.is_read() && (breaking_.is_due() || looks_.offer_is_due());
  forces_.evaluate(settle, offering);
}

Real Run::utilisation() {
  const auto& failures = state_.stage().failures;
  if (std::none_of(failures.begin(), failures.end(), [](const Failure* failure) { return failure->judges(); }))
    return 0;
  fresh_.begin_step();
  fresh_.outdate();
  forces_.evaluate(false, offered_.is_read());
  return breaking_.highest();
}

Real Run::next_moment(Real until) const { return looks_.next_moment(until); }

// Most steps end sooner, and then nothing is lost.
void Run::pause() {
  constexpr std::chrono::seconds long_enough{10};
  if (!options_.is_interrupted()) return;
  const auto now = Clock::now();
  if (!asked_to_stop_) asked_to_stop_ = now;
  if (now - *asked_to_stop_ < long_enough) return;
  const auto saved = record_.saved_step();
  throw Interrupted(fmt::format(
      "interrupted within step {}, which did not end in {} s; {}: {}", state_.moment.step, long_enough.count(),
      saved ? fmt::format("the newest checkpoint is of step {}, go on with", *saved) : "begin anew with",
      saved ? options_.commands.go_on : options_.commands.begin_again));
}

// So that what summary.json says of a failed run's energies stands for one moment, and its quality knows of them.
void Run::fail(const std::exception& failure) {
  if (state_.phase != RunState::Phase::within_step) {
    try {
      balance_.look();
    } catch (const std::exception&) {  // the failure that is being reported came first
    }
  }
  const auto* fault = dynamic_cast<const Fault*>(&failure);
  record_.close("failed", fault ? fault->code() : ExitCode::machine, failure.what());
}

}  // namespace beadwork
