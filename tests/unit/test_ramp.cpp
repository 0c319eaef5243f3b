#include "core/mechanics/ramp.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace beadwork {
namespace {

TEST(ramp, starts_and_ends_without_a_jerk) {
  EXPECT_EQ(smooth_step(0), 0);
  EXPECT_EQ(smooth_step(1), 1);
  EXPECT_NEAR(smooth_step(0.5), 0.5, 1e-16);
  EXPECT_EQ(smooth_step_slope(0), 0);
  EXPECT_EQ(smooth_step_slope(1), 0);
  EXPECT_NEAR(smooth_step(1e-3), 10e-9, 2e-11);  // 10 x^3: no slope and no curvature
  EXPECT_NEAR(1 - smooth_step(1 - 1e-3), 10e-9, 2e-11);
}

TEST(ramp, its_slope_and_its_integral_belong_to_it) {
  const Real h = 1e-4;
  for (Real x = 0.05; x < 1.3; x += 0.1) {
    EXPECT_NEAR(smooth_step_slope(x), (smooth_step(x + h) - smooth_step(x - h)) / (2 * h), 1e-6);
    EXPECT_NEAR(smooth_step(x), (smooth_step_integral(x + h) - smooth_step_integral(x - h)) / (2 * h), 1e-7);
  }
}

TEST(ramp, a_velocity_sets_in_over_the_rise_and_then_stays) {
  const SmoothRamp ramp{3, 2};
  EXPECT_EQ(ramp.at(-1).displacement, 0);
  EXPECT_EQ(ramp.at(2).velocity, 3);
  EXPECT_NEAR(ramp.at(2).displacement, 3, 1e-15);  // half of what the full velocity would have made
  EXPECT_NEAR(ramp.at(5).displacement, 3 + 3 * 3, 1e-14);
  EXPECT_NEAR(ramp.at(1).acceleration, 3 * 1.875 / 2, 1e-14);
  EXPECT_EQ(ramp.at(3).acceleration, 0);
  const SmoothRamp sudden{3, 0};
  EXPECT_EQ(sudden.at(2).displacement, 6);
  EXPECT_EQ(sudden.at(0).velocity, 3);
}

TEST(ramp, how_far_it_ever_gets) {
  const Real infinite = std::numeric_limits<Real>::infinity();
  EXPECT_EQ((SmoothRamp{3, 2}.reach()), infinite);
  EXPECT_EQ((SmoothRamp{0, 2}.reach()), 0);
  EXPECT_EQ(VelocityTable({{0, 1}, {2, 1}}).reach(), infinite);
  EXPECT_EQ(VelocityTable({{0, 0}}).reach(), 0);
  EXPECT_EQ(VelocityTable({{0, 1}, {2, 1}, {3, 0}}).reach(), 2.5);
  // 1 forth and 3 beyond the start on the way back: the turning point lies between rows
  EXPECT_EQ(VelocityTable({{0, 2}, {2, -2}, {3, -2}, {4, 0}}).reach(), 1 + 3);
}

TEST(ramp, a_table_is_integrated_exactly) {
  const VelocityTable table({{1, 0}, {3, 4}, {4, -2}});
  EXPECT_EQ(table.at(0).displacement, 0);
  EXPECT_EQ(table.at(2).velocity, 2);
  EXPECT_EQ(table.at(2).displacement, 1);
  EXPECT_EQ(table.at(2).acceleration, 2);
  EXPECT_EQ(table.at(3).displacement, 4);
  EXPECT_EQ(table.at(4).displacement, 5);
  EXPECT_EQ(table.at(6).displacement, 5 - 4);
  EXPECT_EQ(table.at(6).velocity, -2);
}

TEST(ramp, a_table_refuses_times_that_do_not_increase) {
  EXPECT_THROW(VelocityTable({{1, 0}, {1, 2}}), std::invalid_argument);
  EXPECT_THROW(VelocityTable({}), std::invalid_argument);
}

}  // namespace
}  // namespace beadwork
