// The figures of quality of runs whose answer is known.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/deck_run.hpp"

namespace beadwork {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A bar of eight elements, or more, two in each direction across.
testing::DeckRun bar(const std::string& load, const std::string& until, const std::string& fail = "",
                     int elements = 8) {
  return testing::run_deck(fmt::format(R"(<scene>
    <fill><lattice set="bar" count="{} 2 2" radius="1 mm" density="2000 kg/m^3"/>
      <region set="left" where="x &lt; 2 mm"/><region set="right" where="x > {} mm"/></fill>
    <bond><cohesive-beam name="beam" between="bar bar" young="10 GPa" radius-ratio="0.5"/></bond>
    <fail>{}</fail>
    <load>{}</load>
    <move><verlet until="{}"/></move>
  </scene>)",
                                       elements, 2 * elements - 3, fail, load, until));
}

std::string pull(Real velocity, const std::string& rise) {
  return fmt::format(
      R"(<hold set="left" axes="x"/><hold set="bar" axes="y z rx" grip="mean"/><pull set="right" axis="x" velocity="{} m/s" rise="{}"/>)",
      velocity, rise);
}

TEST(QualityOfRuns, a_slow_pull_is_good_and_a_fast_one_is_not) {
  const auto slow = bar(pull(0.02, "0.5 ms"), "1 ms").summary.at("quality");
  EXPECT_EQ(slow.at("verdict"), "good") << slow.dump(1);
  EXPECT_GT(slow.at("kinetic_over_stored"), 1e-8);
  const auto fast = bar(pull(10, "20 us"), "40 us").summary.at("quality");
  EXPECT_NE(fast.at("verdict"), "good");
  EXPECT_GT(fast.at("kinetic_over_stored"), 0.01);
  EXPECT_LT(fast.at("residual_over_work"), 1e-3);
}

TEST(QualityOfRuns, a_slow_test_that_ends_with_a_break_is_good_up_to_it) {
  const auto run = bar(pull(0.05, "0.5 ms"), "2 ms", R"(<bond-stress of="beam" strength="20 MPa" measure="axial"/>)");
  ASSERT_FALSE(run.summary.at("breaks").empty());
  EXPECT_EQ(run.summary.at("quality").at("verdict"), "good") << run.summary.at("quality").dump(1);
}

// All of it is over within the first hundred steps, before the first look that is due.
TEST(QualityOfRuns, a_bar_that_a_wave_tears_is_not_good) {
  for (const Real velocity : {1.0, 2.0, 2.5}) {
    const auto run =
        bar(pull(velocity, "5 us"), "0.1 mm", R"(<bond-stress of="beam" strength="20 MPa" measure="axial"/>)", 20);
    ASSERT_FALSE(run.summary.at("breaks").empty());
    const auto quality = run.summary.at("quality");
    EXPECT_EQ(quality.at("verdict"), "poor") << velocity << " m/s: " << quality.dump(1);
    EXPECT_GT(quality.at("reactions_imbalance"), 0.1);
  }
}

// A weak bond has broken, and the bar, which is whole, has been loaded and let go: then it is torn at.
TEST(QualityOfRuns, a_bar_that_is_loaded_anew_after_a_break_is_judged_by_that) {
  const auto quality_at = [](const std::string& velocity) {
    return testing::run_deck(fmt::format(R"(<scene>
      <fill><lattice set="bar" count="20 2 2" radius="1 mm" density="2000 kg/m^3"/><element set="side" at="-2 0 0 mm" radius="1 mm" density="2000 kg/m^3"/>
        <region set="left" where="x &lt; 2 mm and x > -1 mm"/><region set="right" where="x > 37 mm"/>
        <region set="corner" where="x &lt; 4 mm and x > 1 mm and y &lt; 1 mm and z &lt; 1 mm"/></fill>
      <bond><cohesive-beam name="beam" between="bar bar" young="10 GPa" radius-ratio="0.5"/><spring name="weak" between="side corner" gap="1.2" young="1 GPa"/></bond>
      <load><hold set="side"/><hold set="left" axes="x"/><hold set="bar" axes="y z rx" grip="mean"/>
        <pull set="right" axis="x" table="0 s 0 m/s, 2 ms 0.005 m/s, 4 ms 0 m/s, 6 ms -0.005 m/s, 8 ms 0 m/s, 8.01 ms {0}, 8.03 ms {0}, 8.04 ms 0 m/s"/></load>
      <fail><bond-stress of="weak" strength="20 kPa" measure="axial"/></fail>
      <move><verlet until="8.045 ms"/></move>
    </scene>)",
                                         velocity))
        .summary.at("quality");
  };
  EXPECT_EQ(quality_at("0 m/s").at("verdict"), "good");
  const auto torn = quality_at("20 m/s");
  EXPECT_EQ(torn.at("verdict"), "poor") << torn.dump(1);
  EXPECT_GT(torn.at("reactions_imbalance_cracking"), 0.5);
}

