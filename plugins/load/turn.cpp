#include <fmt/format.h>

#include "core/base/text.hpp"
#include "core/base/units.hpp"
#include "core/domain/vocabulary.hpp"
#include "core/mechanics/ramp.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork {

/// Turns a set about an axis with a prescribed angular velocity: as one rigid body, or each element about its own
/// centre.
class Turn final : public Load {
 public:
  static constexpr const char* about =
      "Turns a set about an axis with a prescribed angular velocity: as one body, or each element about its own centre";
  Param<std::string> set{this, {.name = "set", .doc = "Set that is turned", .role = Role::set}};
  Param<std::string> axis{this,
                          {.name = "axis",
                           .doc = "Direction of the axis; turns about the others are free where 'about' is absent",
                           .choices = {"x", "y", "z"}}};
  Param<Vec3> centre{this,
                     {.name = "about",
                      .unit = "m",
                      .doc = "A point of the axis: the set goes round it as one rigid body, in all its places and "
                             "turns; where absent each element turns about its own centre, and its place is free",
                      .optional = true}};
  Param<std::string> along{
      this,
      {.name = "along",
       .doc = "Places along the axis of such a body: held, or free, for <pull> or <hold> to see to",
       .fallback = "held",
       .choices = {"held", "free"}}};
  Param<Real> velocity{
      this, {.name = "velocity", .unit = "1/s", .doc = "Angular velocity that is reached", .one_of = "motion"}};
  Param<Real> rise{this,
                   {.name = "rise",
                    .unit = "s",
                    .range = not_negative,
                    .doc = "Time over which the velocity sets in, smoothly (no jump of acceleration)",
                    .fallback = "0 s",
                    .instead = "table"}};
  Param<QuantityRows> table{this,
                            {.name = "table",
                             .doc = "Instead of 'velocity': times and angular velocities with units, joined by commas: "
                                    "\"0 s 0 rad/s, 1 ms 2 rad/s\"; straight lines between them",
                             .columns = {"s", "1/s"},
                             .one_of = "motion"}};

  Reads<Vec3> position{this, field::position};
  Keeps<Vec3> spin{this, field::spin};
  Keeps<Vec3> from{this, {"from", On::elements, "m", "Place when the turn began"}};
  Keeps<Real> begun{this, {"begun", On::scene, "1", "1 once the turn has begun"}};

  Turn() { from.own(); }  // each from where it began

  void check(Complaints& complaints) const override {
    if (along.in_deck() && !centre.given())
      complaints.error(along.at(), "'along' is of a body that turns about a point: give 'about'");
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

  // Elements that go round need no spins where no law reads turns; those that only spin do.
  void choose() override {
    spin.want(!centre.given());
    from.want(centre.given());
    begun.want(centre.given());
    position.want(centre.given());
  }

  // A turn that stands in several stages goes on.
  void start(Domain& domain) override {
    if (!from || begun[0] != 0) return;
    begun[0] = 1;
    for (const Index row : domain.set(*set)) from.set(row, position[row]);
  }

  std::vector<Constraint> constraints() const override {
    Constraint c;
    c.by = id();
    c.set = *set;
    c.axis = 3 + (*axis)[0] - 'x';
    if (centre.given()) c.body.emplace(*centre, column_name(from), *along == "held");
    c.driven = true;
    if (table.given())
      c.motion = [course = course()](Real t) { return course.at(t); };
    else
      c.motion = [course = SmoothRamp{*velocity, *rise}](Real t) { return course.at(t); };
    return {c};
  }

 private:
  VelocityTable course() const {
    std::vector<VelocityTable::Row> rows;
    for (const auto& row : *table)  // it is asked for while a deck with mistakes is checked, too
      if (rows.empty() || row[0] > rows.back().time) rows.push_back({row[0], row[1]});
    return VelocityTable(std::move(rows));
  }
};

}  // namespace beadwork
