#include <fmt/format.h>

#include <algorithm>

#include "core/base/failure.hpp"
#include "core/base/sums.hpp"
#include "core/loop/blame.hpp"
#include "core/loop/run.hpp"

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
    if (c.axis < 3) largest = std::max(largest, std::abs(c.reaction));
  return largest;
}

// Sum of the forces along the axis where it is largest: of all that is prescribed, or, where loads push as well, of all that moves the
// elements: forces of bonds are pairs and leave nothing in it.
Real unbalanced_force(const Domain& domain, std::span<const Constraint> constraints, bool pushed) {
  Vec3 sum = Vec3::Zero();
  if (pushed) {
    const auto force = domain.elements().column("force").view<Vec3>();
    for (int axis = 0; axis < 3; ++axis) sum[axis] = fixed_sum(domain.size(), [&](Index i) { return force.at(i, axis); });
  } else {
    for (const Constraint& c : constraints)
      if (c.axis < 3) sum[c.axis] += c.reaction;
  }
  return sum.cwiseAbs().maxCoeff();
}

bool pushes(const Load& load) {
  return std::any_of(load.uses().begin(), load.uses().end(), [](const FieldUse* use) { return use->wanted() && use->verb() == Verb::adds && use->field().name == "force"; });
}

Index fastest_element(const Domain& domain) {
  const auto velocity = domain.elements().column("velocity").view<Vec3>();
  Index fastest = 0;
  for (Index i = 1; i < domain.size(); ++i)
    if (velocity[i].squaredNorm() > velocity[fastest].squaredNorm()) fastest = i;
  return domain.elements().column("id").view<Index>()[fastest];
}

}  // namespace

void Run::energies(EnergySink& sink) const {
  for (const auto& stage : constraints_)
    for (const Constraint& c : stage) sink.work(c.set, c.work);
  for (const auto& [law, table] : laws_) {
    blaming(*law, moment_, [&, law = law, table = table] {
      sink.stored(law->family(), law->stored_energy(*scene_.domain, *table));
      sink.dissipated(law->family(), law->dissipated_energy(*scene_.domain, *table));
    });
  }
  for (const auto& family : scene_.domain->families())
    if (const auto found = released_.find(family.get()); found != released_.end()) sink.dissipated(family->name(), found->second);
  WithoutKinetic earlier(sink);
  for (const auto& plugin : scene_.plugins) {
    const bool other_mover = dynamic_cast<const Mover*>(plugin.get()) && plugin.get() != &scene_.stages[stage_number()].mover();
    blaming(*plugin, moment_, [&] { plugin->energy(other_mover ? static_cast<EnergySink&>(earlier) : sink); });
  }
}

Real Run::beyond_work() const {
  EnergySums sums;
  energies(sums);
  return sums.beyond_work();
}

// A family that does not stand in the next stage pulls no longer: what its bonds hold is lost to the balance, and what they
// have dissipated stays booked.
void Run::release(const Stage& next) {
  std::erase_if(laws_, [&](const auto& acting) {
    const auto& [law, table] = acting;
    if (std::find(next.laws.begin(), next.laws.end(), law) != next.laws.end()) return false;
    const Real held = blaming(*law, moment_, [&, law = law, table = table] { return law->stored_energy(domain(), *table); });
    released_[table] += held + blaming(*law, moment_, [&, law = law, table = table] { return law->dissipated_energy(domain(), *table); });
    options_.say(fmt::format("bond family '{}' acts no longer: the {:.4g} J that it held are booked as dissipated", law->family(), held));
    return true;
  });
  left_at_stage_end_ = beyond_work();
}

// At the start of a stage: velocities that were given, and whatever else came without work.
void Run::count_brought() {
  EnergySums sums;
  energies(sums);
  const Real came = sums.beyond_work() - left_at_stage_end_;
  initial_energy_ += came;
  quality_.note_start(std::min(sums.in_motion, came));  // what flies on from the stage before was not given
  note_work();
}

void Run::note_work() {
  Real work = 0;
  for (const auto& stage : constraints_)
    for (const Constraint& c : stage) work += c.work;
  ledger_.note_work(work, initial_energy_);
  const std::vector<Constraint>& held = constraints();
  quality_.note_load(held.size(), [&](std::size_t k) { return held[k].axis < 3 ? held[k].reaction : 0; }, !domain().breaks().breaks.empty());
}

Ledger::Verdict Run::look_at_balance() {
  complete();
  EnergySums sums;
  energies(sums);
  look_at_quality(sums);
  return ledger_.look(sums, initial_energy_, scene_.stages[stage_number()].mover().swing(), round_off());
}

