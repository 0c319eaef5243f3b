#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/sums.hpp"
#include "core/domain/vocabulary.hpp"
#include "core/dynamics/beta_damping.hpp"
#include "core/dynamics/dashpots.hpp"
#include "core/dynamics/grips.hpp"
#include "core/dynamics/law_damping.hpp"
#include "core/dynamics/local_damping.hpp"
#include "core/dynamics/rayleigh.hpp"
#include "core/dynamics/shadow.hpp"
#include "core/dynamics/stability_watch.hpp"
#include "core/dynamics/stable_step.hpp"
#include "core/dynamics/verlet_rows.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork {

/// Velocity Verlet with numerical damping beta.   Eqs (1), (2); docs/theory/verlet.md
class Verlet final : public Mover {
 public:
  static constexpr const char* about =
      "Explicit dynamics: velocity Verlet with numerical damping beta, its time step found by itself";
  Param<Real> beta{this,
                   {.name = "beta",
                    .range = {0, 1, true, false},
                    .doc = "1: no damping; below 1 inertia grows by 1/beta and high frequencies are damped, Eq (2)",
                    .fallback = "1"}};
  Param<Real> safety{this,
                     {.name = "safety",
                      .range = {0, 1, true, false},
                      .doc = "Time step over the estimate of the largest stable one",
                      .fallback = "0.9",
                      .knob = Knob::larger_is_faster}};
  Param<Real> fixed_step{
      this,
      {.name = "time-step",
       .unit = "s",
       .range = positive,
       .doc = "Time step, instead of the one found by itself; a run that exceeds stability is stopped",
       .optional = true,
       .knob = Knob::larger_is_faster}};
  Param<Real> local_damping{this,
                            {.name = "local-damping",
                             .range = {0, 1, false, true},
                             .doc = "Share of each force component that is turned against the motion (Cundall)",
                             .fallback = "0"}};
  Param<std::string> precision{this,
                               {.name = "precision",
                                .doc = "mixed: forces of beams in single precision, found from what has changed since "
                                       "they were bonded; all else in double",
                                .fallback = "double",
                                .choices = {"double", "mixed"},
                                .knob = Knob::a_choice}};
  Param<Real> bond_damping{this,
                           {.name = "bond-damping",
                            .range = {0, 1, false, true},
                            .doc = "Damping ratio of a pair of elements: dashpots beside each bond, which keep both "
                                   "momenta; bonds that soften, such as cohesive contacts, have none",
                            .fallback = "0"}};

  Keeps<Vec3> velocity{this, field::velocity};
  Keeps<Vec3> force{this, field::force};
  Keeps<Quat> orientation{this, field::orientation};
  Keeps<Vec3> spin{this, field::spin};
  Keeps<Vec3> torque{this, field::torque};
  Reads<Real> mass{this, field::mass};
  Reads<Real> inertia{this, field::inertia};
  Reads<Real> radius{this, field::radius};
  Keeps<Real> damped{this, {"damped", On::scene, "J", "Energy taken by damping"}};
  Keeps<Real> damping_power{this,
                            {"damping-power", On::scene, "W", "Power that forces of damping took at the last step"}};
  Keeps<Real> gripped{
      this, {"gripped", On::scene, "1", "Step whose bonds decided which elements without bonds a grip leaves out"}};
  Keeps<Real> rayleigh{
      this,
      {"rayleigh", On::scene, "1",
       "Rayleigh quotient of the motion at the last look, times a quarter of the squared step: 1 is beyond any step"}};
  Keeps<Real> law_lag{this,
                      {"law-lag", On::scene, "J",
                       "By how much the energy that is booked for bond laws that damp lags at the last look"}};
  Keeps<Real> stable{this, {"stable-step", On::scene, "s", "Largest stable step when the stage began"}};

