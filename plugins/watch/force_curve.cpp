#include <fmt/format.h>

#include "core/base/units.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork {

/// Reaction of a driven set against its displacement, as a curve.
class ForceCurve final : public Watcher {
 public:
  static constexpr const char* about = "Reaction of a driven or held set against displacement, as a curve";
  Param<std::string> of{this, {.name = "of", .doc = "Set whose reaction is watched", .role = Role::set}};
  Param<std::string> axis{this, {.name = "axis", .doc = "Axis along which the reaction is taken", .choices = {"x", "y", "z"}}};
  Param<std::string> name{this, {.name = "name", .doc = "Name of the curve and of its file", .fallback = "force"}};
  Param<std::string> title{this, {.name = "title", .doc = "Title of the curve in the report", .fallback = "Force against displacement"}};
  Param<Formula> reference{this,
                           {.name = "reference",
                            .unit = "N",
                            .doc = "Force that theory predicts, as a formula in 'displacement'; drawn beside the curve",
                            .optional = true,
                            .variables = {{"displacement", find_unit("m")->dimension}}}};

  void look(Sight& sight) override {
    const int direction = (*axis)[0] - 'x';
    Real force = 0;
    Real displacement = 0;
    for (const Constraint& c : sight.constraints()) {
      if (c.axis != direction || c.set != *of) continue;
      force += c.reaction;
      displacement += c.at(sight.moment().time).displacement;
    }
    CurvePlan plan{.name = *name,
                   .columns = {{"displacement", "m"}, {"force", "N"}},
                   .title = *title,
                   .x = "displacement",
                   .y = {"force"},
                   .references = {},
                   .kind = ""};
    std::vector<Real> row{displacement, force};
    if (reference.given()) {
      plan.columns.push_back({"reference", "N"});
      row.push_back((*reference)({&displacement, 1}));
    }
    sight.curve(plan).row(row);
  }
};

}  // namespace beadwork
