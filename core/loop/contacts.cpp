#include "core/loop/contacts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "core/base/failure.hpp"
#include "core/domain/nearest.hpp"
#include "core/domain/rows.hpp"
#include "core/loop/blame.hpp"
#include "core/loop/connect.hpp"
#include "core/mechanics/rotation.hpp"

namespace beadwork {

namespace {

using Pairs = std::vector<std::pair<Index, Index>>;

bool has(const Pairs& sorted, const std::pair<Index, Index>& pair) {
  return std::binary_search(sorted.begin(), sorted.end(), pair);
}

Real farthest_from(const Domain& domain, const Vec3& place) {
  const auto x = domain.elements().column("position").view<Vec3>();
  const auto radius = domain.elements().column("radius").view<Real>();
  Real far = 0;
  for (Index row = 0; row < domain.size(); ++row) far = std::max(far, (x[row] - place).norm() + radius[row]);
  return far;
}

/// Of two centres, or of a centre and the surface of a wall; infinite where it is another part of this that is touched.
Real distance_in(const Domain& domain, const BondTable& table, Index row) {
  const auto x = domain.elements().column("position").view<Vec3>();
  const Near pair = table.near(row);
  if (!table.is_of_walls()) return (x[pair.second] - x[pair.first]).norm();
  const Pose wall = domain.pose(pair.second);
  const Nearest<Real> found = nearest<Real>(domain.walls().facets(), pair.facet,
                                            rotate_back(wall.orientation, Vec3(x[pair.first] - wall.position)));
  return found.meets ? found.distance : std::numeric_limits<Real>::infinity();
}

Pairs pairs_of(const BondTable& table) {
  Pairs pairs;
  for (Index row = 0; row < table.size(); ++row) pairs.emplace_back(table.first()[row], table.second()[row]);
  return pairs;
}

/// Pairs that contacts push apart as soon as a stage begins.
struct DeepStarts {
  Index pairs = 0;
  Real deepest = 0;             ///< [m]
  Index first = 0, second = 0;  ///< rows of the deepest pair

  void note(Real overlap, Index i, Index j) {
    ++pairs;
    if (overlap > deepest) deepest = overlap, first = i, second = j;
  }
};

}  // namespace

void Contacts::begin_stage() {
  resume_stage();
  if (state_.stage().contacts.empty()) return;
  std::map<const ContactLaw*, Pairs> before;
  for (const ContactLaw* law : state_.stage().contacts)
    before[law] = pairs_of(*state_.domain().find_family(law->family()));
  begins_ = true;
  search();
  begins_ = false;
  warn_of_two_laws();
  warn_of_deep_starts(before);
}

void Contacts::resume_stage() {
  chain_ = state_.stage().contacts.empty() ? std::vector<Index>{} : chains(state_.domain());
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
        fmt::format("{} moves by more than {:.3g} m, half of the skin of contacts, in one step of "
                    "{:.3g} s: contacts would be missed; a wider 'skin' or a smaller time step finds them",
                    fastest(), narrowest_, state_.moment.time_step));
}

// All have just been looked at where they are, so the fastest is the one that outruns its skin.
std::string Contacts::fastest() const {
  const Domain& domain = state_.domain();
  const auto velocity = domain.elements().column("velocity").view<Vec3>();
  const Column* spins = domain.elements().find("spin");
  Index fastest = 0;
  Real speed = -1;
  for (Index row = 0; row < domain.size(); ++row)
    if (const Real here = Vec3(velocity[row]).norm(); here > speed) speed = here, fastest = row;
  const Walls& walls = domain.walls();
  for (Index k = 0; k < walls.size(); ++k) {
    const Index row = walls.element(k);
    const Real rim = spins ? spins->view<Vec3>()[row].norm() * walls.lever(k, narrowest_) : 0;
    if (Vec3(velocity[row]).norm() + rim > speed) speed = Vec3(velocity[row]).norm() + rim, fastest = row;
  }
  std::string what = "element";
  for (const auto& [name, set] : domain.sets())
    if (walls.is_wall(fastest) && std::binary_search(set.begin(), set.end(), fastest))
      what = "wall '" + name + "', element";
  return fmt::format("{} {}, at {:.3g} m/s,", what, domain.elements().column("id").view<Index>()[fastest], speed);
}

// How far an element of this speed may go in the step to come, which may be one back in time. A mover that meets moments
// keeps within its reach by itself.
Real Contacts::ahead(Real speed) const {
  return state_.meets_moments ? reach() : longer * std::abs(state_.moment.time_step) * speed;
}

