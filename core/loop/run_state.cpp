#include "core/loop/run_state.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace beadwork {

namespace {

// The list of this name, with so many rows.
Table& list_of(Domain& domain, const char* name, std::size_t rows) {
  Table& list = domain.list(name);
  list.resize(static_cast<Index>(rows));
  return list;
}

template <class Nested>
std::size_t count(const Nested& by_stage) {
  std::size_t all = 0;
  for (const auto& of_stage : by_stage) all += of_stage.size();
  return all;
}

}  // namespace

RunState::RunState(Scene& s)
    : scene(s),
      bond_updates(s.domain->scene(), "bond-updates", "1", "Sum over steps of live bonds"),
      loop_seconds(s.domain->scene(), "loop-seconds", "s", "Time spent in the loop, without checkpoints"),
      wall_seconds(s.domain->scene(), "wall-seconds", "s", "Time spent in all"),
      initial_energy(s.domain->scene(), "initial-energy", "J", "Energy that was there without any work"),
      looks_owed(s.domain->scene(), "looks-owed", "1", "Watchers that have not had their turn at this step") {
  if (scene.has_contacts()) {
    breaks_searched.stand_in(domain().scene(), "breaks-searched", "1",
                             "Breaks that were there when pairs that may touch were last looked for");
    searches.stand_in(domain().scene(), "searches", "1", "How often pairs that may touch were looked for");
  }
  for (const Stage& one : scene.stages) {
    constraints.push_back(one.constraints());
    peaks.push_back(peaks_of(constraints.back()));
    auto& of_stage = watchers.emplace_back(one.watchers.size());
    for (std::size_t w = 0; w < of_stage.size(); ++w) of_stage[w].looked.resize(one.marks[w].size());
  }
  keep_constraints();
  keep_peaks();
  keep_watchers();
  keep_uses();
  Table& families = list_of(domain(), "families", scene.families.size());
  for (std::size_t k = 0; k < scene.families.size(); ++k)
    released.emplace_back(families, "released", "J", "Energy of broken bonds, or of all once they act no longer",
                          static_cast<Index>(k));
}

void RunState::note_lists() {
  for (const auto& [name, list] : domain().lists()) lists_.push_back(name);
}

void RunState::forget_lists_of_movers() {
  std::erase_if(domain().lists(),
                [&](const auto& list) { return !std::binary_search(lists_.begin(), lists_.end(), list.first); });
}

void RunState::keep_constraints() {
  Table& list = list_of(domain(), "constraints", count(constraints));
  Index row = 0;
  for (auto& of_stage : constraints)
    for (Constraint& c : of_stage) {
      c.reaction.stand_in(list, "reaction", "N", "Force that keeps a constraint", row);
      if (c.body)
        for (std::size_t axis = 0; axis < 3; ++axis)
          c.body->forces[axis].stand_in(list, fmt::format("force-{}", "xyz"[axis]), "N",
                                        "Force that keeps a body that turns", row);
      if (c.grip == Grip::mean)
        c.pinned.stand_in(list, "pinned", "1", "Element by which a static mover holds a mean, counted from 1", row);
      c.work.stand_in(list, "work", "J", "Work of a constraint", row++);
    }
}

void RunState::keep_peaks() {
  Table& list = list_of(domain(), "driven-sets", count(peaks));
  Index row = 0;
  for (auto& of_stage : peaks)
    for (Peak& peak : of_stage) {
      peak.force.stand_in(list, "force", "N", "Largest force so far on a driven set", row);
      peak.displacement.stand_in(list, "displacement", "m", "Largest displacement so far of a driven set", row++);
    }
}

void RunState::keep_watchers() {
  std::size_t moments = 0;
  for (const auto& of_stage : watchers)
    for (const WatcherState& watcher : of_stage) moments += watcher.looked.size();
  Table& list = list_of(domain(), "watchers", count(watchers));
  Table& marks = list_of(domain(), "moments", moments);
  Index row = 0, mark = 0;
  for (auto& of_stage : watchers)
    for (WatcherState& watcher : of_stage) {
      watcher.last_look.stand_in(list, "last-look", "1", "Step at which a watcher looked last", row++);
      watcher.last_look = -1;
      for (Kept& looked : watcher.looked)
        looked.stand_in(marks, "looked", "1", "1 once the moment had its look", mark++);
    }
}

void RunState::keep_uses() {
  std::vector<const Failure*> criteria;
  for (const Stage& one : scene.stages)
    for (const Failure* failure : one.failures)
      if (failure->judges() && std::find(criteria.begin(), criteria.end(), failure) == criteria.end())
        criteria.push_back(failure);
  Table& list = list_of(domain(), "criteria", criteria.size());
  for (const Failure* failure : criteria) uses.emplace_back(failure, LargestUse(list, static_cast<Index>(uses.size())));
}

Index RunState::number_of(const BondTable& table) const {
  return static_cast<Index>(std::find(scene.families.begin(), scene.families.end(), table.name()) -
                            scene.families.begin());
}

std::optional<Real> RunState::told_by(const std::string& watcher) const {
  const auto number = stage().gauge_named(watcher);
  if (!number || watchers[stage_number()][*number].last_look < 0) return std::nullopt;
  return stage().watchers[*number]->gauge()->last();
}

std::size_t RunState::most_held() const {
  std::size_t most = 0;
  for (const auto& of_stage : constraints) most = std::max(most, of_stage.size());
  return most;
}

}  // namespace beadwork
