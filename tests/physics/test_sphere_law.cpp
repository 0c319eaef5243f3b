#include "core/mechanics/sphere.hpp"

#include <gtest/gtest.h>

namespace beadwork {
namespace {

TEST(sphere, has_its_volume) { EXPECT_NEAR(sphere_volume(2), 33.510321638291124, 1e-13); }

TEST(sphere, weighs_its_volume_times_its_density) { EXPECT_NEAR(sphere_mass(3, 2), 3 * sphere_volume(2), 1e-13); }

TEST(sphere, turns_as_if_two_fifths_of_its_mass_ran_around_its_equator) {
  EXPECT_NEAR(sphere_inertia(5, 3), 0.4 * 5 * 9, 1e-13);
}

}  // namespace
}  // namespace beadwork
