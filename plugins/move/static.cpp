#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/failure.hpp"
#include "core/base/memory.hpp"
#include "core/base/text.hpp"
#include "core/domain/vocabulary.hpp"
#include "core/plugin/kinds.hpp"
#include "core/statics/event.hpp"
#include "core/statics/increments.hpp"
#include "core/statics/kept_stiffness.hpp"
#include "core/statics/newton.hpp"
#include "core/statics/scene_model.hpp"

namespace beadwork {

/// Equilibrium at each increment of the loads, without inertia.   docs/theory/statics.md
class Static final : public Mover {
 public:
  static constexpr const char* about =
      "Statics: equilibrium from increment to increment of the loads, breaking event by event";
  Param<Real> increment{this,
                        {.name = "increment",
                         .unit = "m",
                         .range = positive,
                         .doc = "How far what is pulled goes from one equilibrium to the next",
                         .one_of = "length of an increment"}};
  Param<Real> time_step{
      this,
      {.name = "time-step",
       .unit = "s",
       .range = positive,
       .doc = "Instead of 'increment': the time by which loads go on. Time tells the course of loads; "
              "inertia there is none",
       .one_of = "length of an increment"}};
  Param<Real> opening{
      this,
      {.name = "opening",
       .unit = "m",
       .range = positive,
       .doc =
           "While bonds of 'opening-of' soften: how far they open from one equilibrium to the next, in the mean; loads "
           "follow, backwards too where that takes less (snap-back), and no further than an increment",
       .optional = true}};
  Param<std::string> opening_of{this,
                                {.name = "opening-of",
                                 .doc = "Family of bonds whose opening is controlled",
                                 .optional = true,
                                 .role = Role::family}};
  Param<Real> smallest{this,
                       {.name = "smallest",
                        .range = {0, 1, true, false},
                        .doc = "Share of an increment below which it is not cut any more where no equilibrium is found",
                        .fallback = "1e-4"}};
  Param<Real> tolerance{
      this,
      {.name = "tolerance",
       .range = {0, 0.1, true, false},
       .doc = "Of residual, displacement and energy, each over what the increment does; larger is faster",
       .fallback = "1e-6"}};
  Param<std::int64_t> iterations{
      this, {.name = "iterations", .range = {2, 1000}, .doc = "Most iterations of one increment", .fallback = "25"}};
  Param<std::string> slope{
      this,
      {.name = "slope",
       .doc = "Stiffness that iterations follow: the derivative of the forces, or the secant, which "
              "is never negative: slower, and surer where bonds soften",
       .fallback = "consistent",
       .choices = {"consistent", "secant"}}};
  Param<std::string> solver{
      this,
      {.name = "solver",
       .doc = "Linear algebra: multifrontal and simplicial factor the stiffness, conjugate-gradients "
              "takes less memory and, in large scenes of solid shape, less time",
       .fallback = "multifrontal",
       .choices = linear_solvers()}};
  Param<std::string> free_bodies{
      this,
      {.name = "free",
       .doc = "What becomes of bodies that no load holds: refused with the motions that they "
              "are free to make, or pinned where they are",
       .fallback = "refuse",
       .choices = {"refuse", "pin"}}};
  Param<std::int64_t> at_once{
      this,
      {.name = "at-once",
       .range = {1},
       .doc = "Most bonds or elements that break before a new equilibrium is found; more is faster",
       .fallback = "1"}};
  Param<Real> within{this,
                     {.name = "within",
                      .range = {0, 1, false, true},
                      .doc = "What comes so near, as a share, to what breaks first may break with it; more is faster",
                      .fallback = "1e-6"}};