bool Contacts::are_old() const {
  const Domain& domain = state_.domain();
  const auto now = domain.elements().column("position").view<Vec3>();
  const auto then = domain.elements().column("searched-at").view<Vec3>();
  const auto velocity = domain.elements().column("velocity").view<Vec3>();
  const Real at_rest = ahead(0), dt = ahead(1) - at_rest;
  return have_walls_turned() || rows::any_of(domain.size(), [&](const auto& at) {
           using T = typename std::decay_t<decltype(at)>::Number;
           const Vec<T> moved = at(now) - at(then), step = at(velocity);
           return sqrt(dot(moved, moved)) + T(dt) * sqrt(dot(step, step)) > T(narrowest_ - at_rest);
         });
}

// A wall that turns moves its farther points by more than its place, which `are_old` sees to.
bool Contacts::have_walls_turned() const {
  const Domain& domain = state_.domain();
  const Walls& walls = domain.walls();
  const Column* spins = domain.elements().find("spin");
  if (!walls.any() || !spins) return false;
  const auto spin = spins->view<Vec3>(), velocity = domain.elements().column("velocity").view<Vec3>();
  for (Index k = 0; k < walls.size(); ++k) {
    const Index row = walls.element(k);
    const Real moved = walls.moved(k, domain.pose(row), narrowest_),
               turns = Vec3(spin[row]).isZero() ? 0 : Vec3(spin[row]).norm() * walls.lever(k, narrowest_);
    if (moved + ahead(Vec3(velocity[row]).norm() + turns) > narrowest_) return true;
  }
  return false;
}

Real Contacts::skin(const ContactLaw& law) const {
  const Domain& domain = state_.domain();
  const auto radius = domain.elements().column("radius").view<Real>();
  Real smallest = std::numeric_limits<Real>::infinity();
  for (const std::string& set : *law.between)
    for (const Index row : domain.set(set))
      if (radius[row] > 0) smallest = std::min(smallest, radius[row]);
  return *law.skin * smallest;
}

// Pairs that a bond of this stage holds. A broken contact that still acts holds its pair.
Pairs Contacts::held_pairs() const {
  Pairs all;
  for (const auto& [law, table] : state_.laws) {
    if (table->is_of_contacts()) continue;
    for (Index row = 0; row < table->size(); ++row)
      if (table->state()[row] < State::broken || law->acts_when_broken())
        all.emplace_back(table->first()[row], table->second()[row]);
  }
  std::sort(all.begin(), all.end());
  return all;
}

// Elements of one fibre overlap from the start, also after its springs have broken.
bool Contacts::are_of_one_chain(const Near& pair) const {
  if (chain_.empty()) return false;
  const Index one = chain_[static_cast<std::size_t>(pair.first)];
  return one >= 0 && one == chain_[static_cast<std::size_t>(pair.second)];
}

// Pairs of which a bond broke, in whatever stage, and at which distance of the centres; the nearest of several.
std::map<std::pair<Index, Index>, Real> Contacts::broken_pairs() const {
  std::map<std::pair<Index, Index>, Real> all;
  const Domain& domain = state_.domain();
  for (const BondTable* table : domain.families()) {
    if (table->is_of_contacts()) continue;
    const auto broke_at = table->rows().column(field::broke_at.name).view<Real>();
    for (Index row = 0; row < table->size(); ++row) {
      if (table->state()[row] < State::broken) continue;
      const auto [there, fresh] = all.try_emplace({table->first()[row], table->second()[row]}, broke_at[row]);
      if (!fresh) there->second = std::min<Real>(there->second, broke_at[row]);
    }
  }
  return all;
}

// Both would push.
void Contacts::warn_of_two_laws() const {
  const auto& laws = state_.stage().contacts;
  for (std::size_t k = 1; k < laws.size(); ++k)
    for (std::size_t other = 0; other < k; ++other) {
      const BondTable &one = *state_.domain().find_family(laws[other]->family()),
                      &two = *state_.domain().find_family(laws[k]->family());
      Pairs both;
      const Pairs a = pairs_of(one), b = pairs_of(two);
      std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
      if (!both.empty())
        log_.warn(fmt::format(
            "{}: contacts '{}' and '{}' both act on {} pairs that are near one another, and their forces add up",
            laws[k]->at().where(), two.name(), one.name(), both.size()));
    }
}

// Pairs that a bond held until its family ended with the stage before.
Pairs Contacts::released_pairs() const {
  Pairs all;
  const Domain& domain = state_.domain();
  for (const BondTable* table : domain.families()) {
    if (table->is_of_contacts()) continue;
    for (Index row = 0; row < table->size(); ++row)
      if (table->state()[row] < State::broken) all.emplace_back(table->first()[row], table->second()[row]);
  }
  std::sort(all.begin(), all.end());
  return all;
}

