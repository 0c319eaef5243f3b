#pragma once
// What the loads that prescribe a motion share: its velocity over time, as a number that sets in, a formula or a table.

#include <fmt/format.h>

#include <memory>
#include <vector>

#include "core/base/text.hpp"
#include "core/base/units.hpp"
#include "core/mechanics/course.hpp"
#include "core/mechanics/ramp.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork {

class DrivingLoad : public Load {
 protected:
  /// `what`: "Velocity" in `unit`; `example` and `rows` show it in a deck.
  struct Words {
    const char *what, *unit, *example, *rows;
  };
  explicit DrivingLoad(const Words& words) : words_(words) {}

 private:
  Words words_;

 public:
  Param<std::string> set{this, {.name = "set", .doc = "Set that is moved", .role = Role::set}};
  Param<std::string> axis{
      this,
      {.name = "axis",
       .doc = "Axis along which it is moved, or about which it is turned; what is not named is free",
       .choices = {"x", "y", "z"}}};
  Param<Formula> velocity{this,
                          {.name = "velocity",
                           .unit = words_.unit,
                           .doc = fmt::format("{} that is reached, or a formula in t, the time since it began: \"{}\"",
                                              words_.what, words_.example),
                           .knob = Knob::larger_is_faster,
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
  Param<QuantityRows> table{
      this,
      {.name = "table",
       .doc = fmt::format("Instead of 'velocity': times and velocities with units, joined by commas: "
                          "\"{}\"; straight lines between them",
                          words_.rows),
       .knob = Knob::larger_is_faster,
       .columns = {"s", words_.unit},
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

 protected:
  /// Gives the constraint its motion.
  void drive(Constraint& c) const {
    c.driven = true;
    if (table.given())
      follow(c, course());
    else if (velocity.given() && velocity->expression->uses(0))
      follow_formula(c);
    else
      follow(c, SmoothRamp{velocity.given() ? (*velocity)({}) : 0, *rise});
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
          const Expression::Sloped now = formula.evaluate_with_slope({&t, 1}, 0);
          const PrescribedMotion set_in = share.at(t);
          return now.slope * set_in.velocity + now.value * set_in.acceleration;
        },
        std::move(kinks),
        [formula, share](Real t) {
          return formula.evaluate_with_slope({&t, 1}, 0).noise * share.at(t).velocity;
        });
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
