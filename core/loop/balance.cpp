#include "core/loop/balance.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/failure.hpp"
#include "core/base/sums.hpp"
#include "core/loop/blame.hpp"

namespace beadwork {

namespace {

// What the mover of another stage has damped counts; the elements' motion is told by the present one alone.
class WithoutKinetic final : public EnergySink {
 public:
  explicit WithoutKinetic(EnergySink& sink) : sink_(sink) {}
  void work(const std::string& by, Real joule) override { sink_.work(by, joule); }
  void stored(const std::string& in, Real joule) override { sink_.stored(in, joule); }
  void kinetic(Real) override {}
  void dissipated(const std::string& by, Real joule) override { sink_.dissipated(by, joule); }

 private:
  EnergySink& sink_;
};

Real largest_force(std::span<const Constraint> constraints) {
  Real largest = 0;
  for (const Constraint& c : constraints)
    largest = std::max({largest, std::abs(c.load()), c.body ? c.force().cwiseAbs().maxCoeff() : 0});
  return largest;
}

// Sum of the forces along the axis where it is largest: of all that is prescribed, or, where loads push as well, of all
// that moves the elements: forces of bonds are pairs and leave nothing in it.
Real unbalanced_force(const Domain& domain, std::span<const Constraint> constraints, bool pushed) {
  Vec3 sum = Vec3::Zero();
  if (pushed) {
    const auto force = domain.elements().column("force").view<Vec3>();
    for (int axis = 0; axis < 3; ++axis)
      sum[axis] = fixed_sum(domain.size(), [&](Index i) { return force.at(i, axis); });
  } else {
    for (const Constraint& c : constraints) sum += c.force();
  }
  return sum.cwiseAbs().maxCoeff();
}

bool pushes(const Load& load) {
  return std::any_of(load.uses().begin(), load.uses().end(), [](const FieldUse* use) {
    return use->wanted() && use->verb() == Verb::adds && use->field().name == "force";
  });
}

Index fastest_element(const Domain& domain) {
  const auto velocity = domain.elements().column("velocity").view<Vec3>();
  Index fastest = 0;
  for (Index i = 1; i < domain.size(); ++i)
    if (velocity[i].squaredNorm() > velocity[fastest].squaredNorm()) fastest = i;
  return domain.elements().column("id").view<Index>()[fastest];
}

}  // namespace

Balance::Balance(RunState& state, Fresh& fresh, const Log& log)
    : state_(state),
      fresh_(fresh),
      log_(log),
      ledger_(state.domain().scene()),
      quality_(state.domain(), state.most_held()) {}

void Balance::energies(EnergySink& sink) const {
  for (const auto& of_stage : state_.constraints)
    for (const Constraint& c : of_stage) sink.work(c.set, c.work);
  const Domain& domain = state_.domain();
  for (const auto& [law, table] : state_.laws) {
    blaming(*law, state_.moment, [&, law = law, table = table] {
      sink.stored(law->family(), law->stored_energy(domain, *table));
      sink.dissipated(law->family(), law->dissipated_energy(domain, *table));
    });
  }
  for (const auto& family : domain.families())
    if (const Real released = state_.released_by(*family); released != 0) sink.dissipated(family->name(), released);
  WithoutKinetic earlier(sink);
  for (const auto& plugin : state_.scene.plugins) {
    const bool other_mover = plugin->kind() == Kind::move && plugin.get() != &state_.mover();
    blaming(*plugin, state_.moment, [&] { plugin->energy(other_mover ? static_cast<EnergySink&>(earlier) : sink); });
  }
}

Real Balance::beyond_work() const {
  EnergySums sums;
  energies(sums);
  return sums.beyond_work();
}

// What the bonds of such a family hold is lost to the balance, and what they have dissipated stays booked.
void Balance::release(const Stage& next) {
  std::erase_if(state_.laws, [&](const auto& acting) {
    const auto& [law, table] = acting;
    const auto acting_next = next.plugins();
    if (std::find(acting_next.begin(), acting_next.end(), law) != acting_next.end()) return false;
    const Real held = blaming(*law, state_.moment,
                              [&, law = law, table = table] { return law->stored_energy(state_.domain(), *table); });
    state_.released_by(*table) += held + blaming(*law, state_.moment, [&, law = law, table = table] {
                                    return law->dissipated_energy(state_.domain(), *table);
                                  });
    log_.say(fmt::format("family '{}' acts no longer: the {:.4g} J that it held are booked as dissipated",
                         law->family(), held));
    return true;
  });
  left_at_stage_end_ = beyond_work();
}

void Balance::begin_stage() {
  count_brought();
  find_free_motions();
  check();  // with the swing that is there from the start
}

// At the start of a stage: velocities that were given, and whatever else came without work.
void Balance::count_brought() {
  EnergySums sums;
  energies(sums);
  const Real came = sums.beyond_work() - left_at_stage_end_;
  state_.initial_energy += came;
  quality_.note_start(std::min(sums.in_motion, came));  // what flies on from the stage before was not given
  note_work();
}

void Balance::note_work() {
  Real work = 0;
  for (const auto& of_stage : state_.constraints)
    for (const Constraint& c : of_stage) work += c.work;
  ledger_.note_work(work, state_.initial_energy);
  const std::vector<Constraint>& held = state_.held();
  quality_.note_load(
      held.size(), [&](std::size_t k) { return held[k].load(); }, !state_.domain().breaks().breaks.empty());
}

Ledger::Verdict Balance::look() {
  fresh_.complete();
  EnergySums sums;
  energies(sums);
  look_at_quality(sums);
  return ledger_.look(sums, state_.initial_energy, state_.mover().swing(), round_off());
}

void Balance::check() {
  const auto verdict = look();
  if (verdict == Ledger::Verdict::balanced) return;
  const auto surplus = fmt::format(
      "the energy balance has an excess of {:.4g} J that no work accounts for, {:.3g} {} the largest input so far, "
      "{:.4g} J",
      ledger_.gained(),
      verdict == Ledger::Verdict::gains ? 100 * ledger_.gained() / ledger_.brought()
                                        : ledger_.gained() / ledger_.brought(),
      verdict == Ledger::Verdict::gains ? "% of" : "times", ledger_.brought());
  const std::int64_t step = state_.moment.step;
  if (verdict == Ledger::Verdict::gains) {
    if (ledger_.tells()) log_.warn(fmt::format("step {}: {}; {}", step, surplus, suspect()));
    return;
  }
  throw PhysicsFailure(fmt::format("step {}: {}, and it grows; element {} is the fastest; {}", step, surplus,
                                   fastest_element(state_.domain()), suspect()));
}

// What laws find suspect in themselves comes first: the mover knows only that its step is stable. To one that goes from
// equilibrium to equilibrium the length of a step is nothing.
std::string Balance::suspect() const {
  std::string all;
  for (const auto& acting : state_.laws) {
    if (state_.meets_moments) break;
    const PairLaw& law = *acting.first;
    const std::string one =
        blaming(law, state_.moment, [&] { return law.suspect(state_.domain(), state_.moment.time_step); });
    if (!one.empty()) all += one + "; or ";
  }
  return all + state_.mover().suspect();
}

// Where loads prescribe something, what else could move as a whole is named.
void Balance::find_free_motions() {
  Domain& domain = state_.domain();
  std::vector<const BondTable*> tables;
  for (const auto& acting : state_.laws) tables.push_back(acting.second);
  const bool turning = domain.elements().find("spin") != nullptr;
  free_ = domain.elements().find("mass") ? FreeMotions::find(domain, tables, state_.held(), turning, state_.moment.step)
                                         : FreeMotions();
  if (state_.held().empty()) return;
  const char* unless = state_.stage().contacts.empty() ? "" : ", though contacts may";
  for (const std::string& line : free_.words()) log_.say(line + unless);
}

// In the step of the first break, which is complete, with what breaks in it: all may be over before the next look is
// due.
void Balance::look_at_first_break() {
  if (!state_.domain().breaks().breaks.empty()) return;
  EnergySums sums;
  energies(sums);
  look_at_quality(sums);
}

// Where some stages prescribe a motion, one that prescribes none is no part of a slow test.
void Balance::look_at_quality(const EnergySums& sums) {
  const std::vector<Constraint>& held = state_.held();
  if (held.empty() && prescribes()) return;
  const Domain& domain = state_.domain();
  const auto& breaks = domain.breaks().breaks;
  const auto& loads = state_.stage().loads;
  const bool pushed = std::any_of(loads.begin(), loads.end(), [](const Load* load) { return pushes(*load); });
  quality_.look({.stored = sums.in_bonds,
                 .kinetic = sums.in_motion,
                 .load = largest_force(held),
                 .imbalance = unbalanced_force(domain, held, pushed),
                 .broken = !breaks.empty()});
  if (free_.any() && (breaks.empty() || breaks.back().step <= state_.moment.stage_step))
    quality_.note_free_motion(free_.moved(domain), farthest_prescribed());
}

// In whichever stage.
bool Balance::prescribes() const {
  return std::any_of(state_.constraints.begin(), state_.constraints.end(),
                     [](const auto& of_stage) { return !of_stage.empty(); });
}

// So far, in whichever stage.
Real Balance::farthest_prescribed() const {
  Real farthest = driven_displacement(state_.held(), "", state_.moment.stage_start, state_.moment.time);
  for (const auto& of_stage : state_.peaks)
    for (const Peak& peak : of_stage) farthest = std::max<Real>(farthest, peak.displacement);
  return farthest;
}

QualityFigures Balance::quality(bool failed) const {
  QualityFigures figures;
  const Real brought = ledger_.brought();
  figures.idle = !(brought > round_off());
  if (!figures.idle) {
    figures.residual = ledger_.deviation() / brought;
    figures.lost_at_breaks = ledger_.lost_at_breaks() / brought;
  }
  const Domain& domain = state_.domain();
  const auto radius = domain.elements().column("radius").view<Real>();
  const Index spheres = domain.size() - domain.walls().size();
  quality_.tell(figures, spheres > 0
                             ? fixed_sum(domain.size(), [&](Index i) { return radius[i]; }) / static_cast<Real>(spheres)
                             : 0);
  figures.failed = failed;
  figures.dynamic = !prescribes() || quality_.flown() > 0.1 * brought;
  return figures;
}

// Energy that would move each element by a billionth of its radius in a step: what is at rest swings by less. What is
// held still does not swing, however large it is.
Real Balance::round_off() const {
  const Domain& domain = state_.domain();
  const Column* weights = domain.elements().find("mass");
  const Real time_step = state_.moment.time_step;
  if (!weights || !(time_step > 0)) return 0;
  std::vector<char> held(static_cast<std::size_t>(domain.size()), 0);  // axes, bit by bit
  for (const Constraint& c : state_.held())
    if (c.grip == Grip::each && !c.driven && c.axis < 3)
      for (const Index row : domain.set(c.set)) held[static_cast<std::size_t>(row)] |= static_cast<char>(1 << c.axis);
  const auto mass = weights->view<Real>();
  const auto radius = domain.elements().column("radius").view<Real>();
  const Real rate = 1e-9 / time_step;
  return 0.5 * rate * rate * fixed_sum(domain.size(), [&](Index i) {
           return held[static_cast<std::size_t>(i)] == 7 ? 0 : mass[i] * radius[i] * radius[i];
         });
}

}  // namespace beadwork
