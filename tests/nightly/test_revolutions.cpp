#include <gtest/gtest.h>

#include "tests/support/spinning_pair.hpp"

namespace beadwork {
namespace {

// tests/physics/test_verlet_law.cpp has ten thousand.
TEST(verlet, a_million_revolutions_of_a_bonded_pair_keep_energy_spin_and_the_length_of_a_quaternion) {
  test::SpinningPair pair;
  const Real start = pair.energy();
  const Vec3 spin_start = pair.spin();
  Real worst = 0, tilt = 0;
  for (int turns = 0; turns < 1000000; ++turns) {
    pair.turn_once();
    worst = std::max(worst, std::abs(pair.energy() / start - 1));
    tilt = std::max(tilt, pair.tilt());
  }
  const Real lost = (pair.spin() - spin_start).norm() / spin_start.norm();
  std::printf("energy off by %.2g, spin by %.2g, squared length of a quaternion by %.2g\n", worst, lost,
              pair.stretch_of_quaternions());
  EXPECT_LT(worst, 1e-6);
  EXPECT_LT(lost, 1e-10);
  EXPECT_LT(pair.stretch_of_quaternions(), 1e-12);
  EXPECT_EQ(tilt, 0);
}

}  // namespace
}  // namespace beadwork