  void choose_rotations(bool wanted) override {
    for (FieldUse* use : {static_cast<FieldUse*>(&orientation), static_cast<FieldUse*>(&spin),
                          static_cast<FieldUse*>(&torque), static_cast<FieldUse*>(&inertia)})
      use->want(wanted);
  }
  void check_stage(const std::string& stage, bool any_law, Complaints& complaints) const override {
    if (!any_law && !fixed_step.given())
      complaints.error(
          at(),
          fmt::format("no bonds and no contacts act in stage '{}', so nothing limits its time step: give 'time-step'",
                      stage));
  }
  std::string limited_by() const override { return step_.by; }

  void prepare(Workings& w, bool resumed) override {
    behind_ = false;
    count_ = w.domain().size();
    position_ = w.domain().elements().column("position").view<Vec3>();
    law_damping_.prepare(w);
    if (!resumed) gripped[0] = static_cast<Real>(w.moment().stage_step);
    grips_ = Grips(w, motion(), std::llround(gripped[0]));
    const std::vector<Break>& breaks = w.domain().breaks().breaks;
    seen_breaks_ = static_cast<std::size_t>(std::count_if(
        breaks.begin(), breaks.end(), [&](const Break& b) { return !resumed || b.step < w.moment().step; }));
    if (*bond_damping > 0) {
      dashpots_.prepare(w, *bond_damping, mass.view(), inertia.view(), resumed);
      if (!dashpots_.any())
        w.log().warn(fmt::format("{}: 'bond-damping' has no effect here: no bonds, or only such as soften",
                                 bond_damping.at().where()));
    }
    if (in_single() &&
        std::none_of(w.laws().begin(), w.laws().end(), [](const auto& l) { return l.first->can_be_single(); }))
      w.log().warn(
          fmt::format("{}: 'precision' has no effect here: no bonds whose forces can be found in single precision",
                      precision.at().where()));
    if (!resumed) {
      step_ = largest_step(w);
      const Real largest = step_.time_step;
      w.moment().time_step = fixed_step.given() ? *fixed_step : *safety * largest;
      if (!std::isfinite(w.moment().time_step))
        refuse(at(),
               "the bonds of this stage are none, or without stiffness, so nothing limits the time step: give "
               "'time-step'");
      w.log().say(std::isfinite(largest) ? fmt::format("time step {:.4g} s, {:.3g} of the largest stable one; {}",
                                                       w.moment().time_step, w.moment().time_step / largest, step_.by)
                                         : fmt::format("time step {:.4g} s; {}", w.moment().time_step, step_.by));
      if (w.moment().time_step > largest)
        w.log().warn(fmt::format(
            "{}: 'time-step' is {:.4g} s, the largest stable one {:.4g} s; a run that gains energy by it is stopped",
            fixed_step.at().where(), w.moment().time_step, largest));
      stable[0] = largest;
      grips_.seize(w, motion(), *beta);
      law_damping_.see(motion());
      w.evaluate(false);
      damping_power[0] = damp(w);
      damping_power[0] += dashpots_.power(velocity.view(), spin.view()) + law_damping_.power(w, motion());
      grips_.react(w, motion(), *beta);
    }
    dt_ = w.moment().time_step;
    lag_is_of_ = resumed ? w.moment().step : -1;
  }

  bool in_single() const override { return *precision == "mixed"; }

  void step(Workings& w) override {
    Moment& now = w.moment();
    heed_breaks(w);
    grips_.before_advance(w, motion());
    if (*beta < 1) beta_damping_.remember(motion());
    if ((now.step + 1) % watched_every == 0) quotient_.remember(motion());
    advance_all(w);
    grips_.after_advance(w, motion(), *beta);
    now.time += now.time_step;
    ++now.step;
    law_damping_.acts() ? evaluate_foreseen(w) : w.evaluate(true);
    const Real taken_by_local = damp(w);
    if (quotient_.remembers()) rayleigh[0] = quotient_.of_step(motion(), grips_, dt_);
    grips_.react(w, motion(), *beta);
    behind_ = true;
    if (*beta < 1 || dashpots_.any() || law_damping_.acts() || now.step % watched_every == 0) catch_up(w);
    if (*beta < 1) damped[0] += beta_damping_.taken(motion(), grips_, *beta);
    book_damping(now.time_step,
                 taken_by_local + dashpots_.power(velocity.view(), spin.view()) + law_damping_.power(w, motion()));
    if (now.step % watched_every == 0 && std::isfinite(stable[0]))
      StabilityWatch(w, motion(), stable[0]).look();  // something was bonded
  }

