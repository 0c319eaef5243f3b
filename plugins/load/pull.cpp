#include <fmt/format.h>

#include "core/base/text.hpp"
#include "core/base/units.hpp"
#include "core/mechanics/course.hpp"
#include "core/mechanics/ramp.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork {

/// Moves a set along one axis with a prescribed velocity; the other axes stay free.
class Pull final : public Load {
 public:
  static constexpr const char* about =
      "Moves a set along one axis with a prescribed velocity: each element, or their mean only";
  Param<std::string> set{this, {.name = "set", .doc = "Set that is moved", .role = Role::set}};
  Param<std::string> axis{this,
                          {.name = "axis",
                           .doc = "Axis along which it is moved; an axis that is not named is free",
                           .choices = {"x", "y", "z"}}};
  Param<std::string> grip{this,
                          {.name = "grip",
                           .doc = "each element alike, or the mean over the set",
                           .fallback = "each",
                           .choices = {"each", "mean"}}};
  Param<Formula> velocity{
      this,
      {.name = "velocity",
       .unit = "m/s",
       .doc = "Velocity that is reached, or a formula in t, the time since the pull began: \"2 mm/s "
              "* sin(2*pi * t / 1 ms)\"",
       .variables = {{"t", find_unit("s")->dimension}},
       .one_of = "motion"}};
  Param<Real> rise{this,
                   {.name = "rise",
                    .unit = "s",
                    .range = not_negative,
                    .doc = "Time over which the velocity sets in, smoothly (no jump of acceleration); a formula is "
                           "multiplied by what has set in",
                    .fallback = "0 s",
                    .instead = "table"}};
  Param<QuantityRows> table{this,
                            {.name = "table",
                             .doc = "Instead of 'velocity': times and velocities with units, joined by commas: \"0 s 0 "
                                    "m/s, 1 ms 2 m/s\"; straight lines between them",
                             .columns = {"s", "m/s"},
                             .one_of = "motion"}};

  void check(Complaints& complaints) const override {
    if (table.in_deck() && rise.in_deck())
      complaints.error(rise.at(), "'rise' belongs to 'velocity', a table has its own course");
    if (!table.given()) return;
    if (table->front()[0] != 0)
      complaints.error(table.at(), "the first row of 'table' is that of the start of the stage, 0 s");
    for (std::size_t k = 1; k < table->size(); ++k)
      if ((*table)[k][0] <= (*table)[k - 1][0])
        complaints.error(table.at(), fmt::format("the times of 'table' must increase, got {} s after {} s",
                                                 format_number((*table)[k][0]), format_number((*table)[k - 1][0])));
  }

  std::vector<Constraint> constraints() const override {
    Constraint c;
    c.by = id();
    c.set = *set;
    c.axis = (*axis)[0] - 'x';
    c.grip = *grip == "each" ? Grip::each : Grip::mean;
    c.driven = true;
    if (table.given())
      follow(c, course());
    else if (velocity.given() && velocity->expression->uses(0))
      follow_formula(c);
    else
      follow(c, SmoothRamp{velocity.given() ? (*velocity)({}) : 0, *rise});
    return {c};
  }

 private:
  // How far it ever gets nobody can tell.
  void follow_formula(Constraint& c) const {
    const Expression& formula = *velocity->expression;
    const SmoothRamp share{1, *rise};
    std::vector<Real> kinks = formula.kinks(0);
    kinks.push_back(*rise);
    const auto course = std::make_shared<VelocityCourse>(
        [formula, share](Real t) {
          return formula.evaluate({&t, 1}) * share.at(t).velocity;
        },
        [formula, share](Real t) {
          const auto [value, slope] = formula.evaluate_with_slope({&t, 1}, 0);
          const PrescribedMotion set_in = share.at(t);
          return slope * set_in.velocity + value * set_in.acceleration;
        },
        std::move(kinks));
    c.motion = [course](Real t) { return course->at(t); };
  }

  template <class Course>
  static void follow(Constraint& c, const Course& course) {
    c.reach = course.reach();
    c.motion = [course](Real t) { return course.at(t); };
  }

  VelocityTable course() const {
    std::vector<VelocityTable::Row> rows;
    for (const auto& row : *table)  // it is asked for while a deck with mistakes is checked, too
      if (rows.empty() || row[0] > rows.back().time) rows.push_back({row[0], row[1]});
    return VelocityTable(std::move(rows));
  }
};

}  // namespace beadwork