  Keeps<Vec3> velocity{this, field::velocity};
  Keeps<Vec3> force{this, field::force};
  Keeps<Quat> orientation{this, field::orientation};
  Keeps<Vec3> spin{this, field::spin};
  Keeps<Vec3> torque{this, field::torque};
  Reads<Real> mass{this, field::mass};
  Reads<Real> inertia{this, field::inertia};
  Reads<Real> radius{this, field::radius};
  Keeps<Real> held{this,
                   {"held", On::elements, "1",
                    "Bits of the axes along (1 2 4) and about which (8 16 32) a body that is "
                    "free is held where it is"}};
  Keeps<Real> share{this, {"increment-share", On::scene, "1", "Share of an increment that is tried next"}};
  Keeps<Real> used{this, {"utilisation", On::scene, "1", "Highest utilisation at the last equilibrium"}};
  Keeps<Real> does{this, {"increment-force", On::scene, "N", "What the last increment has changed of the forces"}};
  Keeps<Real> released{this, {"released", On::scene, "J", "Energy set free by breaks on the way to a new equilibrium"}};
  Keeps<Real> noise{this,
                    {"force-noise", On::scene, "N", "Round-off of forces, by the stiffness when the stage began"}};
  Keeps<Real> energy_noise{this, {"energy-noise", On::scene, "J", "Round-off of energies, likewise"}};
  Keeps<Real> served{
      this, {"factor-served", On::scene, "1", "Iterations that the kept stiffness has served; -1: there is none"}};
  Keeps<Real> factored_for{
      this, {"factor-supports", On::scene, "1", "Sign of the supports that the kept stiffness was factored with"}};
  Keeps<Real> negative{this, {"negative-pivots", On::scene, "1", "Most negative pivots of an equilibrium so far"}};
  Keeps<Real> spent{this, {"iterations", On::scene, "1", "Iterations so far"}};
  Keeps<Real> cuts{this, {"cuts", On::scene, "1", "Increments that were cut so far"}};
  Keeps<Real> carefully{this, {"carefully", On::scene, "1", "Increments that were tried with a new secant each time"}};
  Keeps<Real> worst{this, {"worst-residual", On::scene, "1", "Largest residual of an accepted increment"}};
  Keeps<Real> events{this, {"events", On::scene, "1", "Equilibria that were sought because something broke"}};

  void choose_rotations(bool wanted) override {
    for (FieldUse* use : {static_cast<FieldUse*>(&orientation), static_cast<FieldUse*>(&spin),
                          static_cast<FieldUse*>(&torque), static_cast<FieldUse*>(&inertia)})
      use->want(wanted);
  }
  void check(Complaints& complaints) const override {
    if (opening.given() != opening_of.given())
      complaints.error(opening.given() ? opening.at() : opening_of.at(),
                       "'opening' and 'opening-of' are given together: how far which bonds open");
    if (*slope == "consistent" && *solver == "conjugate-gradients" && slope.in_deck())
      complaints.error(slope.at(),
                       "conjugate gradients solve with a stiffness that is never negative: slope=\"secant\"");
  }
  void check_stage(const std::string& stage, bool any_law, Complaints& complaints) const override {
    if (!any_law)
      complaints.error(
          at(), fmt::format("no bonds and no contacts act in stage '{}': there is no equilibrium to find", stage));
  }
  Breaks breaks() const override { return {static_cast<std::size_t>(*at_once), *within}; }
  std::string limited_by() const override { return "the increment that the deck gives"; }