  void complete(Workings& w) override {
    catch_up(w);
    if (lag_is_of_ == w.moment().step) return;
    law_lag[0] = law_damping_.lag(w, motion(), dt_);
    lag_is_of_ = w.moment().step;
  }

  void energy(EnergySink& sink) const override {
    sink.kinetic(fixed_sum(count_,
                           [&](Index i) {
                             Real twice = mass[i] * velocity[i].squaredNorm();
                             if (spin) twice += inertia[i] * spin[i].squaredNorm();
                             return 0.5 * twice;
                           }) /
                 *beta);
    if (*local_damping > 0 || *bond_damping > 0 || *beta < 1 || damped[0] != 0) sink.dissipated("damping", damped[0]);
  }
  // A motion that no step resolves has no such excuse: its energy can grow while energy less swing stays as it is.
  Real swing() const override {
    return rayleigh[0] < beyond_steps
               ? shadow(motion(), grips_, dt_, *local_damping) - dashpots_.lag(motion(), dt_) - law_lag[0]
               : 0;
  }
  // Without what means hold: their reaction jumps with the forces, and the set as a whole feels nothing.
  Real shadow_energy() const override {
    return std::max(Real(0), shadow(motion(), grips_, dt_, 0) - dt_ * dt_ / 8 * grips_.held_by_means(motion()));
  }
  std::string suspect() const override { return suspect_step(dt_ / stable[0], law_damping_.acts()); }

 private:
  Motion motion() const {
    return {count_,      position_,     velocity.view(), force.view(),   orientation.view(),
            spin.view(), torque.view(), mass.view(),     inertia.view(), radius.view()};
  }

  // Local damping makes a force that slows down larger by its share, that of dashpots too, and so the stiffness that
  // limits the step. Dashpots see velocities of half a step ago, which limits it as a stiffness 2 C/dt would, and laws
  // foreseen ones, which limits it as 4 beta C/dt would; dt falls towards the one that fits.
  StepLimit largest_step(Workings& w) const {
    const auto limit = [&](Real dt) {
      StepLimit found = step_limit(
          w, mass.view(), inertia.view(),
          [&](const PairLaw& law, const BondTable& table, Index row, const Vec3& apart) -> Matrix12 {
            if (!std::isfinite(dt)) return Matrix12::Zero();
            const Matrix12 lagging = dashpots_.stiffening(table, row, apart, dt);
            return law.moves() ? Matrix12(lagging + 4 * *beta / dt * law.damping(w.domain(), table, row)) : lagging;
          });
      found.time_step /= std::sqrt(1 + *local_damping);
      return found;
    };
    StepLimit found = limit(std::numeric_limits<Real>::infinity());
    if (!dashpots_.any() && !law_damping_.acts()) return found;
    Real dt = std::isfinite(found.time_step) ? found.time_step
                                             : 1;  // s: damping alone limits it too, from whatever step one looks
    for (int round = 0; round < 100; ++round) {
      found = limit(dt);
      if (!std::isfinite(found.time_step) || std::abs(found.time_step - dt) <= 1e-5 * found.time_step) break;
      dt = found.time_step;
    }
    return found;
  }

  // Laws that read velocities see those of the step, as far as they can be known before its forces are: v + beta dt a.
  // They are exact to
  // second order; those of half a step ago, which stand there, would make it first.   docs/theory/verlet.md
  void evaluate_foreseen(Workings& w) {
    law_damping_.evaluate(
        motion(),
        [&] {
          behind_ = true;
          catch_up(w);
        },
        [&] { w.evaluate(true); });
  }