// What moves when the second stage begins has been moved by the first, and was not given.
TEST(QualityOfRuns, a_violent_stage_is_not_excused_by_the_next) {
  const auto run = testing::run_deck(R"(<scene>
    <fill><lattice set="bar" count="8 2 2" radius="1 mm" density="2000 kg/m^3"/>
      <region set="left" where="x &lt; 2 mm"/><region set="right" where="x > 13 mm"/></fill>
    <bond><cohesive-beam name="beam" between="bar bar" young="10 GPa" radius-ratio="0.5"/></bond>
    <load><hold set="left"/></load>
    <stage name="jerk"><load><pull set="right" axis="x" velocity="10 m/s" rise="5 us"/></load><move><verlet until="10 us"/></move></stage>
    <stage name="wait"><load><hold set="right" axes="x"/></load><move><verlet until="20 us"/></move></stage>
  </scene>)");
  EXPECT_EQ(run.summary.at("quality").at("verdict"), "poor") << run.summary.at("quality").dump(1);
}

// The middle of the bar is on rollers and pushed sideways by a hair: nothing holds that, and it goes as far as it
// flies.
TEST(QualityOfRuns, a_free_motion_is_followed_as_far_as_it_goes) {
  const auto run = bar(
      R"(<hold set="bar" axes="x ry rz" grip="mean"/><hold set="left" axes="z"/><initial-velocity set="bar" velocity="0 0.5 0 m/s"/>)",
      "1 ms");
  EXPECT_THAT(run.said, Contains(HasSubstr("a body of 32 bonded elements is free to move along y")));
  EXPECT_NEAR(run.summary.at("quality").at("free_motion").get<Real>(), 0.5e-3, 1e-6);
}

// It flies sideways at 0.1 mm/s for 2 ms, while it is pulled by 10 um and put back.
TEST(QualityOfRuns, a_free_motion_is_held_against_the_farthest_prescribed_one) {
  const auto run = bar(
      R"(<hold set="left" axes="x"/><hold set="bar" axes="z rx" grip="mean"/><initial-velocity set="bar" velocity="0 0.1 0 mm/s"/>
    <pull set="right" axis="x" table="0 s 0 m/s, 0.5 ms 0.02 m/s, 1 ms 0 m/s, 1.5 ms -0.02 m/s, 2 ms 0 m/s"/>)",
      "1.999 ms");
  EXPECT_NEAR(run.summary.at("quality").at("free_motion_over_prescribed").get<Real>(), 0.02, 0.004);
}

