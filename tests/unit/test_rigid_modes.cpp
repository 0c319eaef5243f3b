#include "core/mechanics/rigid_modes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace beadwork {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// A unit cube of points, with supports: places that are held along axes.
struct Cube {
  RigidMatrix held = RigidMatrix::Zero(), inertia = RigidMatrix::Zero();
  explicit Cube(const Vec3& extent = Vec3::Ones()) {
    for (int k = 0; k < 8; ++k) {
      const Vec3 arm = 0.5 * Vec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1).cwiseProduct(extent);
      const auto at = rigid_at(arm, 1);
      inertia += at.transpose() * at / 8;
    }
  }
  Cube& hold(const Vec3& arm, const std::string& axes) {
    for (const char axis : axes) {
      const Rigid felt = rigid_at(arm, 1).row(axis - 'x');
      held += felt * felt.transpose();
    }
    return *this;
  }
  std::vector<std::string> free() const { return names_of(free_modes(held, inertia)); }
};

TEST(RigidModes, of_a_body_that_nothing_holds_are_six) {
  EXPECT_THAT(Cube().free(), ElementsAre("move along x", "move along y", "move along z", "turn about x", "turn about y",
                                         "turn about z"));
}

TEST(RigidModes, of_a_body_held_at_one_point_are_its_turns) {
  EXPECT_THAT(Cube().hold({0.5, 0.2, 0}, "xyz").free(), ElementsAre("turn about x", "turn about y", "turn about z"));
}

TEST(RigidModes, of_a_body_on_a_hinge_are_one) {
  EXPECT_THAT(Cube().hold({0.5, 0.2, -0.5}, "xyz").hold({0.5, 0.2, 0.5}, "xyz").free(), ElementsAre("turn about z"));
}

TEST(RigidModes, of_a_body_on_rollers_are_those_in_the_plane) {
  Cube cube;
  for (const Vec3 arm : {Vec3(-0.5, -0.5, -0.5), Vec3(0.5, -0.5, -0.5), Vec3(0, 0.5, -0.5)}) cube.hold(arm, "z");
  EXPECT_THAT(cube.free(), ElementsAre("move along x", "move along y", "turn about z"));
  cube.hold({0, 0, -0.5}, "y");
  EXPECT_THAT(cube.free(), ElementsAre("move along x", "turn about z"));
}

TEST(RigidModes, are_none_where_three_points_hold) {
  EXPECT_THAT(Cube().hold({-0.5, 0, 0}, "xyz").hold({0.5, 0, 0}, "yz").hold({0, 0.5, 0}, "z").free(), IsEmpty());
}

TEST(RigidModes, need_inertia) {
  EXPECT_THAT(Cube({1, 0, 0}).hold({0.5, 0, 0}, "xyz").free(), ElementsAre("turn about y", "turn about z"));
}

TEST(RigidModes, name_directions_that_are_no_axes) {
  EXPECT_THAT(rigid::directions(Vec3(-1, -1, 0).normalized()), ElementsAre("(0.71 0.71 0.00)"));
  EXPECT_THAT(rigid::directions(Eigen::Matrix<Real, 3, 2>(Mat3::Identity().leftCols<2>())), ElementsAre("x", "y"));
}

}  // namespace
}  // namespace beadwork
