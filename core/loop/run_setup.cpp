#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"
#include "core/domain/order.hpp"
#include "core/loop/blame.hpp"
#include "core/loop/bounded_json.hpp"
#include "core/loop/connect.hpp"
#include "core/loop/handed_over.hpp"
#include "core/loop/run.hpp"

namespace beadwork {

void Run::fill() {
  std::map<std::string, std::any> in_progress;
  FillJob job;
  job.seed = scene_.seed;
  job.say = options_.say;
  job.warn = options_.warn;
  job.report = [&](const std::string& json) {
    if (!bounded_json(json).is_object()) throw std::invalid_argument("its packing report is no JSON object: " + json.substr(0, 100));
    figures_.packing_reports.push_back(json);
  };
  job.in_progress = &in_progress;
  job.pause = [&] { pause(); };
  job.progress = options_.progress;
  for (Filler* filler : scene_.fillers) {
    pause();
    if (filler->after_filling()) continue;
    blaming(*filler, "fill", [&] { filler->fill(domain(), job); });
    check_elements(*filler, domain());
  }
  for (Filler* filler : scene_.fillers) blaming(*filler, "conclude", [&] { filler->conclude(job); });
  if (domain().size() == 0)
    throw DeckFailure(fmt::format("{}: error: the scene has no elements: no plugin of <fill> made any", scene_.deck_path));

  std::vector<Vec3> position(static_cast<std::size_t>(domain().size()));
  const auto x = domain().elements().column("position").view<Vec3>();
  for (Index row = 0; row < domain().size(); ++row) position[static_cast<std::size_t>(row)] = x[row];
  domain().reorder(hilbert_order(position));
  bind_all();
  for (Filler* filler : scene_.fillers) {
    if (!filler->after_filling()) continue;
    blaming(*filler, "fill", [&] { filler->fill(domain(), job); });
    check_elements(*filler, domain());
  }
  check_constraints();
  foresee_families();
}

// Before the first step there is nothing to save.
void Run::pause() const {
  if (!options_.interrupt || !*options_.interrupt) return;
  throw Interrupted(options_.resume
                        ? "interrupted before the first step; go on with: " + options_.commands.go_on
                        : "interrupted before the first step; nothing is saved yet, begin again with: " + options_.commands.begin_again);
}

// What the loop itself has to remember, as columns of the scene.
void Run::add_state_columns() {
  const auto keep = [&](const std::string& name, const std::string& unit, const std::string& doc) {
    domain().scene().add({name, On::scene, Type::real, unit, doc, ""}).keep();
  };
  keep("time-step", "s", "Time step");
  keep("stage-start", "s", "Time at which the stage began");
  keep("stage-step", "1", "Step at which the stage began");
  keep("bond-updates", "1", "Sum over steps of live bonds");
  keep("loop-seconds", "s", "Time spent in the loop, without checkpoints");
  keep("wall-seconds", "s", "Time spent in all");
  keep("initial-energy", "J", "Energy that was there without any work");
  ledger_.each([&](const std::string& name, Real) { keep("ledger." + name, "J", "Of the energy balance so far"); });
  quality_.each([&](const std::string& name, Real) { keep("quality." + name, "1", "Of the figures of quality so far"); });
  keep("looks-owed", "1", "Watchers that have not had their turn at this step");
  for (const std::string& family : scene_.families) keep("released." + family, "J", "Energy of broken bonds, or of all once they act no longer");
  for (auto& [criterion, use] : figures_.largest_uses)
    use.each([&, id = criterion->id()](const char* name, Real&, const char* unit) {
      keep(fmt::format("largest-use.{}.{}", id, name), unit, "Of the largest utilisation that a criterion has found so far");
    });
  looked_.resize(scene_.stages.size());
  for (std::size_t s = 0; s < scene_.stages.size(); ++s) {
    for (const Peak& peak : peaks_.emplace_back(peaks_of(constraints_[s]))) {
      keep(fmt::format("peak-force.{}.{}", s, peak.set), "N", "Largest force so far on a driven set");
      keep(fmt::format("peak-displacement.{}.{}", s, peak.set), "m", "Largest displacement so far of a driven set");
    }
    for (const auto& marks : scene_.stages[s].marks) looked_[s].emplace_back(marks.size(), 0);
    last_look_.emplace_back(scene_.stages[s].watchers.size(), -1);
    for (std::size_t w = 0; w < last_look_[s].size(); ++w) keep(fmt::format("last-look.{}.{}", s, w), "1", "Step at which a watcher looked last");
    for (std::size_t w = 0; w < looked_[s].size(); ++w)
      for (std::size_t k = 0; k < looked_[s][w].size(); ++k) keep(fmt::format("looked.{}.{}.{}", s, w, k), "1", "1 once the moment had its look");
    for (std::size_t k = 0; k < constraints_[s].size(); ++k) {
      keep(fmt::format("reaction.{}.{}", s, k), "N", "Force that keeps a constraint");
      keep(fmt::format("work.{}.{}", s, k), "J", "Work of a constraint");
    }
  }
}

void Run::create_families(Stage& stage) {
  Index next_id = domain().bonds();
  for (BondLaw* law : stage.laws) {
    if (scene_.first_stage(*law) != stage_number()) continue;
    if (moment_.step == 0) pause();
    BondTable& table = *domain().find_family(law->family());
    const Pause pausing = [this] { if (moment_.step == 0) pause(); };
    auto pairs = pairs_to_bond(*law, domain(), pausing, options_.warn);
    require_room(*law, pairs.size());
    table.create(std::move(pairs), next_id);
    next_id += table.size();
  }
}

// Bonds have an id each, and at most a row beyond the elements.
void Run::require_room(const BondLaw& law, std::size_t pairs) const {
  const std::int64_t there = std::int64_t{domain().size()} + domain().bonds();
  if (pairs > static_cast<std::size_t>(std::numeric_limits<Index>::max() - there))
    refuse(law.at(), fmt::format("{} bonds more than the {} that are there cannot be numbered", pairs, domain().bonds()));
}

void Run::gather_constraints() {
  for (const Stage& stage : scene_.stages) constraints_.push_back(stage.constraints());
}

// A load that stands outside of the stages goes on from one to the next.
void Run::begin_constraints() {
  const auto& first = scene_.stages.front().loads;
  for (Constraint& c : constraints()) {
    const bool stood = stage_number() > 0 && std::any_of(first.begin(), first.end(), [&](const Load* load) { return load->id() == c.by; });
    c.began = stood ? 0 : moment_.stage_start;
  }
}

// What the sets alone tell is told before the first stage, not after hours.
void Run::check_constraints() const {
  for (std::size_t s = 0; s < scene_.stages.size(); ++s) check_constraints(scene_.stages[s], constraints_[s]);
}

// Whether elements meet until their stage begins nobody knows; that they do not yet is worth a word.
void Run::foresee_families() const {
  for (std::size_t s = 1; s < scene_.stages.size(); ++s)
    for (const BondLaw* law : scene_.stages[s].laws)
      if (scene_.first_stage(*law) == s && !has_pairs(*law, *scene_.domain, [this] { pause(); }))
        options_.warn(fmt::format("{}: family '{}' would have no bond if stage '{}' began now: no element of '{}' touches one of '{}' yet; if it stays so, "
                                  "the run ends there",
                                  law->at().where(), *law->name, scene_.stages[s].name, (*law->between)[0], (*law->between)[1]));
}

// One degree of freedom of an element has one master.
void Run::check_constraints(const Stage& stage, std::span<const Constraint> constraints) const {
  std::map<std::pair<Index, int>, const Constraint*> taken;
  for (const Constraint& c : constraints) {
    const auto by = std::find_if(stage.loads.begin(), stage.loads.end(), [&](const Load* l) { return l->id() == c.by; });
    check_constraint(c, domain(), by != stage.loads.end() ? static_cast<const Plugin&>(**by) : stage.mover());
    for (const Index row : domain().set(c.set)) {
      const auto [there, fresh] = taken.try_emplace({row, c.axis}, &c);
      if (fresh) continue;
      const auto load = std::find_if(stage.loads.begin(), stage.loads.end(), [&](const Load* l) { return l->id() == c.by; });
      static constexpr const char* names[] = {"x", "y", "z", "rx", "ry", "rz"};
      refuse((*load)->at(), fmt::format("axis {} of an element of set '{}' is already prescribed, on set '{}' by {}", names[c.axis], c.set,
                                        there->second->set, there->second->by));
    }
  }
}

}  // namespace beadwork