  void catch_up(Workings& w) {
    if (!behind_) return;
    const VerletRows rows = verlet(w);
    behind_ = false;
    stop_if(w, rows::any_of(count_, [&](const auto& at) { return any(rows.complete(at)); }));
    grips_.after_correct(w, motion());
  }

  // What broke since the last step pulls no longer. What broke loose of a mean is let go; what is left is held to the
  // prescribed velocity.
  void heed_breaks(Workings& w) {
    const std::vector<Break>& breaks = w.domain().breaks().breaks;
    if (seen_breaks_ == breaks.size()) return;
    const bool loosened = grips_.loosened(breaks, seen_breaks_);
    seen_breaks_ = breaks.size();
    if (loosened) {
      catch_up(w);
      gripped[0] = static_cast<Real>(w.moment().step);
      Grips anew(w, motion(), w.moment().step);
      anew.take_over(w, grips_, motion());
      grips_ = std::move(anew);
    }
    grips_.bonds_broke(w, motion(), *beta);
    if (loosened) grips_.seize(w, motion(), *beta);
  }

  VerletRows verlet(Workings& w) const { return {motion(), w.moment().time_step, 0.5 * *beta * w.moment().time_step}; }

  void advance_all(Workings& w) {
    const VerletRows rows = verlet(w);
    if (behind_) {
      for (const Index row : grips_.rows()) rows.complete(Rows<1>{row});
      grips_.after_correct(w, motion());
    }
    stop_if(w, behind_ ? rows::any_of(count_, [&](const auto& at) { return advance_behind(rows, at); })
                       : rows::any_of(count_, [&](const auto& at) { return any(rows.advance<false>(at)); }));
    behind_ = false;
  }

  // Velocities that something prescribes have been completed already.
  template <class At>
  [[gnu::always_inline]] bool advance_behind(const VerletRows& rows, const At& at) const {
    if constexpr (At::count == 1) {
      return grips_.held(at.row) ? any(rows.advance<false>(at)) : any(rows.advance<true>(at));
    } else {
      if (!grips_.holds_any(at.row, At::count)) return any(rows.advance<true>(at));
      bool broken = false;
      for (int k = 0; k < At::count; ++k) broken |= advance_behind(rows, Rows<1>{at.row + k});
      return broken;
    }
  }

  void stop_if(Workings& w, bool broken) const {
    if (broken) StabilityWatch(w, motion(), stable[0]).stop_at_force();
  }

  // The kinetic energy after a step holds half of what the forces of this step do, and half of what those of the last
  // one did.
  void book_damping(Real dt, Real power) {
    damped[0] += 0.5 * dt * (damping_power[0] + power);
    damping_power[0] = power;
  }

  // Both kinds of damping forces; the power of the local one [W].
  Real damp(Workings& w) {
    if (dashpots_.any())
      dashpots_.act(w.domain(), motion(), w.moment().step > w.moment().stage_step ? 0.5 * w.moment().time_step : 0);
    if (*local_damping == 0) return 0;
    return damp_locally(motion(), grips_, *local_damping, 0.5 * *beta * w.moment().time_step);
  }

  static constexpr std::int64_t watched_every = 100;  // steps
  static constexpr Real beyond_steps =
      0.99;  // of the Rayleigh quotient: at the usual safety of 0.9 it stays below 0.81

  Index count_ = 0;
  View<Vec3> position_;
  Grips grips_;
  Dashpots dashpots_;
  LawDamping law_damping_;
  BetaDamping beta_damping_;
  RayleighQuotient quotient_;
  std::int64_t lag_is_of_ = -1;  // step
  bool behind_ = false;          // velocities stand half a step behind the places
  Real dt_ = 0;                  // [s]
  std::size_t seen_breaks_ = 0;  // of the log, that the grips know of
  StepLimit step_;
};

}  // namespace beadwork
