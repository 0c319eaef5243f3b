#include "core/loop/filling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "core/base/failure.hpp"
#include "core/domain/order.hpp"
#include "core/loop/blame.hpp"
#include "core/loop/bounded_json.hpp"
#include "core/loop/connect.hpp"
#include "core/loop/handed_over.hpp"

namespace beadwork {

namespace {

void run_filler(RunState& state, Filler& filler, const FillJob& job) {
  blaming(filler, "fill", [&] { filler.fill(state.domain(), job); });
  check_elements(filler, state.domain());
}

// Neighbours in space become neighbours in memory. Walls stand last: they are the second of each pair.
void order_elements(RunState& state) {
  Domain& domain = state.domain();
  std::vector<Vec3> position(static_cast<std::size_t>(domain.size()));
  const auto x = domain.elements().column("position").view<Vec3>();
  for (Index row = 0; row < domain.size(); ++row) position[static_cast<std::size_t>(row)] = x[row];
  std::vector<Index> order = hilbert_order(position);
  if (domain.walls().any())
    std::stable_partition(order.begin(), order.end(), [&](Index row) { return !domain.walls().is_wall(row); });
  domain.reorder(order);
  state.scene.bind();
}

// One degree of freedom of an element has one master.
void check_constraints(const Scene& scene, std::span<const Constraint> constraints) {
  std::map<std::pair<Index, int>, const Constraint*> taken;
  const auto maker_of = [&](const Constraint& c) -> const Plugin& {
    const auto found = std::find_if(scene.plugins.begin(), scene.plugins.end(),
                                    [&](const auto& plugin) { return plugin->id() == c.by; });
    if (found == scene.plugins.end())
      throw std::logic_error(fmt::format("no plugin '{}', which constrains a set", c.by));
    return **found;
  };
  for (const Constraint& c : constraints) {
    const Plugin& by = maker_of(c);
    check_constraint(c, *scene.domain, by);
    for (const Index row : scene.domain->set(c.set))
      for (int axis = 0; axis < 6; ++axis) {
        if (!(c.prescribes() >> axis & 1)) continue;
        const auto [there, fresh] = taken.try_emplace({row, axis}, &c);
        if (fresh) continue;
        static constexpr const char* names[] = {"x", "y", "z", "rx", "ry", "rz"};
        refuse(by.at(), fmt::format("axis {} of an element of set '{}' is already prescribed, on set '{}' by {}",
                                    names[axis], c.set, there->second->set, there->second->by));
      }
  }
}

// Whether elements meet until their stage begins nobody knows; that they do not yet is worth a word.
void foresee_families(const RunState& state, const RunOptions& options) {
  const auto& stages = state.scene.stages;
  for (std::size_t s = 1; s < stages.size(); ++s)
    for (const BondLaw* law : stages[s].laws)
      if (state.scene.first_stage(*law) == s &&
          !has_pairs(*law, state.domain(), [&] { pause_before_first_step(options); }))
        options.log.warn(
            fmt::format("{}: family '{}' would have no bond if stage '{}' began now: no element of '{}' touches one of "
                        "'{}' yet; if it stays so, the run ends there",
                        law->at().where(), *law->name, stages[s].name, (*law->between)[0], (*law->between)[1]));
}

}  // namespace

void pause_before_first_step(const RunOptions& options) {
  if (!options.is_interrupted()) return;
  throw Interrupted(options.resume ? "interrupted before the first step; go on with: " + options.commands.go_on
                                   : "interrupted before the first step; nothing is saved yet, begin again with: " +
                                         options.commands.begin_again);
}

void fill(RunState& state, const RunOptions& options, std::vector<std::string>& reports) {
  const Scene& scene = state.scene;
  std::map<std::string, std::shared_ptr<PackingInProgress>> in_progress;
  const FillJob job{.seed = scene.seed,
                    .log = options.log,
                    .report =
                        [&](const std::string& json) {
                          if (!bounded_json(json).is_object())
                            throw std::invalid_argument("its packing report is no JSON object: " + json.substr(0, 100));
                          reports.push_back(json);
                        },
                    .pause = [&] { pause_before_first_step(options); },
                    .progress = options.progress,
                    .in_progress = &in_progress};
  for (Filler* filler : scene.fillers) {
    job.pause();
    if (!filler->after_filling()) run_filler(state, *filler, job);
  }
  for (Filler* filler : scene.fillers) blaming(*filler, "conclude", [&] { filler->conclude(job); });
  if (state.domain().size() == 0)
    throw DeckFailure(
        fmt::format("{}: error: the scene has no elements: no plugin of <fill> made any", scene.deck_path));
  order_elements(state);
  for (Filler* filler : scene.fillers)
    if (filler->after_filling()) run_filler(state, *filler, job);
  for (std::size_t s = 0; s < scene.stages.size(); ++s) check_constraints(scene, state.constraints[s]);
  foresee_families(state, options);
}

}  // namespace beadwork