  void prepare(Workings& w, bool resumed) override {
    const NewtonLimits limits{
        *tolerance, static_cast<int>(*iterations),
        *slope == "secant" || *solver == "conjugate-gradients" ? Slope::secant : Slope::consistent};
    model_.emplace(w, StaticRows{w.domain().elements().column("position").view<Vec3>(), velocity.view(), force.view(),
                                 orientation.view(), spin.view(), torque.view(), radius.view(), held.view()});
    system_.emplace(linear_solver(*solver));
    newton_.emplace(*model_, *system_, limits);
    kept_.emplace(w.domain(), KeptStiffness::Rows{served.view(), factored_for.view()});
    const Real memory = analyse();
    seen_breaks_ =
        static_cast<std::size_t>(std::count_if(w.domain().breaks().breaks.begin(), w.domain().breaks().breaks.end(),
                                               [&](const Break& b) { return !resumed || b.step < w.moment().step; }));
    if (!resumed) {
      const SceneModel::Noise here = model_->noise_here();
      noise[0] = here.force, energy_noise[0] = here.energy;
    }
    model_->take_noise(noise[0]);
    w.next_moment(w.moment().time);  // from now on moments are met exactly
    if (resumed) {
      model_->support_as_before();
      return kept_->resume(*newton_, model_->pattern(), model_->supports());
    }
    kept_->begin(model_->pattern());
    hold(w);
    share[0] = 1, used[0] = 0, does[0] = 0;
    stand_still(w);
    w.evaluate(false);
    model_->react(false);
    w.moment().time_step = next_time(w, 1) - w.moment().time;
    w.log().say(fmt::format("statics: {} unknowns{}; {} elements that nothing binds are held where they are",
                            model_->supports().fixed.size(),
                            memory > 0 ? fmt::format(", whose stiffness and factor take {:.3g} MB", memory / 1e6) : "",
                            model_->loose()));
  }

  void step(Workings& w) override {
    heed_changes(w);
    ++w.moment().step;
    const bool begins = w.moment().step == w.moment().stage_step + 1;
    if ((broke_ || begins) && is_out_of_balance())
      settle(w);
    else
      advance(w);
    model_->accept();
    kept_->note(*newton_, *system_, model_->supports());
  }

  void energy(EnergySink& sink) const override {
    if (released[0] != 0) sink.dissipated("redistribution", released[0]);
  }
  // Round-off alone, where nothing has been done yet.
  Real swing() const override { return energy_noise[0]; }
  std::vector<MoverFigure> figures() const override {
    if (!newton_) return {};
    const NewtonCosts& costs = newton_->costs();
    return {{"unknowns", static_cast<Real>(model_->supports().fixed.size())},
            {"iterations", spent[0]},
            {"cuts", cuts[0]},
            {"careful_increments", carefully[0]},
            {"events", events[0]},
            {"worst_residual", worst[0]},
            {"negative_pivots", negative[0]},
            {"factors", static_cast<Real>(costs.factors)},
            {"factor_seconds", costs.factor_seconds},
            {"stiffness_seconds", costs.stiffness_seconds},
            {"force_seconds", costs.force_seconds},
            {"solve_seconds", costs.solve_seconds},
            {"loose_elements", static_cast<Real>(model_->loose())}};
  }

 private:
  void stand_still(Workings& w) {
    for (Index i = 0; i < w.domain().size(); ++i) {
      velocity.set(i, Vec3::Zero());
      if (spin) spin.set(i, Vec3::Zero());
    }
  }

  // Before a factor is allocated it is known how large it will be.
  Real analyse() {
    newton_->forget_factor();
    const Real memory = system_->analyse(model_->take_pairs());
    if (memory > memory_at_most())
      refuse(at(),
             fmt::format("the factor of the stiffness of {} unknowns takes {:.3g} GB, and there are {:.3g} GB: fewer "
                         "elements, or solver=\"conjugate-gradients\" with slope=\"secant\", which takes a "
                         "tenth",
                         model_->unknowns(), memory / 1e9, memory_at_most() / 1e9));
    return memory;
  }

