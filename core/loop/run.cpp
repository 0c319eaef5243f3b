#include "core/loop/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/base/failure.hpp"
#include "core/base/parallel.hpp"
#include "core/loop/blame.hpp"
#include "core/loop/handed_over.hpp"
#include "core/loop/run_curve.hpp"

namespace beadwork {

Run::Run(Scene& scene, const Catalogue& catalogue, RunFolder& folder, RunOptions options)
    : scene_(scene),
      catalogue_(catalogue),
      folder_(folder),
      options_(std::move(options)),
      files_(file_sums(scene.files())),
      offered_(scene),
      repeats_(options_.say),
      began_(Clock::now()),
      saved_(began_),
      shown_(began_) {
  use_threads(options_.threads);
  for (const Stage& stage : scene_.stages)
    for (const Failure* failure : stage.failures)
      if (std::none_of(figures_.largest_uses.begin(), figures_.largest_uses.end(), [&](const auto& known) { return known.first == failure; }))
        figures_.largest_uses.emplace_back(failure, LargestUse{});
  gather_constraints();
  for (const auto& stage : constraints_) quality_.follow(stage.size());
  add_state_columns();
  bind_all();
}

Run::~Run() = default;

void Run::all() {
  if (options_.resume) load();  // what is refused here leaves the folder as it was
  try {
    try {
      begin();
      go_through_stages();
      close("done", ExitCode::done, figures_.exit_reason);
    } catch (const Interrupted& stop) {
      if (can_be_saved()) save();
      close("interrupted", stop.code(), stop.what());
      throw;
    } catch (const MachineFailure&) {
      throw;
    } catch (const std::exception& failure) {
      complete_if_possible();
      const auto* fault = dynamic_cast<const Fault*>(&failure);
      close("failed", fault ? fault->code() : ExitCode::machine, failure.what());
      throw;
    }
  } catch (const MachineFailure& failure) {
    rescue(failure.what());
    throw;
  }
}

void Run::begin() {
  pause();
  if (!options_.resume) fill();
  open_record();
}

void Run::go_through_stages() {
  const auto first = stage_number();
  for (std::size_t s = first; s < scene_.stages.size(); ++s) {
    if (s > first) release(scene_.stages[s]);
    moment_.stage = static_cast<int>(s);
    const bool resumed = options_.resume && s == first;
    try {
      enter(stage(), resumed);
    } catch (const DeckFailure& refused) {
      if (s == 0) throw;
      throw PhysicsFailure(fmt::format("{}\nso stage '{}' cannot begin, at step {}", refused.what(), stage().name, moment_.step));
    }
    auto from = Clock::now();
    while (!over()) {
      step();
      const auto now = Clock::now();
      figures_.loop_seconds += std::chrono::duration<Real>(now - from).count();
      from = save_now_and_then(now) ? Clock::now() : now;  // a checkpoint is no part of the loop
    }
    figures_.exit_reason = fmt::format("stage '{}' reached {}", stage().name, stage().until->met());
    save();  // before the last looks, so that a run that is given another end goes on as if it had never stopped
    check_balance();
    look_at_end();
    tell_of_missed_moments();
  }
}

void Run::enter(Stage& stage, bool resumed) {
  whole_ = false;
  if (!resumed) {
    moment_.stage_start = moment_.time;
    moment_.stage_step = moment_.step;
    create_families(stage);
  }
  laws_.clear();
  for (BondLaw* law : stage.laws)
    if (law->acts_when_broken()) domain().find_family(law->family())->keep_broken_live();
  for (BondLaw* law : stage.laws) laws_.emplace_back(law, domain().find_family(law->family()));
  domain().cut_families();
  domain().clear_halo();  // families that act no longer leave nothing behind to be gathered
  bind_all();
  offered_.begin_stage();
  if (!resumed && moment_.step == 0 && stage_number() == 0)
    for (Derived* derived : scene_.derived) blaming(*derived, moment_, [&] { derived->derive(domain()); });  // where all begins
  if (!resumed) connect(stage);
  begin_constraints();
  rates_are_read_ = reads_rates(stage);
  for (auto& [law, table] : laws_) live_[table] = table->live();
  blaming(stage.mover(), moment_, [&] { stage.mover().prepare(*this, resumed); });
  if (!resumed) {
    count_brought();
    find_free_motions();
    check_balance();  // with the swing that is there from the start
  }
  if (watched_) reserve_room();
  whole_ = true;
  if (!resumed) return look();
  frame_anew();
  if (owed_ > 0) look(stage.watchers.size() - owed_);
}

void Run::connect(Stage& stage) {
  for (auto& [law, table] : laws_) {
    if (scene_.first_stage(*law) != stage_number()) continue;
    blaming(*law, moment_, [&, law = law, table = table] { law->connect(domain(), *table); });
    const std::string remark = blaming(*law, "remark", [&, law = law] { return law->remark(); });
    options_.say(fmt::format("bond family '{}': {} bonds{}{}", law->family(), table->size(), remark.empty() ? "" : "; ", remark));
    const std::string caution = blaming(*law, "caution", [&, law = law] { return law->caution(); });
    if (!caution.empty()) options_.warn(fmt::format("{}: bond family '{}': {}", law->at().where(), law->family(), caution));
  }
  for (Load* load : stage.loads) blaming(*load, moment_, [&] { load->clear(domain()); });
  for (Load* load : stage.loads) blaming(*load, moment_, [&] { load->start(domain()); });
}

bool Run::over() {
  if (options_.interrupt && *options_.interrupt) {
    complete();
    throw Interrupted(fmt::format("interrupted at step {}; go on with: {}", moment_.step, options_.commands.go_on));
  }
  raise(peaks_[stage_number()], moment_, constraints());
  return stage().until->reached(moment_, constraints(), peaks_[stage_number()]);
}

// Table 1 of the paper: predict, forces, Newton's law, correct; then what may break, and who looks.
void Run::step() {
  whole_ = false;
  offered_.begin_step();
  blaming(stage().mover(), moment_, [&] { stage().mover().step(*this); });
  if (rates_are_read_) complete();
  for (const auto& [law, table] : laws_) figures_.bond_updates += live_[table];
  heed_events();
  break_bonds();
  for (Load* load : stage().loads) blaming(*load, moment_, [&] { load->account(domain(), moment_); });
  whole_ = true;
  note_work();
  if (Ledger::due(moment_.step - moment_.stage_step)) check_balance();
  look();
  former_summary_.reset();  // from here on it is this session that ends, one way or another
}

// So that what summary.json says of a failed run's energies stands for one moment, and its quality knows of them.
void Run::complete_if_possible() {
  if (!whole_) return;
  try {
    look_at_balance();
  } catch (const std::exception&) {  // the failure that is being reported came first
  }
}

void Run::complete() {
  blaming(stage().mover(), moment_, [&] { stage().mover().complete(*this); });
}

void Run::evaluate(bool settle) {
  if (laws_.empty()) domain().clear_loads();
  act({true, settle, sections_wanted(), stage().mover().in_single()});
  domain().gather();
  for (Load* load : stage().loads) blaming(*load, moment_, [&] { load->push(domain(), moment_); });
}

void Run::act(Evaluation how) {
  for (auto& [law, table] : laws_) {
    blaming(*law, moment_, [&, law = law, table = table] { law->act(domain(), *table, how); });
    how.clear = false;
  }
  if (how.sections) offered_.note_told();
}

bool Run::sections_wanted() const {
  if (!offered_.is_read()) return false;
  const Stage& now = scene_.stages[stage_number()];
  for (const Failure* failure : now.failures)
    if (moment_.step % *failure->every == 0) return true;
  for (std::size_t w = 0; w < now.watchers.size(); ++w)
    if (offered_.is_read_by(*now.watchers[w]) && due(w)) return true;
  return false;
}

// Whether somebody reads velocities or spins at every step, before watchers look.
bool Run::reads_rates(const Stage& stage) const {
  const auto directly = [](const Plugin* plugin) {
    return std::any_of(plugin->uses().begin(), plugin->uses().end(), [](const FieldUse* use) {
      return use->wanted() && use->verb() == Verb::reads && (use->field().name == "velocity" || use->field().name == "spin");
    });
  };
  const auto reads = [&](const Plugin* plugin) {
    return directly(plugin) || std::any_of(scene_.derived.begin(), scene_.derived.end(), [&](const Derived* derived) { return scene_.readers_of(*derived).contains(plugin) && directly(derived); });
  };
  return std::any_of(stage.loads.begin(), stage.loads.end(), reads) || std::any_of(stage.failures.begin(), stage.failures.end(), reads);
}

// Changes that a law itself has made while settling, such as a contact that opened. What it carried was part of the step.
void Run::heed_events() {
  for (auto& [law, table] : laws_) {
    const auto events = blaming(*law, moment_, [&, law = law] { return law->events(); });
    if (events.empty()) continue;
    complete();
    look_at_first_break();
    const Real shadow = stage().mover().shadow_energy();
    BreakLog& log = domain().breaks();
    const auto x = domain().elements().column("position").view<Vec3>();
    for (const BondEvent& event : events) {
      check_rows({&event.row, 1}, table->size(), "bonds that changed", *law, moment_);
      blaming(*law, moment_, [&, law = law, table = table] { law->end(domain(), *table, event.row); });
      if (event.mode.empty()) continue;
      const Vec3 place = 0.5 * (x[table->first()[event.row]] + x[table->second()[event.row]]);
      log.breaks.push_back({moment_.time, moment_.step, static_cast<Index>(std::find(scene_.families.begin(), scene_.families.end(), table->name()) - scene_.families.begin()),
                            table->id()[event.row], log.mode(event.mode), place, event.energy});
      if (table->state()[event.row] == State::broken && !law->acts_when_broken()) offered_.clear(*table, event.row);
    }
    ledger_.note_break(shadow, stage().mover().shadow_energy());
  }
}

// All criteria see one configuration; only then do bonds break, each once, in the order of the deck's criteria.
void Run::break_bonds() {
  std::vector<std::pair<Failure*, Verdict>> verdicts;
  derived_now_.clear();
  for (Failure* failure : stage().failures) {
    if (moment_.step % *failure->every != 0) continue;
    derive_for(*failure);
    Verdict verdict = judge(*failure);
    for (auto& [criterion, use] : figures_.largest_uses)
      if (criterion == failure) use.note(verdict, domain(), *domain().find_family(failure->family()), moment_);
    if (!verdict.fallen.empty()) verdicts.emplace_back(failure, std::move(verdict));
  }
  if (verdicts.empty()) return;
  complete();  // with the forces of the bonds that break
  look_at_first_break();
  const Real shadow = stage().mover().shadow_energy();
  std::set<BondTable*> touched;
  const auto x = domain().elements().column("position").view<Vec3>();
  BreakLog& log = domain().breaks();
  for (auto& [failure, verdict] : verdicts) {
    const auto at = std::find_if(laws_.begin(), laws_.end(), [name = failure->family()](const auto& l) { return l.second->name() == name; });
    if (at == laws_.end()) continue;
    auto& [law, table] = *at;
    const auto family = static_cast<Index>(std::find(scene_.families.begin(), scene_.families.end(), table->name()) - scene_.families.begin());
    for (const Index row : verdict.fallen) {
      if (table->state()[row] == State::broken) continue;
      const Real energy = blaming(*law, moment_, [&, law = law, table = table] { return law->stored_energy(domain(), *table, row); });
      const Vec3 place = 0.5 * (x[table->first()[row]] + x[table->second()[row]]);
      log.breaks.push_back({moment_.time, moment_.step, family, table->id()[row], log.mode(blaming(*failure, moment_, [&, failure = failure] { return failure->mode(); })), place, energy});
      released_[table] += energy;
      blaming(*law, moment_, [&, law = law, table = table] { law->withdraw(domain(), *table, row); });
      table->state()[row] = State::broken;
      offered_.clear(*table, row);
      touched.insert(table);
    }
  }
  ledger_.note_break(shadow, stage().mover().shadow_energy());
  for (BondTable* table : touched) {
    table->sweep();
    live_[table] = table->live();
  }
}

Verdict Run::judge(Failure& failure) {
  Verdict verdict = blaming(failure, moment_, [&] { return offered_.judge(failure, domain()); });
  const Index bonds = domain().find_family(failure.family())->size();
  check_rows(verdict.fallen, bonds, "bonds that break", failure, moment_);
  if (verdict.row >= 0) check_rows({&verdict.row, 1}, bonds, "bonds with the largest utilisation", failure, moment_);
  return verdict;
}

void Run::look(std::size_t first) {
  const auto& watchers = stage().watchers;
  if (!watched_) {
    for (std::size_t w = 0; w < watchers.size(); ++w) note_marks(w);
    return;
  }
  derived_now_.clear();
  for (std::size_t w = first; w < watchers.size(); ++w) {
    owed_ = watchers.size() - w;
    if (due(w)) show_to(w);
  }
  owed_ = 0;
}

// The last state of a stage is seen by all its watchers, whatever their cadence.
void Run::look_at_end() {
  ending_ = true;
  derived_now_.clear();
  for (std::size_t w = 0; w < stage().watchers.size(); ++w)
    if (last_look_[stage_number()][w] != static_cast<Real>(moment_.step)) show_to(w);
  ending_ = false;
}

void Run::show_to(std::size_t watcher) {
  Watcher& who = *stage().watchers[watcher];
  complete();
  offer_to(who);
  derive_for(who);
  blaming(who, moment_, [&] { who.look(*this); });
  note_marks(watcher);
  last_look_[stage_number()][watcher] = static_cast<Real>(moment_.step);
}

// Moments of its 'at' that have come have had their look.
void Run::note_marks(std::size_t watcher) {
  const auto& marks = stage().marks[watcher];
  for (std::size_t k = 0; k < marks.size(); ++k)
    if (marks[k].reached(moment_, constraints())) looked_[stage_number()][watcher][k] = 1;
}

// What the plugin reads of derived fields, each once for all who read it.
void Run::derive_for(const Plugin& reader) {
  for (Derived* derived : scene_.derived)
    if (scene_.readers_of(*derived).contains(&reader) && derived_now_.insert(derived).second)
      blaming(*derived, moment_, [&] { derived->derive(domain()); });
}

void Run::offer_to(const Plugin& reader) {
  if (offered_.is_read_by(reader)) offer();
}

// What is read of single bonds, where it has not been found at this step on the way: the forces stay as they are.
void Run::offer() {
  if (!offered_.is_told()) {
    const LoadsAside aside(domain());
    act({true, false, true, stage().mover().in_single()});
  }
  for (Failure* failure : stage().failures) {
    if (!failure->utilisation || offered_.is_judged(*failure)) continue;
    derive_for(*failure);
    judge(*failure);
  }
}

// For its cadence, or at a moment of its 'at' that has not had its look.
bool Run::due(std::size_t watcher) const {
  const Stage& now = scene_.stages[stage_number()];
  if (blaming(*now.watchers[watcher], moment_, [&] { return now.watchers[watcher]->wants(moment_); })) return true;
  const auto& marks = now.marks[watcher];
  for (std::size_t k = 0; k < marks.size(); ++k)
    if (looked_[stage_number()][watcher][k] == 0 && marks[k].reached(moment_, constraints())) return true;
  return false;
}

// Moments of 'at' that never came, told at the end of the last stage in which their watcher stands.
void Run::tell_of_missed_moments() const {
  const auto later = scene_.stages.begin() + moment_.stage + 1;
  const Stage& now = scene_.stages[stage_number()];
  for (std::size_t w = 0; w < now.watchers.size(); ++w) {
    const Watcher& watcher = *now.watchers[w];
    if (std::any_of(later, scene_.stages.end(), [&](const Stage& stage) { return stage.watched_by(watcher); })) continue;
    for (std::size_t k = 0; k < now.marks[w].size(); ++k)
      if (!came(watcher, k)) options_.warn(fmt::format("{}: 'at' did not come to {}: {} first", now.marks[w][k].at.where(), now.marks[w][k].words(), figures_.exit_reason));
  }
}

// Whether a moment of its 'at' has come in this stage or in one before.
bool Run::came(const Watcher& watcher, std::size_t mark) const {
  for (std::size_t s = 0; s <= stage_number(); ++s) {
    const auto& watchers = scene_.stages[s].watchers;
    const auto w = static_cast<std::size_t>(std::find(watchers.begin(), watchers.end(), &watcher) - watchers.begin());
    if (w < watchers.size() && looked_[s][w][mark] == 1) return true;
  }
  return false;
}

void Run::bind_all() {
  for (const auto& plugin : scene_.plugins) plugin->bind(domain());
}

}  // namespace beadwork
