#include "core/loop/contacts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/base/failure.hpp"
#include "core/domain/rows.hpp"
#include "core/loop/blame.hpp"
#include "core/loop/connect.hpp"

namespace beadwork {

namespace {

using Pairs = std::vector<std::pair<Index, Index>>;

bool has(const Pairs& sorted, const std::pair<Index, Index>& pair) {
  return std::binary_search(sorted.begin(), sorted.end(), pair);
}

}  // namespace

void Contacts::begin_stage() {
  resume_stage();
  if (!state_.stage().contacts.empty()) search();
}

void Contacts::resume_stage() {
  narrowest_ = std::numeric_limits<Real>::infinity();
  for (const ContactLaw* law : state_.stage().contacts) narrowest_ = std::min(narrowest_, skin(*law) / 2);
}

void Contacts::follow() {
  if (state_.stage().contacts.empty()) return;
  const auto breaks = static_cast<Real>(state_.domain().breaks().breaks.size());
  if (breaks == state_.breaks_searched && !are_old()) return;
  search();
  if (are_old())
    throw PhysicsFailure(
        fmt::format("an element moves by more than {:.3g} m, half of the skin of contacts, in one step of "
                    "{:.3g} s: contacts would be missed; a wider 'skin' or a smaller time step finds them",
                    narrowest_, state_.moment.time_step));
}

// The step to come is as long as the last one, or half again: velocities stand for it.
bool Contacts::are_old() const {
  const Domain& domain = state_.domain();
  const auto now = domain.elements().column("position").view<Vec3>();
  const auto then = domain.elements().column("searched-at").view<Vec3>();
  const auto velocity = domain.elements().column("velocity").view<Vec3>();
  const Real dt = 1.5 * state_.moment.time_step;
  return rows::any_of(domain.size(), [&](const auto& at) {
    using T = typename std::decay_t<decltype(at)>::Number;
    const Vec<T> moved = at(now) - at(then), step = at(velocity);
    return sqrt(dot(moved, moved)) + T(dt) * sqrt(dot(step, step)) > T(narrowest_);
  });
}

Real Contacts::skin(const ContactLaw& law) const {
  const Domain& domain = state_.domain();
  const auto radius = domain.elements().column("radius").view<Real>();
  Real smallest = std::numeric_limits<Real>::infinity();
  for (const std::string& set : *law.between)
    for (const Index row : domain.set(set)) smallest = std::min(smallest, radius[row]);
  return *law.skin * smallest;
}

// Pairs that a bond of this stage holds, or held until it broke. A broken contact that still acts holds its pair.
Pairs Contacts::held_pairs(bool broken) const {
  Pairs all;
  for (const auto& [law, table] : state_.laws) {
    if (table->is_of_contacts()) continue;
    for (Index row = 0; row < table->size(); ++row) {
      const bool holds = table->state()[row] < State::broken || law->acts_when_broken();
      if (holds != broken) all.emplace_back(table->first()[row], table->second()[row]);
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

void Contacts::search() {
  Domain& domain = state_.domain();
  const Pairs bonded = held_pairs(false);
  for (ContactLaw* law : state_.stage().contacts) meet_and_part(*law, *domain.find_family(law->family()), bonded);
  const auto position = domain.elements().column("position").view<Vec3>();
  const auto searched_at = domain.elements().column("searched-at").view<Vec3>();
  for (Index row = 0; row < domain.size(); ++row) searched_at.set(row, position[row]);
  state_.breaks_searched = static_cast<Real>(domain.breaks().breaks.size());
  domain.cut_families();
  domain.clear_halo();
  state_.scene.bind();
}

// A pair that was bonded touches from where it stands: a break makes no jump.
void Contacts::meet_and_part(ContactLaw& law, BondTable& table, const Pairs& bonded) {
  const Domain& domain = state_.domain();
  Pairs pairs = pairs_in_reach(law, domain, skin(law));
  std::erase_if(pairs, [&](const auto& pair) { return has(bonded, pair); });
  for (Index row = 0; row < table.size(); ++row)
    if (!has(pairs, {table.first()[row], table.second()[row]}))
      blaming(law, state_.moment, [&] { law.part(table, row); });
  const std::vector<Index> fresh = table.renew(pairs);
  state_.scene.bind();
  const Pairs broken = held_pairs(true);
  const auto x = domain.elements().column("position").view<Vec3>();
  const auto radius = domain.elements().column("radius").view<Real>();
  const auto length = table.rows().column("contact-length").view<Real>();
  for (const Index row : fresh) {
    const Index i = table.first()[row], j = table.second()[row];
    length[row] = radius[i] + radius[j];
    if (has(broken, {i, j})) length[row] = std::min<Real>(length[row], (x[j] - x[i]).norm());
    blaming(law, state_.moment, [&] { law.meet(domain, table, row); });
  }
}

}  // namespace beadwork