  // What is free is pinned where the deck asks for it, and where a break has made it so.
  void hold(Workings& w) {
    const bool broken = !w.domain().breaks().breaks.empty();
    const auto free = model_->support(broken || *free_bodies == "pin");
    if (free.empty()) return;
    if (!broken && *free_bodies == "refuse") {
      const FreeBody& body = free.front();
      const auto id = w.domain().elements().column("id").view<Index>();
      refuse(at(),
             fmt::format("nothing holds a body of {} elements, of which element {} is one, against this: it can {}{}; "
                         "hold it (a mean is enough: grip=\"mean\"), or free=\"pin\" keeps it where it is",
                         body.members.size(), id[body.members.front()], join(names_of(body.modes), ", "),
                         free.size() > 1 ? fmt::format("; so can {} others in some way", free.size() - 1) : ""));
    }
    w.log().say_once(fmt::format("pinned {}", free.size()),
                     fmt::format("step {}: {} bodies that no load holds are pinned where they are, as few motions as "
                                 "they are free to make",
                                 w.moment().step, free.size()));
  }

  void heed_changes(Workings& w) {
    const std::size_t breaks = w.domain().breaks().breaks.size();
    broke_ = breaks != seen_breaks_;
    seen_breaks_ = breaks;
    const bool meets = model_->has_other_pairs();
    if (meets) analyse();
    if (broke_ || meets) hold(w);  // what was loose may touch something now
    kept_->heed(*newton_, model_->supports());
  }

  // What broke pulls at the supports no more. Contacts that have opened by themselves leave nothing out of balance; what a
  // criterion fells does.
  bool is_out_of_balance() {
    const Vector f = model_->forces();
    model_->react(false);
    return model_->supports().unbalanced(f).norm() > *tolerance * does[0] + model_->noise();
  }

  /// The equilibrium at the present loads, once something has broken, or where a stage begins with loads on it.
  void settle(Workings& w) {
    const NewtonResult result = go(w, w.moment().time);
    if (!result.converged()) fail(w, result, 0);
    events[0] += 1;
    released[0] += model_->work_on_the_way();
    does[0] = std::max(result.reference, does[0]);
    worst[0] = std::max(worst[0], result.residual);
    used[0] = std::min<Real>(1, w.utilisation());
  }

  /// The next increment, cut until there is an equilibrium, and to where something breaks.
  void advance(Workings& w) {
    IncrementShare tried(share[0], *smallest);
    const Real from = w.moment().time;
    if (opening.given() && advance_by_opening(w, tried, true)) return;
    for (;;) {
      const Real to = next_time(w, tried.share());
      NewtonResult result = go(w, to);
      if (result.converged()) {
        tried.grow(result.iterations, static_cast<int>(*iterations));
        stop_at_event(w, from, to, result);
        does[0] = std::max(result.reference, does[0]);
        worst[0] = std::max(worst[0], result.residual);
        return;
      }
      model_->give_up();
      newton_->forget_factor();
      if (opening.given() && advance_by_opening(w, tried, false)) return;
      if (!tried.cut()) fail(w, result, to - from);
      note_cut(w, tried, result);
    }
  }

  /// A step in which bonds open by what the deck says. False where none of them opens, or where loads would go further
  /// than an increment.
  bool advance_by_opening(Workings& w, IncrementShare& tried, bool softening_only) {
    const auto gradient = model_->opening(*opening_of, softening_only);
    if (!gradient) return false;
    const Real from = w.moment().time, longest = next_time(w, 1);
    for (;;) {
      newton_->forget_factor();
      const NewtonResult result = newton_->go_by(*gradient, tried.share() * *opening);
      spent[0] += result.iterations;
      if (result.converged()) {
        if (w.moment().time > longest) return model_->give_up(), false;
        w.moment().time_step = w.moment().time - from;
        tried.grow(result.iterations, static_cast<int>(*iterations));
        worst[0] = std::max(worst[0], result.residual);
        used[0] = w.utilisation();
        return true;
      }
      model_->give_up();
      if (!tried.cut()) fail(w, result, 0);
      note_cut(w, tried, result);
    }
  }

  void note_cut(Workings& w, const IncrementShare& tried, const NewtonResult& result) {
    cuts[0] += 1;
    w.log().say(fmt::format("step {}: increment cut to {:.3g} of the whole: {}", w.moment().step, tried.share(),
                            told(w, result)));
  }

