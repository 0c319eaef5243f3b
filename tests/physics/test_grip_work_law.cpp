// The work of grips when bonds break in them: the energy balance closes through the break, to second order in the step.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/deck_run.hpp"

namespace beadwork {
namespace {

constexpr const char* ball = R"(<element set="{}" at="{}" radius="{} mm" density="2000 kg/m^3"/>)";

Real largest_residual(const testing::DeckRun& run) {
  return std::max(run.largest("energy", "residual"), -run.smallest("energy", "residual"));
}

testing::DeckRun break_of_pair(const std::string& more_bonds, const std::string& loads) {
  return testing::run_deck(fmt::format(R"(<scene>
    <fill>{}{}{}{}</fill>
    <bond><spring name="s" between="a b" young="10 GPa"/>{}</bond>
    <fail><bond-stress of="s" strength="20 MPa" measure="axial"/></fail>
    <load><hold set="a"/>{}</load>
    <move><verlet time-step="0.2 us" until="60"/></move>
    <watch><energy-ledger every="1"/></watch>
  </scene>)",
                                       fmt::format(ball, "a", "0 0 0 mm", 1), fmt::format(ball, "b", "2 0 0 mm", 1),
                                       fmt::format(ball, "a", "0 5 0 mm", 1), fmt::format(ball, "b", "1.9 5 0 mm", 0.9),
                                       more_bonds, loads));
}

TEST(GripWork, closes_the_balance_exactly_where_all_ends_are_prescribed) {
  // two springs of two lengths break at two times; a third family stays
  const auto run = break_of_pair("", R"(<pull set="b" axis="x" velocity="5 m/s"/><hold set="b" axes="y z"/>)");
  ASSERT_EQ(run.summary.at("breaks").at("axial"), 2);
  EXPECT_LT(largest_residual(run), 1e-12 * run.energy("work"));
}

TEST(GripWork, closes_the_balance_where_the_reaction_of_a_mean_drops) {
  const auto run =
      break_of_pair(R"(<cohesive-beam name="tie" between="b b" gap="2" young="100 GPa" radius-ratio="0.5"/>)",
                    R"(<pull set="b" axis="x" velocity="5 m/s" grip="mean"/><hold set="b" axes="y z"/>)");
  ASSERT_EQ(run.summary.at("breaks").at("axial"), 2);
  EXPECT_LT(largest_residual(run), 2e-3 * run.energy("work"));
}

// A bar whose ends are pulled apart, weakest at both grips, where it breaks at once on either side: its middle flies.
testing::DeckRun mirrored_bar(const std::string& grip, Real step) {
  std::string balls;
  const char* sets[] = {"left", "l", "m", "m", "r", "right"};
  for (int k = 0; k < 6; ++k) balls += fmt::format(ball, sets[k], fmt::format("{} 0 0 mm", 2 * k - 5), 1);
  return testing::run_deck(fmt::format(R"(<scene>
    <fill>{0}</fill>
    <bond>
      <spring name="weak-left" between="left l" young="10 GPa"/><spring name="weak-right" between="r right" young="10 GPa"/>
      <spring name="sl" between="l m" young="10 GPa"/><spring name="sm" between="m m" young="10 GPa"/><spring name="sr" between="m r" young="10 GPa"/>
    </bond>
    <fail><bond-stress of="weak-left" strength="20 MPa" measure="axial"/><bond-stress of="weak-right" strength="20 MPa" measure="axial"/></fail>
    <load><pull set="left" axis="x" velocity="-2 m/s" rise="4 us" grip="{1}"/><pull set="right" axis="x" velocity="2 m/s" rise="4 us" grip="{1}"/></load>
    <move><verlet time-step="{2:.17g} s" until="16 us"/></move>
    <watch><energy-ledger every="1"/></watch>
  </scene>)",
                                       balls, grip, step));
}

class MirroredBar : public ::testing::TestWithParam<const char*> {};

TEST_P(MirroredBar, loses_a_fourth_of_the_balance_s_error_with_half_the_step) {
  Real before = 0;
  for (const Real step : {1e-7, 0.5e-7, 0.25e-7}) {
    const auto run = mirrored_bar(GetParam(), step);
    ASSERT_EQ(run.summary.at("breaks").at("axial"), 2);
    const Real error = std::abs(run.energy("residual")) / run.energy("work");
    EXPECT_LT(error, 2e-3 * (step / 1e-7) * (step / 1e-7)) << step;
    if (before > 0) EXPECT_GT(before / error, 2.5) << step;
    before = error;
  }
}

INSTANTIATE_TEST_SUITE_P(Grips, MirroredBar, ::testing::Values("each", "mean"));

// Velocities by a table have kinks, at which a trapezoid of the grip's own inertia would be wrong by a first-order term
// each time.
TEST(GripWork, of_inertia_is_the_kinetic_energy_whatever_kinks_the_velocity_has) {
  const auto run =
      testing::run_deck(fmt::format(R"(<scene>
    <fill>{}{}</fill>
    <bond><spring name="s" between="a b" young="10 GPa"/></bond>
    <load><hold set="a"/><hold set="b" axes="y z"/>
      <pull set="b" axis="x" table="0 s 0 m/s, 1.03 us 5 m/s, 3.11 us -5 m/s, 5.07 us 5 m/s, 7 us -2 m/s"/></load>
    <move><verlet time-step="0.1 us" until="8 us"/></move>
    <watch><energy-ledger every="1"/></watch>
  </scene>)",
                                    fmt::format(ball, "a", "0 0 0 mm", 1), fmt::format(ball, "b", "2 0 0 mm", 1)));
  EXPECT_LT(largest_residual(run), 1e-12 * run.largest("energy", "work"));
}

}  // namespace
}  // namespace beadwork
