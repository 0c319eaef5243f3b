#include "core/loop/breaking.hpp"

#include <algorithm>

#include "core/loop/blame.hpp"
#include "core/loop/handed_over.hpp"

namespace beadwork {

bool Breaking::is_due() const {
  const auto& failures = state_.stage().failures;
  return std::any_of(failures.begin(), failures.end(),
                     [&](const Failure* failure) { return state_.moment.step % *failure->every == 0; });
}

void Breaking::heed_events() {
  for (const auto& [law, table] : state_.laws) {
    const auto events = blaming(*law, state_.moment, [&, law = law] { return law->events(); });
    if (!events.empty()) balance_.over_break([&, law = law, table = table] { end(*law, *table, events); });
  }
}

void Breaking::end(BondLaw& law, BondTable& table, std::span<const BondEvent> events) {
  for (const BondEvent& event : events) {
    check_rows({&event.row, 1}, table.size(), "bonds that changed", law, state_.moment);
    blaming(law, state_.moment, [&] { law.end(state_.domain(), table, event.row); });
    if (event.mode.empty()) continue;
    note(table, event.row, event.mode, event.energy);
    if (table.state()[event.row] == State::broken && !law.acts_when_broken()) offered_.clear(table, event.row);
  }
}

void Breaking::judge() {
  fresh_.outdate();
  const std::vector<Fallen> all = fallen();
  if (all.empty()) return;
  balance_.over_break([&] {
    for (const Fallen& each : all) fell(each);
  });
  for (const auto& [law, table] : state_.laws)
    if (std::any_of(all.begin(), all.end(),
                    [&, family = law->family()](const Fallen& each) { return each.first->family() == family; }))
      table->sweep();
  count_live();
}

std::vector<Breaking::Fallen> Breaking::fallen() {
  std::vector<Fallen> all;
  for (Failure* failure : state_.stage().failures) {
    if (state_.moment.step % *failure->every != 0) continue;
    fresh_.for_criterion(*failure);
    Verdict verdict = fresh_.judge(*failure);
    for (auto& [criterion, use] : state_.uses)
      if (criterion == failure)
        use.note(verdict, state_.domain(), *state_.domain().find_family(failure->family()), state_.moment);
    if (!verdict.fallen.empty()) all.emplace_back(failure, std::move(verdict.fallen));
  }
  return all;
}

void Breaking::fell(const Fallen& fallen) {
  Failure& failure = *fallen.first;
  const auto acting = std::find_if(state_.laws.begin(), state_.laws.end(),
                                   [&](const ActingLaw& l) { return l.second->name() == failure.family(); });
  if (acting == state_.laws.end()) return;
  BondLaw& law = *acting->first;
  BondTable& table = *acting->second;
  for (const Index row : fallen.second) {
    if (table.state()[row] == State::broken) continue;
    const Real energy = blaming(law, state_.moment, [&] { return law.stored_energy(state_.domain(), table, row); });
    note(table, row, blaming(failure, state_.moment, [&] { return failure.mode(); }), energy);
    state_.released_by(table) += energy;
    blaming(law, state_.moment, [&] { law.withdraw(state_.domain(), table, row); });
    table.state()[row] = State::broken;
    offered_.clear(table, row);
  }
}

void Breaking::note(const BondTable& table, Index row, const std::string& mode, Real energy) {
  const auto x = state_.domain().elements().column("position").view<Vec3>();
  const Vec3 place = 0.5 * (x[table.first()[row]] + x[table.second()[row]]);
  BreakLog& log = state_.domain().breaks();
  log.breaks.push_back({state_.moment.time, state_.moment.step, state_.number_of(table), table.id()[row],
                        log.mode(mode), place, energy});
}

void Breaking::count_live() {
  live_ = 0;
  for (const auto& [law, table] : state_.laws) live_ += table->live();
}

}  // namespace beadwork
