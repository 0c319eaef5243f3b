#include "plugins/load/driving.hpp"

namespace beadwork {

/// Moves a set along one axis with a prescribed velocity; the other axes stay free.
class Pull final : public DrivingLoad {
 public:
  static constexpr const char* about =
      "Moves a set along one axis with a prescribed velocity: each element, or their mean only";
  Param<std::string> grip{this,
                          {.name = "grip",
                           .doc = "each element alike, or the mean over the set",
                           .fallback = "each",
                           .choices = {"each", "mean"}}};

  Pull() : DrivingLoad({"Velocity", "m/s", "2 mm/s * sin(2*pi * t / 1 ms)", "0 s 0 m/s, 1 ms 2 m/s"}) {}

  std::vector<Constraint> constraints() const override {
    Constraint c;
    c.by = id();
    c.set = *set;
    c.axis = (*axis)[0] - 'x';
    c.grip = *grip == "each" ? Grip::each : Grip::mean;
    drive(c);
    return {c};
  }
};

}  // namespace beadwork
