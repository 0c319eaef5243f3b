#include <fmt/format.h>

#include <optional>

#include "core/base/failure.hpp"
#include "core/domain/vocabulary.hpp"
#include "core/plugin/kinds.hpp"
#include "core/statics/course.hpp"

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
                         .knob = Knob::larger_is_faster,
                         .one_of = "length of an increment"}};
  Param<Real> time_step{
      this,
      {.name = "time-step",
       .unit = "s",
       .range = positive,
       .doc = "Instead of 'increment': the time by which loads go on. Time tells the course of loads; "
              "inertia there is none",
       .knob = Knob::larger_is_faster,
       .one_of = "length of an increment"}};
  Param<Real> opening{
      this,
      {.name = "opening",
       .unit = "m",
       .range = positive,
       .doc = "While bonds of 'opening-of' soften: how far they open or slide from one equilibrium to the next, in the "
              "mean; loads follow, backwards too where that takes less (snap-back), and no further than an increment",
       .optional = true,
       .knob = Knob::larger_is_faster}};
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
       .fallback = "1e-6",
       .knob = Knob::larger_is_faster}};
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
       .choices = linear_solvers(),
       .knob = Knob::a_choice}};
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
       .fallback = "1",
       .knob = Knob::larger_is_faster}};
  Param<Real> within{this,
                     {.name = "within",
                      .range = {0, 1, false, true},
                      .doc = "What comes so near, as a share, to what breaks first may break with it; more is faster",
                      .fallback = "1e-6",
                      .knob = Knob::larger_is_faster}};

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
  Keeps<Real> does{this, {"increment-force", On::scene, "N", "Most that an increment has changed of the forces"}};
  Keeps<Real> released{this, {"released", On::scene, "J", "Energy set free by breaks on the way to a new equilibrium"}};
  Keeps<Real> noise{this,
                    {"force-noise", On::scene, "N", "Round-off of forces, by the stiffness when the stage began"}};
  Keeps<Real> energy_noise{this, {"energy-noise", On::scene, "J", "Round-off of energies, likewise"}};
  Keeps<Real> served{
      this, {"factor-served", On::scene, "1", "Iterations that the kept stiffness has served; -1: there is none"}};
  Keeps<Real> factored_for{
      this, {"factor-supports", On::scene, "1", "Sign of the supports that the kept stiffness was factored with"}};
  Keeps<Real> negative{this, {"negative-pivots", On::scene, "1", "Most negative pivots of an equilibrium so far"}};
  Keeps<Real> borne{this,
                    {"pins-bear", On::scene, "1", "Most that pins of free bodies bear, over what all supports take"}};
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
    const StaticRows elements{w.domain().elements().column("position").view<Vec3>(),
                              velocity.view(),
                              force.view(),
                              orientation.view(),
                              spin.view(),
                              torque.view(),
                              radius.view(),
                              held.view()};
    const CourseRows rows{share.view(),        used.view(),     does.view(), released.view(),  noise.view(),
                          energy_noise.view(), spent.view(),    cuts.view(), carefully.view(), events.view(),
                          worst.view(),        negative.view(), borne.view()};
    course_.emplace(w, choices(w), elements, rows, KeptStiffness::Rows{served.view(), factored_for.view()});
    resumed ? course_->resume() : course_->begin();
  }
  void step(Workings&) override { course_->step(); }

  void energy(EnergySink& sink) const override {
    if (released[0] != 0) sink.dissipated("redistribution", released[0]);
  }
  std::string suspect() const override {
    return "increments are probably too large for the work of what goes on in them (smaller ones tell), something has "
           "snapped on the way, or a law's force is not the slope of its stored energy";
  }
  // Round-off alone, where nothing has been done yet.
  Real swing() const override { return energy_noise[0]; }
  std::vector<MoverFigure> figures() const override {
    return course_ ? course_->figures() : std::vector<MoverFigure>();
  }

 private:
  CourseChoices choices(Workings& w) const {
    const bool is_secant = *slope == "secant" || *solver == "conjugate-gradients";
    CourseChoices choices;
    choices.at = at();
    choices.limits = {*tolerance, static_cast<int>(*iterations), is_secant ? Slope::secant : Slope::consistent};
    choices.solver = *solver;
    choices.pins_free = *free_bodies == "pin";
    choices.smallest = *smallest;
    choices.within = *within;
    if (opening.given()) choices.opening = *opening, choices.opening_of = *opening_of;
    choices.next_time = [this, &w](Real share_of_whole) { return next_time(w, share_of_whole); };
    return choices;
  }

  Real next_time(Workings& w, Real share_of_whole) const {
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

  std::optional<Course> course_;
};

}  // namespace beadwork