// Energy that no load brings. Of pairs that were bonded less is told, as their bonds had nothing against their overlap.
void Contacts::warn_of_deep_starts(const std::map<const ContactLaw*, Pairs>& before) const {
  const Domain& domain = state_.domain();
  const auto radius = domain.elements().column("radius").view<Real>();
  const auto id = domain.elements().column("id").view<Index>();
  const Pairs were_bonded = released_pairs();
  for (const auto* law : state_.stage().contacts) {
    const BondTable& table = *domain.find_family(law->family());
    const auto length = table.rows().column("contact-length").view<Real>();
    DeepStarts released, deep;
    for (Index row = 0; row < table.size(); ++row) {
      const Index i = table.first()[row], j = table.second()[row];
      if (has(before.at(law), {i, j})) continue;
      const Real overlap = length[row] - distance_in(domain, table, row),
                 smaller = table.is_of_walls() ? radius[i] : std::min(radius[i], radius[j]);
      if (overlap > 1e-3 * smaller && has(were_bonded, {i, j}))
        released.note(overlap, i, j);
      else if (overlap > 0.1 * smaller)
        deep.note(overlap, i, j);
    }
    const auto warn = [&](const DeepStarts& starts, const char* what) {
      if (starts.pairs == 0) return;
      log_.warn(
          fmt::format("{}: stage '{}' begins with {} pairs that {}, and contacts '{}' push them apart at once: the "
                      "deepest by {:.3g} m, elements {} and {}; this energy is brought by no load",
                      law->at().where(), state_.stage().name, starts.pairs, what, law->family(), starts.deepest,
                      id[starts.first], id[starts.second]));
    };
    warn(released, "overlap and whose bonds ended with the stage before");
    warn(deep, "overlap by more than 10 % of the smaller radius");
  }
}

void Contacts::search() {
  Domain& domain = state_.domain();
  const Pairs bonded = held_pairs();
  for (ContactLaw* law : state_.stage().contacts) meet_and_part(*law, *domain.find_family(law->family()), bonded);
  const auto position = domain.elements().column("position").view<Vec3>();
  const auto searched_at = domain.elements().column("searched-at").view<Vec3>();
  for (Index row = 0; row < domain.size(); ++row) searched_at.set(row, position[row]);
  Walls& walls = domain.walls();
  const bool turning = domain.elements().find("spin");  // else nobody asks how far off elements are
  for (Index k = 0; k < walls.size(); ++k) {
    const Pose pose = domain.pose(walls.element(k));
    walls.note(k, pose, turning ? farthest_from(domain, pose.position) : 0);
  }
  state_.breaks_searched = static_cast<Real>(domain.breaks().breaks.size());
  state_.searches += 1;
  domain.cut_families();
  domain.clear_halo();
  state_.scene.bind();
}

// A pair that was bonded touches from the distance at which its bond broke: a break makes no jump. What a pair stores that
// is followed no longer, since it has been bonded, is booked as released.
void Contacts::meet_and_part(ContactLaw& law, BondTable& table, const Pairs& bonded) {
  const Domain& domain = state_.domain();
  std::vector<Near> pairs = pairs_in_reach(law, domain, skin(law));
  std::erase_if(pairs, [&](const Near& pair) {
    return has(bonded, {pair.first, pair.second}) || are_of_one_chain(pair);
  });
  for (Index row = 0; row < table.size(); ++row)
    if (!std::binary_search(pairs.begin(), pairs.end(), table.near(row))) {
      const Real held = blaming(law, state_.moment, [&] { return law.stored_energy(domain, table, row); });
      if (held != 0) state_.released_by(table) += held;
      blaming(law, state_.moment, [&] { law.part(table, row); });
    }
  const std::vector<Index> fresh = table.renew(pairs);
  state_.scene.bind();
  if (fresh.empty()) return;
  const auto broken = broken_pairs();
  const auto id = domain.elements().column("id").view<Index>();
  const auto x = domain.elements().column("position").view<Vec3>();
  const auto radius = domain.elements().column("radius").view<Real>();
  const auto length = table.rows().column("contact-length").view<Real>();
  for (const Index row : fresh) {
    const Index i = table.first()[row], j = table.second()[row];
    if (law.faces_walls()) {
      length[row] = radius[i];
      blaming(law, state_.moment, [&] { law.meet(domain, table, row); });
      continue;
    }
    if (!((x[j] - x[i]).norm() > 1e-12 * (radius[i] + radius[j])))
      throw PhysicsFailure(fmt::format(
          "{}: error: elements {} and {} stand at one place, where contacts '{}' have no direction to push in",
          law.at().where(), id[i], id[j], law.family()));
    length[row] = radius[i] + radius[j];
    const auto found = broken.find({i, j});
    if (found != broken.end()) length[row] = std::min<Real>(length[row], found->second);
    blaming(law, state_.moment, [&] { law.meet(domain, table, row); });
    // Within a stage only what a bond has left pressed overlaps from the start; what that had stored is booked as released.
    if (found != broken.end() && !begins_)
      state_.released_by(table) += -blaming(law, state_.moment, [&] { return law.stored_energy(domain, table, row); });
  }
}

}  // namespace beadwork