// Gripped along x only, a short block gets thinner as it is pulled, which is no motion as a whole.
TEST(QualityOfRuns, what_gets_thinner_does_not_drift) {
  const auto run = testing::run_deck(R"(<scene seed="3">
    <fill><free-filling set="all" box="6 6 6 mm" count="150" density="1600 kg/m^3"/><forced-filling set="all"/><relaxation set="all"/>
      <region set="left" where="x &lt; 1.2 mm"/><region set="right" where="x > 4.8 mm"/></fill>
    <bond><cohesive-beam name="beam" between="all all" young="500 GPa" radius-ratio="0.2"/></bond>
    <load><hold set="left" axes="x"/><pull set="right" axis="x" velocity="0.2 m/s" rise="0.05 ms"/></load>
    <move><verlet bond-damping="0.1" until="0.02 mm"/></move>
  </scene>)");
  const auto quality = run.summary.at("quality");
  ASSERT_EQ(quality.at("free_bodies").at(0).at("free_to"),
            (std::vector<std::string>{"move along y", "move along z", "turn about x"}));
  EXPECT_LT(quality.at("free_motion_over_prescribed"), 0.02) << quality.dump(1);
}

// One mean over two bars is one support, and they fly apart; of one bar it is a support of that one, the other being
// held otherwise.
TEST(QualityOfRuns, bodies_that_share_a_support_are_free_against_each_other) {
  const auto bars = [](const std::string& load) {
    return testing::run_deck(fmt::format(R"(<scene>
      <fill><lattice set="a" count="6 2 2" radius="1 mm" density="2000 kg/m^3"/><lattice set="b" count="6 2 2" radius="1 mm" density="2000 kg/m^3" from="0 20 0 mm"/>
        <region set="all" where="x > -100 mm"/><region set="end" where="x &lt; 1 mm and y > 10 mm"/></fill>
      <bond><cohesive-beam name="a" between="a a" young="10 GPa" radius-ratio="0.5"/><cohesive-beam name="b" between="b b" young="10 GPa" radius-ratio="0.5"/></bond>
      <load>{}</load>
      <move><verlet until="1 ms"/></move>
    </scene>)",
                                         load));
  };
  const auto apart =
      bars(R"(<hold set="all" axes="x y z rx ry rz" grip="mean"/><initial-velocity set="a" velocity="0.1 0 0 m/s"/>
    <initial-velocity set="b" velocity="-0.1 0 0 m/s"/>)");
  EXPECT_THAT(apart.said,
              Contains(HasSubstr("a body of 24 bonded elements is free to move and turn any way")).Times(2));
  EXPECT_NEAR(apart.summary.at("quality").at("free_motion").get<Real>(), 1e-4, 1e-6);
  const auto held =
      bars(R"(<hold set="a" axes="x y z rx ry rz" grip="mean"/><hold set="b" axes="x y z rx ry rz" grip="mean"/>)");
  EXPECT_THAT(held.summary.at("quality").at("free_bodies"), IsEmpty());
}

TEST(QualityOfRuns, nothing_is_said_of_a_body_that_is_held) {
  const auto run = bar(R"(<hold set="left"/><pull set="right" axis="x" velocity="0.02 m/s" rise="0.5 ms"/>)", "20");
  EXPECT_THAT(run.said, ::testing::Not(Contains(HasSubstr("is free to"))));
  EXPECT_THAT(run.summary.at("quality").at("free_bodies"), IsEmpty());
}

TEST(QualityOfRuns, a_projectile_is_dynamic) {
  const auto run = bar(
      R"(<initial-velocity set="bar" velocity="0 0.5 0 m/s"/><initial-velocity set="left" velocity="0.5 0 0 m/s"/>)",
      "2000");
  EXPECT_EQ(run.summary.at("quality").at("verdict"), "dynamic");
  EXPECT_THAT(run.said, ::testing::Not(Contains(HasSubstr("is free to"))));
}

TEST(QualityOfRuns, a_push_is_in_balance_with_what_holds_against_it) {
  const auto run =
      bar(R"(<hold set="left"/><push set="right" force="10 0 0 N" rise="1 ms"/>)", "2 ms").summary.at("quality");
  EXPECT_LT(run.at("reactions_imbalance"), 0.01);
  EXPECT_EQ(run.at("verdict"), "good") << run.dump(1);
}

TEST(QualityOfRuns, a_run_of_nothing_is_idle) {
  EXPECT_EQ(bar(R"(<hold set="left"/>)", "200").summary.at("quality").at("verdict"), "idle");
}

}  // namespace
}  // namespace beadwork
