#include "core/loop/fresh.hpp"

#include <algorithm>

#include "core/loop/blame.hpp"

namespace beadwork {

namespace {

bool reads_rates_itself(const Plugin& plugin) {
  return std::any_of(plugin.uses().begin(), plugin.uses().end(), [](const FieldUse* use) {
    return use->wanted() && use->verb() == Verb::reads &&
           (use->field().name == "velocity" || use->field().name == "spin");
  });
}

}  // namespace

Fresh::Fresh(RunState& state, Offered& offered, Forces& forces, Workings& workings)
    : state_(state), offered_(offered), forces_(forces), workings_(workings) {
  const auto note = [&](const Plugin* plugin) {
    if (reads_rates(*plugin)) rate_readers_.insert(plugin);
  };
  for (const Stage& stage : state.scene.stages) {
    std::for_each(stage.loads.begin(), stage.loads.end(), note);
    std::for_each(stage.failures.begin(), stage.failures.end(), note);
  }
}

bool Fresh::reads_rates(const Plugin& plugin) const {
  const Scene& scene = state_.scene;
  return reads_rates_itself(plugin) ||
         std::any_of(scene.derived.begin(), scene.derived.end(), [&](const Derived* derived) {
           return scene.readers_of(*derived).contains(&plugin) && reads_rates_itself(*derived);
         });
}

void Fresh::complete() {
  Mover& mover = state_.mover();
  blaming(mover, state_.moment, [&] { mover.complete(workings_); });
}

void Fresh::complete_for(const Plugin& reader) {
  if (rate_readers_.contains(&reader)) complete();
}

void Fresh::for_criterion(const Plugin& reader) {
  complete_for(reader);
  derive_for(reader);
}

void Fresh::for_watcher(const Watcher& watcher) {
  complete();
  if (offered_.is_read_by(watcher)) offer();
  derive_for(watcher);
}

void Fresh::everything() {
  complete();
  if (offered_.is_read()) offer();
  derive_all();
}

void Fresh::derive_all() {
  for (Derived* derived : state_.scene.derived)
    blaming(*derived, state_.moment, [&] { derived->derive(state_.domain()); });
}

// Each once for all who read it.
void Fresh::derive_for(const Plugin& reader) {
  for (Derived* derived : state_.scene.derived)
    if (state_.scene.readers_of(*derived).contains(&reader) && derived_.insert(derived).second)
      blaming(*derived, state_.moment, [&] { derived->derive(state_.domain()); });
}

// What is read of single bonds, where it has not been found at this step on the way.
void Fresh::offer() {
  if (!offered_.is_told()) forces_.offer();
  for (Failure* failure : state_.stage().failures) {
    if (!failure->judges() || offered_.is_judged(*failure)) continue;
    for_criterion(*failure);
    judge(*failure);
  }
}

Verdict Fresh::judge(Failure& failure) {
  return blaming(failure, state_.moment, [&] { return offered_.judge(failure, state_.domain()); });
}

}  // namespace beadwork
