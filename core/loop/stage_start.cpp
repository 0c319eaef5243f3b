#include "core/loop/stage_start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/base/failure.hpp"
#include "core/loop/blame.hpp"
#include "core/loop/connect.hpp"
#include "core/loop/filling.hpp"
#include "core/mechanics/rigid_turn.hpp"

namespace beadwork {

namespace {

// Bonds have an id each, and at most a row beyond the elements.
void require_room(const Domain& domain, const BondLaw& law, std::size_t pairs) {
  const std::int64_t there = std::int64_t{domain.size()} + domain.bonds();
  if (pairs > static_cast<std::size_t>(std::numeric_limits<Index>::max() - there))
    refuse(law.at(), fmt::format("{} bonds more than the {} that are there cannot be numbered", pairs, domain.bonds()));
}

bool begins_here(const RunState& state, const Plugin& plugin) {
  return state.scene.first_stage(plugin) == state.stage_number();
}

// Some of the bonds that it judges have just been made.
bool gains_a_family(const RunState& state, const Failure& failure) {
  const auto families = failure.families();
  const auto& laws = state.stage().laws;
  return std::any_of(laws.begin(), laws.end(), [&](const BondLaw* law) {
    return begins_here(state, *law) && std::find(families.begin(), families.end(), law->family()) != families.end();
  });
}

// What lies far from the origin has few digits left: strains, and motions in a step, that are smaller are lost, and no
// balance tells.
std::string lost_by_rounding(const Domain& domain, const BondTable& table) {
  constexpr Real lost = 1e-10;
  const auto place = domain.elements().column("position").view<Vec3>();
  Real rounded = 0, share = 0;
  for (Index row = 0; row < table.size(); ++row) {
    const Vec3 one = place[table.first()[row]], other = place[table.second()[row]];
    const Real here =
        std::numeric_limits<Real>::epsilon() * one.cwiseMax(-one).cwiseMax(other).cwiseMax(-other).maxCoeff();
    if (const Real of_bond = here / (other - one).norm(); of_bond > share) share = of_bond, rounded = here;
  }
  if (share <= lost) return "";
  return fmt::format(
      "its elements stand so far from the origin that their places are rounded to {:.2g} m, {:.2g} of the length of a "
      "bond: smaller strains are lost, and motions that are smaller in a step; move the scene to the origin",
      rounded, share);
}

void connect_family(RunState& state, BondLaw& law, BondTable& table, const Log& log) {
  blaming(law, state.moment, [&] { law.connect(state.domain(), table); });
  const std::string remark = blaming(law, "remark", [&] { return law.remark(); });
  log.say(
      fmt::format("bond family '{}': {} bonds{}{}", law.family(), table.size(), remark.empty() ? "" : "; ", remark));
  const std::string caution = blaming(law, "caution", [&] { return law.caution(); });
  for (const std::string& warning : {caution, lost_by_rounding(state.domain(), table)})
    if (!warning.empty()) log.warn(fmt::format("{}: bond family '{}': {}", law.at().where(), law.family(), warning));
}

// The same on resume: of places those when the turn began count.
Real lever_of(const Domain& domain, const Constraint& c) {
  const auto radius = domain.elements().column("radius").view<Real>();
  Real lever = 0;
  for (const Index row : domain.set(c.set)) {
    const Vec3 arm =
        c.body ? Circles(c.axis - 3, c.body->about).arm(domain.elements().column(c.body->from).view<Vec3>()[row])
               : Vec3(Vec3::Zero());
    lever = std::max(lever, arm.norm() + radius[row]);
  }
  return lever;
}

}  // namespace

void create_families(RunState& state, const RunOptions& options) {
  Domain& domain = state.domain();
  const Pause pause = [&] {
    if (state.moment.step == 0) pause_before_first_step(options);
  };
  Index next_id = domain.bonds();
  for (BondLaw* law : state.stage().laws) {
    if (!begins_here(state, *law)) continue;
    pause();
    BondTable& table = *domain.find_family(law->family());
    auto pairs = pairs_to_bond(*law, domain, pause, options.log);
    require_room(domain, *law, pairs.size());
    table.create(std::move(pairs), next_id);
    next_id += table.size();
  }
}

void let_laws_act(RunState& state) {
  Domain& domain = state.domain();
  state.laws.clear();
  for (BondLaw* law : state.stage().laws) {
    BondTable* table = domain.find_family(law->family());
    if (law->acts_when_broken()) table->keep_broken_live();
    state.laws.emplace_back(law, table);
  }
  for (ContactLaw* law : state.stage().contacts) {
    BondTable* table = domain.find_family(law->family());
    table->keep_broken_live();
    if (law->faces_walls()) law->see(domain.walls());
    state.laws.emplace_back(law, table);
  }
  for (Failure* failure : state.stage().failures) failure->note_spared(domain);
  domain.cut_families();
  domain.clear_halo();  // families that act no longer leave nothing behind to be gathered
  state.scene.bind();
}

void connect(RunState& state, const Log& log) {
  Domain& domain = state.domain();
  for (BondLaw* law : state.stage().laws)
    if (begins_here(state, *law)) connect_family(state, *law, *domain.find_family(law->family()), log);
  for (Failure* failure : state.stage().failures)
    if (begins_here(state, *failure) || gains_a_family(state, *failure))
      blaming(*failure, state.moment, [&] { failure->begin(domain, state.scene.seed); });
  for (Load* load : state.stage().loads) blaming(*load, state.moment, [&] { load->clear(domain); });
  for (Load* load : state.stage().loads) blaming(*load, state.moment, [&] { load->start(domain); });
}

void begin_constraints(RunState& state) {
  const auto& first = state.scene.stages.front().loads;
  for (Constraint& c : state.held()) {
    const bool stood = state.stage_number() > 0 &&
                       std::any_of(first.begin(), first.end(), [&](const Load* load) { return load->id() == c.by; });
    if (c.turns()) c.lever = lever_of(state.domain(), c);
    c.began = stood ? 0 : state.moment.stage_start;
  }
}

}  // namespace beadwork
