#include "core/loop/breaking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "core/domain/vocabulary.hpp"
#include "core/loop/blame.hpp"
#include "core/loop/handed_over.hpp"

namespace beadwork {

void Breaking::break_flaws(const Log& log) {
  for (const auto& [law, table] : state_.laws) {
    if (table->is_of_contacts() || state_.scene.first_stage(*law) != state_.stage_number()) continue;
    for (Failure* failure : state_.stage().failures)
      if (const auto of = failure->families(); std::find(of.begin(), of.end(), table->name()) != of.end())
        break_flaws_of(*table, *failure, log);
  }
}

// They are no breaks, and no reader of the log takes them for one.
void Breaking::break_flaws_of(BondTable& table, Failure& failure, const Log& log) {
  const auto rows =
      blaming(failure, state_.moment, [&] { return failure.flaws(state_.domain(), table, state_.scene.seed); });
  check_rows(rows, table.size(), "flaws", failure, state_.moment);
  for (const Index row : rows) {
    table.state()[row] = State::broken;
    note_distance(table, row);
  }
  if (!failure.judges())
    log.say(fmt::format("{}: {} of the {} bonds of '{}' are broken from the start", failure.tag(), rows.size(),
                        table.size(), table.name()));
  table.sweep();
}

namespace {

bool looks_now(const Failure& failure, const Moment& moment) {
  return failure.judges() && moment.step % *failure.every == 0;
}

}  // namespace

bool Breaking::is_due() const {
  const auto& failures = state_.stage().failures;
  return std::any_of(failures.begin(), failures.end(),
                     [&](const Failure* failure) { return looks_now(*failure, state_.moment); });
}

void Breaking::heed_events() {
  for (const auto& [law, table] : state_.laws) {
    const auto events = blaming(*law, state_.moment, [&, law = law] { return law->events(); });
    if (!events.empty()) balance_.over_break([&, law = law, table = table] { end(*law, *table, events); });
  }
}

void Breaking::end(PairLaw& law, BondTable& table, std::span<const BondEvent> events) {
  bool some_leave = false;
  for (const BondEvent& event : events) {
    check_rows({&event.row, 1}, table.size(), "bonds that changed", law, state_.moment);
    blaming(law, state_.moment, [&] { law.end(state_.domain(), table, event.row); });
    if (event.mode.empty()) continue;
    note(table, event.row, event.mode, event.energy);
    if (table.state()[event.row] != State::broken || law.acts_when_broken()) continue;
    leave(law, table, event);
    some_leave = true;
  }
  if (!some_leave) return;
  table.sweep();
  offered_.note_broken();
  count_live();
}

// From here on it takes part in nothing: what it has dissipated, and what it still stores, is booked as released. The two
// touch as any others do, also where the contact has held them pressed.
void Breaking::leave(PairLaw& law, BondTable& table, const BondEvent& event) {
  state_.released_by(table) +=
      event.energy + blaming(law, state_.moment, [&] { return law.stored_energy(state_.domain(), table, event.row); });
  blaming(law, state_.moment, [&] { law.withdraw(state_.domain(), table, event.row); });
  offered_.clear(table, event.row);
  if (Column* broke_at = table.rows().find(field::broke_at.name)) {
    const auto radius = state_.domain().elements().column("radius").view<Real>();
    const Real touch = radius[table.first()[event.row]] + radius[table.second()[event.row]];
    const auto distance = broke_at->view<Real>();
    distance[event.row] = std::max<Real>(distance[event.row], touch);
  }
}

void Breaking::judge() {
  fresh_.outdate();
  const std::vector<Fallen> all = fallen();
  if (all.empty()) return;
  balance_.over_break([&] {
    for (const Fallen& each : all) fell(each);
  });
  links_.clear();
  for (const auto& [law, table] : state_.laws) table->sweep();
  offered_.note_broken();
  fresh_.outdate();
  count_live();
}

std::vector<Breaking::Fallen> Breaking::fallen() {
  std::vector<Fallen> all;
  for (Failure* failure : state_.stage().failures) {
    if (!looks_now(*failure, state_.moment)) continue;
    fresh_.for_criterion(*failure);
    Verdict verdict = fresh_.judge(*failure);
    for (auto& [criterion, use] : state_.uses)
      if (criterion == failure) use.note(verdict.highest, state_.domain(), state_.moment);
    if (!verdict.fallen.empty()) all.emplace_back(failure, std::move(verdict.fallen));
  }
  keep_highest(all, state_.mover().breaks());
  return all;
}

// Of equal ones those that come first in the deck and in their tables.
void Breaking::keep_highest(std::vector<Fallen>& all, const Breaks& breaks) {
  std::vector<Real> utilisations;
  for (const Fallen& each : all)
    for (const Judged& judged : each.second) utilisations.push_back(judged.utilisation);
  if (utilisations.empty()) return;
  std::sort(utilisations.begin(), utilisations.end(), std::greater<>());
  const Real lowest = std::max(utilisations[std::min(breaks.at_once, utilisations.size()) - 1],
                               utilisations.front() / (1 + breaks.within));
  std::size_t left = std::min(breaks.at_once, utilisations.size());
  // what lies above the lowest falls for certain, what equals it as far as there is room
  left -= static_cast<std::size_t>(
      std::count_if(utilisations.begin(), utilisations.end(), [&](Real u) { return u > lowest; }));
  for (Fallen& each : all)
    std::erase_if(each.second, [&](const Judged& judged) {
      if (judged.utilisation > lowest) return false;
      return judged.utilisation < lowest || left == 0 || left-- == 0;
    });
  std::erase_if(all, [](const Fallen& each) { return each.second.empty(); });
}

Real Breaking::highest() {
  Real highest = 0;
  for (Failure* failure : state_.stage().failures) {
    if (!failure->judges()) continue;
    fresh_.for_criterion(*failure);
    highest = std::max(highest, fresh_.judge(*failure).highest.utilisation);
  }
  return highest;
}

void Breaking::fell(const Fallen& fallen) {
  for (const Judged& each : fallen.second) {
    if (each.table)
      fell_bond(*fallen.first, *each.table, each.row, -1);
    else
      fell_element(*fallen.first, each.row);
  }
}

void Breaking::fell_element(Failure& failure, Index row) {
  const Index id = state_.domain().elements().column("id").view<Index>()[row];
  for (const std::string& family : failure.families()) {
    BondTable& table = *state_.domain().find_family(family);
    const Links& links = links_.try_emplace(&table, table, state_.domain().size()).first->second;
    for (const Index bond : links.of(row)) fell_bond(failure, table, bond, id);
  }
  state_.domain().elements().column(failure.utilisation.field().name).view<Real>()[row] = 0;
}

// Once, whoever fells it first: criteria in the order of the deck.
void Breaking::fell_bond(Failure& failure, BondTable& table, Index row, Index element) {
  const auto acting =
      std::find_if(state_.laws.begin(), state_.laws.end(), [&](const ActingLaw& l) { return l.second == &table; });
  if (acting == state_.laws.end() || table.state()[row] == State::broken) return;
  PairLaw& law = *acting->first;
  const Real energy = blaming(law, state_.moment, [&] { return law.stored_energy(state_.domain(), table, row); });
  note(table, row, blaming(failure, state_.moment, [&] { return failure.mode(); }), energy, element);
  state_.released_by(table) += energy;
  blaming(law, state_.moment, [&] { law.withdraw(state_.domain(), table, row); });
  table.state()[row] = State::broken;
  offered_.clear(table, row);
}

void Breaking::note(BondTable& table, Index row, const std::string& mode, Real energy, Index element) {
  const auto x = state_.domain().elements().column("position").view<Vec3>();
  const Vec3 place = 0.5 * (x[table.first()[row]] + x[table.second()[row]]);
  BreakLog& log = state_.domain().breaks();
  log.breaks.push_back({state_.moment.time, state_.moment.step, state_.number_of(table), table.id()[row],
                        log.mode(mode), place, energy, element});
  note_distance(table, row);
}

// Where it touches from then on.
void Breaking::note_distance(BondTable& table, Index row) {
  const auto x = state_.domain().elements().column("position").view<Vec3>();
  if (Column* broke_at = table.rows().find(field::broke_at.name))
    broke_at->view<Real>()[row] = (x[table.second()[row]] - x[table.first()[row]]).norm();
}

void Breaking::count_live() {
  live_ = 0;
  for (const auto& [law, table] : state_.laws) live_ += table->live();
}

}  // namespace beadwork
