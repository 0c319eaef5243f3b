#include "core/plugin/kinds.hpp"

namespace beadwork {

/// Keeps a set where it is, along the axes named: each element, or only their mean. A clamp holds turns as well.
class Hold final : public Load {
 public:
  static constexpr const char* about = "Keeps a set still along the axes named: each element, or their mean only";
  Param<std::string> set{this, {.name = "set", .doc = "Set that is held", .role = Role::set}};
  Param<std::vector<std::string>> axes{
      this,
      {.name = "axes",
       .doc = "Axes along which it is held; rx, ry and rz hold turns about them: x y z rx ry rz clamps",
       .fallback = "x y z",
       .choices = {"x", "y", "z", "rx", "ry", "rz"}}};
  Param<std::string> grip{this,
                          {.name = "grip",
                           .doc = "each element by itself, or the mean over the set",
                           .fallback = "each",
                           .choices = {"each", "mean"}}};

  std::vector<Constraint> constraints() const override {
    std::vector<Constraint> all;
    for (const std::string& axis : *axes) {
      Constraint c;
      c.by = id();
      c.set = *set;
      c.axis = axis.size() == 2 ? 3 + axis[1] - 'x' : axis[0] - 'x';
      c.grip = *grip == "each" ? Grip::each : Grip::mean;
      c.motion = [](Real) { return PrescribedMotion{0, 0, 0}; };
      all.push_back(c);
    }
    return all;
  }
};

}  // namespace beadwork
