#include "core/mechanics/section.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace beadwork {
namespace {

// Derived: the integrals of y^2 and of r^2 over the section.
TEST(Section, has_the_moments_of_its_shape) {
  const Section square = square_section(9);  // side 3
  EXPECT_DOUBLE_EQ(square.second_moment, 81. / 12);
  const Section round = round_section(std::numbers::pi * 4);  // radius 2
  EXPECT_DOUBLE_EQ(round.second_moment, std::numbers::pi * 16 / 4);
  EXPECT_DOUBLE_EQ(round.torsion, std::numbers::pi * 16 / 2);
}

// Derived: Saint-Venant's series for a square of side a, J = a^4 (1/3 - 64/pi^5 sum tanh(n pi/2)/n^5).
TEST(Section, that_is_square_warps_when_it_is_twisted) {
  Real sum = 0;
  for (int n = 1; n < 2000; n += 2) sum += std::tanh(0.5 * n * std::numbers::pi) / std::pow(n, 5);
  EXPECT_NEAR(square_section(9).torsion, 81 * (1. / 3 - 64 / std::pow(std::numbers::pi, 5) * sum), 1e-12);
  EXPECT_LT(square_section(9).torsion, 2 * square_section(9).second_moment);  // that of one that stays plane
}

TEST(PassingTime, lies_between_two_looks_and_is_the_first) {
  const std::vector<Real> time{0, 1, 2, 3, 4}, value{0, 0, 4, 1, 9};
  EXPECT_DOUBLE_EQ(passing_time(time, value, 1), 1.25);
  EXPECT_TRUE(std::isnan(passing_time(time, value, 10)));
  EXPECT_TRUE(std::isnan(passing_time({}, {}, 1)));
}

}  // namespace
}  // namespace beadwork
