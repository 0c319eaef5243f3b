#include "core/domain/vocabulary.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork::ropes {

/// Mean place of a set, as a curve.
class Centroid final : public Watcher {
 public:
  static constexpr const char* about = "Mean place of the elements of a set over time, as a curve";
  Param<std::string> of{this, {.name = "of", .doc = "Set that is watched", .role = Role::set}};
  Param<std::string> name{this, {.name = "name", .doc = "Name of the curve and of its file", .fallback = "centroid"}};
  Curve curve{this,
              name,                                              // curves/centroid.csv
              {.columns = {{"x", "m"}, {"y", "m"}, {"z", "m"}},  // behind 'step' and 'time', which every curve has
               .y = {"x", "y", "z"}}};  // what the report draws; against time, as no .x is given
  Reads<Vec3> position{this, field::position};

  void choose() override { curve.plan.title = "Mean place of " + *of; }

  void look(Sight& sight) override {
    const Set& members = sight.domain().set(*of);
    Vec3 mean = zero<Vec3>();
    for (const Index row : members) mean += position[row] / static_cast<Real>(members.size());
    curve.row({mean.x(), mean.y(), mean.z()});
  }
};

}  // namespace beadwork::ropes
