#include "core/domain/vocabulary.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork {

/// Velocities at the start of a stage: v + g s + w x (x - c), with s the place along an axis; spins likewise. Those of
/// a stage add up.
class InitialVelocity final : public Load {
 public:
  static constexpr const char* about =
      "Velocities at the start of the stage: uniform, linear along an axis, or a rigid spin; several on one element "
      "add up";
  Param<std::string> set{this, {.name = "set", .doc = "Set that gets the velocity", .role = Role::set}};
  Param<Vec3> velocity{
      this,
      {.name = "velocity", .unit = "m/s", .doc = "The same for all elements of the set", .fallback = "0 0 0 m/s"}};
  Param<Vec3> gradient{this,
                       {.name = "gradient",
                        .unit = "1/s",
                        .doc = "Velocity that is added per length along 'along', from 'centre' on",
                        .fallback = "0 0 0 s^-1"}};
  Param<std::string> along{
      this, {.name = "along", .doc = "Axis of the gradient", .fallback = "x", .choices = {"x", "y", "z"}}};
  Param<Vec3> spin{this,
                   {.name = "spin",
                    .unit = "1/s",
                    .doc = "Angular velocity of the set as a rigid body about 'centre'",
                    .fallback = "0 0 0 s^-1"}};
  Param<Vec3> centre{
      this, {.name = "centre", .unit = "m", .doc = "Where gradient and spin give no velocity", .fallback = "0 0 0 m"}};

  Reads<Vec3> position{this, field::position};
  Keeps<Vec3> speed{this, field::velocity};
  Keeps<Vec3> turning{this, field::spin};

  void choose() override { turning.want(spin->norm() > 0); }

  // What an earlier stage has left is replaced, not added to.
  void clear(Domain& domain) override {
    for (const Index row : domain.set(*set)) {
      speed.set(row, Vec3::Zero());
      if (turning) turning.set(row, Vec3::Zero());
    }
  }

  void start(Domain& domain) override {
    const int axis = (*along)[0] - 'x';
    for (const Index row : domain.set(*set)) {
      const Vec3 arm = position[row] - *centre;
      speed.add(row, *velocity + arm[axis] * *gradient + spin->cross(arm));
      if (turning) turning.add(row, *spin);
    }
  }
};

}  // namespace beadwork
