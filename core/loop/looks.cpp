#include "core/loop/looks.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/loop/blame.hpp"

namespace beadwork {

void Looks::look_from(std::size_t first) {
  const auto& watchers = state_.stage().watchers;
  fresh_.outdate();
  for (std::size_t w = first; w < watchers.size(); ++w) {
    state_.looks_owed = static_cast<Real>(watchers.size() - w);
    if (due(w)) turn_of(w);
  }
  state_.looks_owed = 0;
}

void Looks::look_owed() {
  const auto owed = static_cast<std::size_t>(state_.looks_owed);
  if (owed > 0) look_from(state_.stage().watchers.size() - owed);
}

void Looks::look_at_end() {
  fresh_.outdate();
  for (std::size_t w = 0; w < state_.stage().watchers.size(); ++w)
    if (remembered()[w].last_look != static_cast<Real>(state_.moment.step)) turn_of(w);
}

void Looks::pass() {
  for (std::size_t w = 0; w < state_.stage().watchers.size(); ++w) note_marks(w);
}

void Looks::show_to(Watcher& watcher) {
  fresh_.for_watcher(watcher);
  blaming(watcher, state_.moment, [&] { watcher.look(sight_); });
}

void Looks::turn_of(std::size_t watcher) {
  show_to(*state_.stage().watchers[watcher]);
  note_marks(watcher);
  remembered()[watcher].last_look = static_cast<Real>(state_.moment.step);
}

// Moments of its 'at' that have come have had their look.
void Looks::note_marks(std::size_t watcher) {
  const auto& marks = state_.stage().marks[watcher];
  for (std::size_t k = 0; k < marks.size(); ++k)
    if (marks[k].reached(state_.moment_for_marks(), state_.held())) remembered()[watcher].looked[k] = 1;
}

// For its cadence, or at a moment of its 'at' that has not had its look.
bool Looks::due(std::size_t watcher) const {
  const Stage& now = state_.stage();
  const Watcher& who = *now.watchers[watcher];
  if (blaming(who, state_.moment, [&] { return who.wants(state_.moment); })) return true;
  const auto& marks = now.marks[watcher];
  for (std::size_t k = 0; k < marks.size(); ++k)
    if (remembered()[watcher].looked[k] == 0 && marks[k].reached(state_.moment_for_marks(), state_.held())) return true;
  return false;
}

bool Looks::offer_is_due() const {
  const auto& watchers = state_.stage().watchers;
  for (std::size_t w = 0; w < watchers.size(); ++w)
    if (offered_.is_read_by(*watchers[w]) && due(w)) return true;
  return false;
}

std::vector<Mark> Looks::awaited() const {
  std::vector<Mark> marks;
  for (const auto& of_watcher : state_.stage().marks) marks.insert(marks.end(), of_watcher.begin(), of_watcher.end());
  const Until& end = *state_.stage().until;
  if (const auto time = end.time()) marks.push_back({Mark::What::time, *time, "", {}});
  if (const auto displacement = end.displacement()) marks.push_back({Mark::What::displacement, *displacement, "", {}});
  return marks;
}

Real Looks::next_moment(Real until) const {
  state_.meets_moments = true;
  const Real now = state_.moment.time, step = until - now;
  Real first = until + 1e-9 * step;
  for (const Mark& mark : awaited())
    if (const auto time = mark.time(state_.moment, state_.held(), first)) first = std::min(first, *time);
  return first < until + 1e-9 * step ? first : until;
}

void Looks::tell_of_missed_moments(const std::string& instead) const {
  const auto& stages = state_.scene.stages;
  const auto later = stages.begin() + state_.moment.stage + 1;
  const Stage& now = state_.stage();
  for (std::size_t w = 0; w < now.watchers.size(); ++w) {
    const Watcher& watcher = *now.watchers[w];
    if (std::any_of(later, stages.end(), [&](const Stage& stage) { return stage.watched_by(watcher); })) continue;
    for (std::size_t k = 0; k < now.marks[w].size(); ++k)
      if (!came(watcher, k))
        log_.warn(fmt::format("{}: 'at' did not come to {}: {} first", now.marks[w][k].at.where(),
                              now.marks[w][k].words(), instead));
  }
}

// Whether a moment of its 'at' has come in this stage or in one before.
bool Looks::came(const Watcher& watcher, std::size_t mark) const {
  for (std::size_t s = 0; s <= state_.stage_number(); ++s) {
    const auto& watchers = state_.scene.stages[s].watchers;
    const auto w = static_cast<std::size_t>(std::find(watchers.begin(), watchers.end(), &watcher) - watchers.begin());
    if (w < watchers.size() && state_.watchers[s][w].looked[mark] == 1) return true;
  }
  return false;
}

}  // namespace beadwork