  NewtonResult go(Workings& w, Real to) {
    w.moment().time_step = to - w.moment().time;
    NewtonResult result;
    for (const Manner manner : {Manner::quick, Manner::thorough, Manner::careful}) {
      if (manner == Manner::careful && opening.given()) break;  // it knows another way
      if (manner != Manner::quick) model_->give_up(), w.moment().time_step = to - w.moment().time;
      result = newton_->go(to, manner);
      spent[0] += result.iterations;
      const bool done = result.converged() || result.reason == Reason::singular;
      if (manner == Manner::careful) carefully[0] += 1;
      if (!done || manner == Manner::careful) newton_->forget_factor();  // the secant one is none to go on with
      if (done) break;
    }
    if (result.negative > 0) {
      negative[0] = std::max(negative[0], static_cast<Real>(result.negative));
      w.log().say_once(
          "unstable", fmt::format("step {}: {} pivots of the stiffness are negative at the last equilibrium: it is not "
                                  "stable, or a snap or a bifurcation lies near; which way a real body takes, its "
                                  "imperfections decide",
                                  w.moment().step, result.negative));
    }
    if (result.converged() && result.weakest >= 0)
      w.log().say_once("mechanism",
                       fmt::format("step {}: {}; no load asks for it, and it stays", w.moment().step, told(w, result)));
    return result;
  }

  void stop_at_event(Workings& w, Real from, Real to, NewtonResult& result) {
    const Real after = w.utilisation();
    if (!(after > 1 + *within)) {
      used[0] = after;
      return;
    }
    EventSearch search(std::min<Real>(used[0], 1), after, *within);
    for (int round = 0; round < 60; ++round) {
      const Real part = search.next();
      model_->give_up();
      result = go(w, from + part * (to - from));
      if (!result.converged()) fail(w, result, part * (to - from));
      const Real utilisation = w.utilisation();
      used[0] = std::min<Real>(1, utilisation);
      if (search.take(part, utilisation)) return;
    }
    throw PhysicsFailure(
        fmt::format("step {}: the load at which something breaks could not be found: the utilisation "
                    "does not follow the load; a smaller increment, or a larger 'within'",
                    w.moment().step));
  }

  Real next_time(Workings& w, Real share_of_whole) {
    const Real now = w.moment().time;
    if (time_step.given()) return w.next_moment(now + share_of_whole * *time_step);
    const auto to = time_of_displacement(w.constraints(), now, share_of_whole * *increment);
    if (!to) {
      constexpr Real ever = 1e9;  // s: for whatever the stage still waits
      const Real next = w.next_moment(now + ever);
      if (next < now + 0.5 * ever) return next;
      refuse(increment.at(),
             "nothing is pulled any further in this stage, so that 'increment' never ends: give "
             "'time-step' instead");
    }
    return w.next_moment(*to);
  }

  std::string told(Workings& w, const NewtonResult& result) const {
    std::string words = fmt::format("{} after {} iterations, residual {:.2g}", in_words(result.reason),
                                    result.iterations, result.residual);
    if (result.weakest >= 0)
      words += fmt::format("; nothing resists a motion of element {} {}",
                           w.domain().elements().column("id").view<Index>()[model_->element_of(result.weakest)],
                           model_->axis_of(result.weakest));
    return words;
  }

  [[noreturn]] void fail(Workings& w, const NewtonResult& result, Real step) {
    model_->give_up();
    throw PhysicsFailure(fmt::format("{}: step {}: no equilibrium was found {} s further: {}", at().where(),
                                     w.moment().step, step, told(w, result)));
  }

  std::optional<SceneModel> model_;
  std::optional<SupportedSystem> system_;
  std::optional<Newton> newton_;
  std::optional<KeptStiffness> kept_;
  std::size_t seen_breaks_ = 0;
  bool broke_ = false;
};

}  // namespace beadwork
