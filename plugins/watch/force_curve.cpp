#include <fmt/format.h>

#include <set>

#include "core/base/text.hpp"
#include "core/base/units.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork {

/// Reaction of a driven set against its displacement, as a curve; or its torque against its turn.
class ForceCurve final : public Watcher {
 public:
  static constexpr const char* about =
      "Reaction of a driven or held set against displacement, or torque against turn, as a curve";
  Param<std::string> of{this, {.name = "of", .doc = "Set whose reaction is watched", .role = Role::set}};
  Param<std::string> axis{
      this,
      {.name = "axis",
       .doc = "Axis along which the reaction is taken; rx, ry and rz: the torque about it, of a set that turns as a "
              "body about its axis, else the sum of the couples on its elements",
       .choices = {"x", "y", "z", "rx", "ry", "rz"}}};
  Param<std::string> name{this, {.name = "name", .doc = "Name of the curve and of its file", .fallback = "force"}};
  Param<std::string> title{
      this, {.name = "title", .doc = "Title of the curve in the report", .fallback = "Force against displacement"}};
  Param<Formula> reference{this,
                           {.name = "reference",
                            .unit = "N",
                            .doc = "Force that theory predicts, as a formula in 'displacement'; drawn beside the curve",
                            .optional = true,
                            .variables = {{"displacement", find_unit("m")->dimension}}}};
  Curve curve{this, name, {.columns = {{"displacement", "m"}, {"force", "N"}}, .x = "displacement", .y = {"force"}}};

  void choose() override {
    curve.plan.title = *title;
    if (turns()) {
      curve.plan.columns = {{"turn", "rad"}, {"torque", "N.m"}};
      curve.plan.x = "turn";
      curve.plan.y = {"torque"};
      if (!title.in_deck()) curve.plan.title = "Torque against turn";
    }
    if (reference.given()) curve.plan.columns.push_back({"reference", "N"});
  }

  void check(Complaints& complaints) const override {
    if (turns() && reference.in_deck())
      complaints.error(reference.at(),
                       fmt::format("'reference' is a force, but about axis {} there is a torque", *axis));
  }

  void check_stages(std::span<const Constraint> constraints, Complaints& complaints) const override {
    static constexpr const char* names[] = {"x", "y", "z", "rx", "ry", "rz"};
    std::set<std::string> sets, axes;
    for (const Constraint& c : constraints) {
      sets.insert(c.set);
      for (int k = 0; k < 6; ++k)
        if (c.set == *of && tells(c, k)) axes.insert(names[k]);
    }
    if (axes.empty())
      complaints.error(
          of.at(), fmt::format("'of' watches set '{}', which nothing in <load> drives or holds while it looks{}", *of,
                               did_you_mean(*of, {sets.begin(), sets.end()})));
    else if (!axes.contains(*axis))
      complaints.error(axis.at(), fmt::format("'axis' is {}, but <load> drives or holds set '{}' only along {}", *axis,
                                              *of, join({axes.begin(), axes.end()})));
  }

  void look(Sight& sight) override {
    const int direction = turns() ? 3 + (*axis)[1] - 'x' : (*axis)[0] - 'x';
    Real force = 0;
    Real displacement = 0;
    for (const Constraint& c : sight.constraints()) {
      if (c.set != *of || !tells(c, direction)) continue;
      force += c.axis == direction ? Real(c.reaction) : c.force()[direction];
      if (c.axis == direction) displacement += c.at(sight.moment().time).displacement;
    }
    std::vector<Real> row{displacement, force};
    if (reference.given()) row.push_back((*reference)({&displacement, 1}));
    curve.row(row);
  }

 private:
  bool turns() const { return axis->size() == 2; }
  // Of a body that turns all forces are known that keep it.
  static bool tells(const Constraint& c, int axis) {
    return c.axis == axis || (c.body && axis < 3 && (c.prescribes() >> axis & 1));
  }
};

}  // namespace beadwork
