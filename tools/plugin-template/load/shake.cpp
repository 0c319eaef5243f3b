#include <cmath>
#include <numbers>

#include "core/plugin/kinds.hpp"

namespace beadwork::ropes {

/// Shakes a set to and fro along an axis.
class Shake final : public Load {
 public:
  static constexpr const char* about = "Shakes a set along one axis, out by a stroke and back again";
  Param<std::string> set{this, {.name = "set", .doc = "Set that is shaken", .role = Role::set}};
  Param<std::string> axis{this, {.name = "axis", .doc = "Axis along which it is shaken", .choices = {"x", "y", "z"}}};
  Param<Real> stroke{this, {.name = "stroke", .unit = "m", .doc = "Largest displacement"}};
  Param<Real> frequency{this, {.name = "frequency", .unit = "Hz", .range = positive, .doc = "Strokes in a second"}};

  std::vector<Constraint> constraints() const override {
    Constraint c;
    c.by = id();
    c.set = *set;
    c.axis = (*axis)[0] - 'x';
    c.grip = Grip::each;
    c.driven = true;  // it moves: force-curve, 'until' and 'at' watch it as they watch <pull>
    c.motion = [u = *stroke, w = 2 * std::numbers::pi * *frequency](Real t) -> PrescribedMotion {
      return {u * (1 - std::cos(w * t)) / 2, u * w * std::sin(w * t) / 2, u * w * w * std::cos(w * t) / 2};
    };
    return {c};
  }
};

}  // namespace beadwork::ropes
