#include "core/domain/vocabulary.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork::ropes {

/// Mean place of a set, as a curve.
class Centroid final : public Watcher {
 public:
  static constexpr const char* about = "Mean place of the elements of a set over time, as a curve";
  Param<std::string> of{this, {.name = "of", .doc = "Set that is watched", .role = Role::set}};
  Param<std::string> name{this, {.name = "name", .doc = "Name of the curve and of its file", .fallback = "centroid"}};
  Reads<Vec3> position{this, field::position};

  void look(Sight& sight) override {
    const Set& members = sight.domain().set(*of);
    Vec3 mean = zero<Vec3>();
    for (const Index row : members) mean += position[row] / static_cast<Real>(members.size());
    CurvePlan plan;
    plan.name = *name;                                    // curves/centroid.csv
    plan.columns = {{"x", "m"}, {"y", "m"}, {"z", "m"}};  // behind 'step' and 'time', which every curve has
    plan.title = "Mean place of " + *of;
    plan.y = {"x", "y", "z"};  // what the report draws; against time, as no plan.x is given
    sight.curve(plan).row(std::array{mean.x(), mean.y(), mean.z()});
  }
};

}  // namespace beadwork::ropes
