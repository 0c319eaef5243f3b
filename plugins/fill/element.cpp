#include "plugins/fill/spheres.hpp"

namespace beadwork {

/// One element at a place: for scenes of a few elements.
class Element final : public ElementMaker {
 public:
  static constexpr const char* about = "One element at a given place";
  Param<Vec3> at{this, {.name = "at", .unit = "m", .doc = "Place of its centre"}};
  Param<Real> radius{this, {.name = "radius", .unit = "m", .range = positive, .doc = "Radius"}};

  void fill(Domain& domain, const FillJob&) override {
    const Vec3 centre = at;
    const Real r = radius;
    add_spheres(domain, {&centre, 1}, {&r, 1});
  }
};

}  // namespace beadwork
