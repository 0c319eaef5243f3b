#include <fmt/format.h>

#include <set>

#include "core/base/text.hpp"
#include "core/base/units.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork {

/// Reaction of a driven set against its displacement, as a curve.
class ForceCurve final : public Watcher {
 public:
  static constexpr const char* about = "Reaction of a driven or held set against displacement, as a curve";
  Param<std::string> of{this, {.name = "of", .doc = "Set whose reaction is watched", .role = Role::set}};
  Param<std::string> axis{
      this, {.name = "axis", .doc = "Axis along which the reaction is taken", .choices = {"x", "y", "z"}}};
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
    if (reference.given()) curve.plan.columns.push_back({"reference", "N"});
  }

  void check_stages(std::span<const Constraint> constraints, Complaints& complaints) const override {
    std::set<std::string> sets, axes;
    for (const Constraint& c : constraints) {
      if (c.axis > 2) continue;
      sets.insert(c.set);
      if (c.set == *of) axes.insert(std::string(1, "xyz"[c.axis]));
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
    const int direction = (*axis)[0] - 'x';
    Real force = 0;
    Real displacement = 0;
    for (const Constraint& c : sight.constraints()) {
      if (c.axis != direction || c.set != *of) continue;
      force += c.reaction;
      displacement += c.at(sight.moment().time).displacement;
    }
    std::vector<Real> row{displacement, force};
    if (reference.given()) row.push_back((*reference)({&displacement, 1}));
    curve.row(row);
  }
};

}  // namespace beadwork