// Energy from nothing is told once, and ends the run where there is more of it than was ever brought and it grows.
void Run::check_balance() {
  const auto verdict = look_at_balance();
  if (verdict == Ledger::Verdict::balanced) return;
  const Mover& mover = scene_.stages[stage_number()].mover();
  const auto surplus = fmt::format("the energy balance has an excess of {:.4g} J that no work accounts for, {:.3g} {} the largest input so far, {:.4g} J",
                                   ledger_.gained(), verdict == Ledger::Verdict::gains ? 100 * ledger_.gained() / ledger_.brought() : ledger_.gained() / ledger_.brought(),
                                   verdict == Ledger::Verdict::gains ? "% of" : "times", ledger_.brought());
  if (verdict == Ledger::Verdict::gains) {
    if (ledger_.tells()) options_.warn(fmt::format("step {}: {}; {}", moment_.step, surplus, mover.suspect()));
    return;
  }
  throw PhysicsFailure(fmt::format("step {}: {}, and it grows; element {} is the fastest; {}", moment_.step, surplus, fastest_element(domain()), mover.suspect()));
}

// Where loads prescribe something, what else could move as a whole is named.
void Run::find_free_motions() {
  std::vector<const BondTable*> tables;
  for (const auto& acting : laws_) tables.push_back(acting.second);
  free_ = domain().elements().find("mass") ? FreeMotions::find(domain(), tables, constraints(), domain().elements().find("spin") != nullptr, moment_.step) : FreeMotions();
  if (constraints().empty()) return;
  for (const std::string& line : free_.words()) options_.say(line);
}

// In the step of the first break, which is complete, with what breaks in it: all may be over before the next look is due.
void Run::look_at_first_break() {
  if (!domain().breaks().breaks.empty()) return;
  EnergySums sums;
  energies(sums);
  look_at_quality(sums);
}

// Where some stages prescribe a motion, one that prescribes none is no part of a slow test.
void Run::look_at_quality(const EnergySums& sums) {
  if (constraints().empty() && prescribes()) return;
  const auto& breaks = domain().breaks().breaks;
  const bool pushed = std::any_of(stage().loads.begin(), stage().loads.end(), [](const Load* load) { return pushes(*load); });
  quality_.look({.stored = sums.in_bonds,
                 .kinetic = sums.in_motion,
                 .load = largest_force(constraints()),
                 .imbalance = unbalanced_force(domain(), constraints(), pushed),
                 .broken = !breaks.empty()});
  if (free_.any() && (breaks.empty() || breaks.back().step <= moment_.stage_step)) quality_.note_free_motion(free_.moved(domain()), farthest_prescribed());
}

// In whichever stage.
bool Run::prescribes() const {
  return std::any_of(constraints_.begin(), constraints_.end(), [](const auto& stage) { return !stage.empty(); });
}

// So far, in whichever stage.
Real Run::farthest_prescribed() const {
  Real farthest = driven_displacement(constraints(), "", moment_.stage_start, moment_.time);
  for (const auto& stage : peaks_)
    for (const Peak& peak : stage) farthest = std::max(farthest, peak.displacement);
  return farthest;
}

QualityFigures Run::quality() const {
  QualityFigures figures;
  const Real brought = ledger_.brought();
  figures.idle = !(brought > round_off());
  if (!figures.idle) {
    figures.residual = ledger_.deviation() / brought;
    figures.lost_at_breaks = ledger_.lost_at_breaks() / brought;
  }
  const Domain& domain = *scene_.domain;
  const auto radius = domain.elements().column("radius").view<Real>();
  quality_.tell(figures, domain.size() > 0 ? fixed_sum(domain.size(), [&](Index i) { return radius[i]; }) / static_cast<Real>(domain.size()) : 0);
  figures.failed = figures_.status == "failed";
  figures.dynamic = !prescribes() || quality_.flown() > 0.1 * brought;
  return figures;
}

// Energy that would move each element by a billionth of its radius in a step: what is at rest swings by less.
Real Run::round_off() const {
  const Domain& domain = *scene_.domain;
  const Column* weights = domain.elements().find("mass");
  if (!weights || !(moment_.time_step > 0)) return 0;
  const auto mass = weights->view<Real>();
  const auto radius = domain.elements().column("radius").view<Real>();
  const Real rate = 1e-9 / moment_.time_step;
  return 0.5 * rate * rate * fixed_sum(domain.size(), [&](Index i) { return mass[i] * radius[i] * radius[i]; });
}

}  // namespace beadwork
