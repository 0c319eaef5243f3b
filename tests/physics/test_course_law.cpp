// Loads whose strength is a formula in time, and stages that wait for a sensor.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "tests/support/deck_run.hpp"

namespace beadwork {
namespace {

using ::testing::HasSubstr;

constexpr Real pi = std::numbers::pi;
const Real mass = 4.0 / 3 * pi * 1e-9 * 1000;  // of one ball

testing::DeckRun one_ball(const std::string& load, const std::string& step, const std::string& until,
                          const std::string& watch = "") {
  return testing::run_deck(fmt::format(R"(<scene>
    <fill><element set="all" at="0 0 0 mm" radius="1 mm" density="1000 kg/m^3"/></fill>
    <load>{}</load>
    <move><verlet time-step="{}" until="{}"/></move>
    <watch><energy-ledger every="1"/>{}</watch>
  </scene>)",
                                       load, step, until, watch));
}

std::string pull(const std::string& velocity, const std::string& more = "") {
  return fmt::format(R"(<pull set="all" axis="x" velocity="{}" {}/>)", velocity, more);
}

std::string push(const std::string& force, const std::string& more) {
  return fmt::format(R"(<push set="all" force="{}" {}/>)", force, more);
}

std::string factor(const std::string& formula) { return fmt::format(R"(factor="{}")", formula); }

Real largest_residual(const testing::DeckRun& run) {
  return std::max(run.largest("energy", "residual"), -run.smallest("energy", "residual"));
}

const std::string place = R"(<force-curve of="all" axis="x" every="1"/>)";

TEST(Course, pulls_an_element_to_v0_over_w_times_1_minus_cos_whatever_the_step) {
  const Real w = 2 * pi / 1e-3, amplitude = 2e-3 / w;
  for (const std::string step : {"0.37 us", "2 us", "31 us"}) {
    const auto run = one_ball(pull("2 mm/s * sin(2*pi * t / 1 ms)"), step, "1.3 ms", place);
    ASSERT_EQ(run.failure, "");
    for (const auto& row : run.curves.at("force"))
      EXPECT_NEAR(row.at("displacement"), amplitude * (1 - std::cos(w * row.at("time"))), 1e-12 * amplitude) << step;
    const Real end = run.curves.at("force").back().at("time");
    EXPECT_NEAR(run.position[0].x(), amplitude * (1 - std::cos(w * end)), 1e-12 * amplitude) << step;
    EXPECT_NEAR(run.velocity[0].x(), 2e-3 * std::sin(w * end), 1e-12 * 2e-3) << step;
  }
}

// Soft starts, of which early velocities are small differences of large terms, no more exact than these.
TEST(Course, follows_velocities_that_begin_as_differences) {
  const Real T = 2e-3;
  const std::pair<const char*, std::function<Real(Real)>> starts[] = {
      {"1 mm/s * (1 - cos(2*pi * t / 2 ms))", [&](Real t) { return t - T / (2 * pi) * std::sin(2 * pi * t / T); }},
      {"1 mm/s * (1 - exp(-t / 2 ms))", [&](Real t) { return t + T * std::expm1(-t / T); }},
      {"1 mm/s * ((1 + t / 2 ms)^2 - 1)", [&](Real t) { return t * t / T + t * t * t / (3 * T * T); }},
      {"1 mm/s * (t / 2 ms - sin(t / 2 ms))", [&](Real t) { return t * t / (2 * T) - T * (1 - std::cos(t / T)); }},
      {"if(t &lt; 1 ms, 0 mm/s, 1 mm/s * (1 - cos(2*pi * t / 2 ms)))",
       [&](Real t) { return t < 1e-3 ? 0 : t - 1e-3 - T / (2 * pi) * std::sin(2 * pi * t / T); }}};
  for (const auto& [formula, place_of] : starts) {
    const auto run = one_ball(pull(formula), "1 us", "3 ms", place);
    ASSERT_EQ(run.failure, "") << formula;
    for (const auto& row : run.curves.at("force"))
      EXPECT_NEAR(row.at("displacement"), 1e-3 * place_of(row.at("time")), 1e-3 * 1e-17)
          << formula << " at " << row.at("time");
  }
}

// Of a ball alone the grip's work is the kinetic energy, whatever the velocity does.
TEST(Course, does_the_work_that_the_energy_shows_through_kinks_and_jumps) {
  for (const std::string velocity : {"2 mm/s * sin(2*pi * t / 1 ms)", "2 mm/s * abs(sin(2*pi * t / 0.3 ms))",
                                     "if(t &lt; 0.2 ms, 1 mm/s, if(t &lt; 0.5 ms, -3 mm/s, 2 mm/s))"}) {
    const auto run = one_ball(pull(velocity), "1.7 us", "1 ms", place);
    ASSERT_EQ(run.failure, "") << velocity;
    EXPECT_LT(largest_residual(run), 1e-12 * run.largest("energy", "work")) << velocity;
  }
}

TEST(Course, ends_where_it_should_after_jumps_within_steps) {
  const auto run = one_ball(pull("if(t &lt; 0.2 ms, 1 mm/s, if(t &lt; 0.5 ms, -3 mm/s, 0))"), "1.7 us", "1 ms");
  EXPECT_NEAR(run.position[0].x(), 0.2e-6 - 0.9e-6, 1e-19);
}

TEST(Course, sets_in_over_the_rise_as_a_constant_does) {
  const auto constant = one_ball(pull("1 mm/s", R"(rise="0.3 ms")"), "1.7 us", "1 ms", place);
  const auto formula = one_ball(pull("if(t > 0 s, 1 mm/s, 2 mm/s)", R"(rise="0.3 ms")"), "1.7 us", "1 ms", place);
  const auto &wanted = constant.curves.at("force"), &got = formula.curves.at("force");
  ASSERT_EQ(wanted.size(), got.size());
  for (std::size_t k = 0; k < got.size(); ++k) {
    EXPECT_NEAR(got[k].at("displacement"), wanted[k].at("displacement"), 1e-15 * 1e-6) << k;
    EXPECT_NEAR(got[k].at("force"), wanted[k].at("force"), 1e-12 * mass * 1e-3 / 0.3e-3) << k;
  }
}

TEST(Course, that_does_not_change_gives_the_bits_of_the_quantity) {
  const auto plain = one_ball(pull("0.3 mm/s", R"(rise="0.1 ms")"), "1.7 us", "1 ms", place);
  for (const std::string same : {"${0.3} mm/s", "${0.3 mm/s}", "0.0003 m/s", "0.3 mm/s + 0"})
    EXPECT_EQ(one_ball(pull(same, R"(rise="0.1 ms")"), "1.7 us", "1 ms", place).curves, plain.curves) << same;
}

TEST(Course, that_is_no_number_from_a_time_on_ends_the_run_there_with_its_place) {
  const auto run = one_ball(pull("1 m/s * sqrt(1 - t / 50 us)"), "2 us", "100 us or 1 m");
  EXPECT_THAT(run.failure, HasSubstr("deck.xml:3:12: error: plugin load.pull prescribes at 5.")) << run.failure;
  EXPECT_THAT(run.failure, HasSubstr("they must be finite"));
}

// derived: v = F/(m w) (1 - cos wt); the scheme gives it to second order
TEST(PushCourse, gives_a_ball_the_energy_that_it_works) {
  const Real w = 2 * pi / 1e-3;
  Real before = 0;
  for (const Real step : {4e-6, 2e-6, 1e-6}) {
    const auto run = one_ball(push("1 0 0 mN", factor("sin(2*pi * t / 1 ms)")), fmt::format("{:.17g} s", step),
                              fmt::format("{}", std::lround(0.4e-3 / step)));
    ASSERT_EQ(run.failure, "");
    const Real speed = 1e-3 / (mass * w) * (1 - std::cos(w * 0.4e-3)), energy = 0.5 * mass * speed * speed;
    const Real error = std::abs(run.energy("work") / energy - 1);
    EXPECT_LT(error, 0.2 * std::pow(w * step, 2)) << step;
    if (before > 0) {
      EXPECT_NEAR(before / error, 4, 0.2) << step;
    }
    EXPECT_LT(largest_residual(run), 0.5 * std::pow(w * step, 2) * energy) << step;
    before = error;
  }
}

TEST(PushCourse, is_the_rise_where_it_says_the_same) {
  const std::string share = "(t / 0.5 ms)";
  const auto rise = one_ball(push("1 2 3 mN", R"(rise="0.5 ms")"), "1 us", "1 ms");
  const auto formula =
      one_ball(push("1 2 3 mN", factor(fmt::format("if(t &lt; 0.5 ms, {0}^3 * (10 - 15*{0} + 6*{0}^2), 1)", share))),
               "1 us", "1 ms");
  EXPECT_LT((formula.position[0] - rise.position[0]).norm(), 1e-13 * rise.position[0].norm());
  EXPECT_NEAR(formula.energy("work"), rise.energy("work"), 1e-12 * rise.energy("work"));
}

TEST(PushCourse, multiplies_what_sets_in) {
  const auto half = one_ball(push("1 2 3 mN", R"(rise="0.5 ms" factor="1/2")"), "1 us", "1 ms");
  const auto whole = one_ball(push("0.5 1 1.5 mN", R"(rise="0.5 ms")"), "1 us", "1 ms");
  EXPECT_LT((half.position[0] - whole.position[0]).norm(), 1e-14 * whole.position[0].norm());
}

TEST(PushCourse, that_is_no_number_ends_the_run_with_its_place) {
  const auto run = one_ball(push("1 0 0 mN", factor("sqrt(1 - t / 50 us)")), "2 us", "1 ms");
  EXPECT_THAT(run.failure, HasSubstr("deck.xml:3:52: error: 'factor' is no number at t = 5")) << run.failure;
}

// derived: v = -g/w sin(wt), of a weight that goes to and fro like cos(wt)
TEST(GravityCourse, gives_a_ball_the_energy_that_it_works) {
  const Real w = 2 * pi / 1e-3;
  const auto run = one_ball(
      fmt::format(R"(<gravity acceleration="0 0 -10 m/s^2" {}/>)", factor("cos(2*pi * t / 1 ms)")), "1 us", "200");
  ASSERT_EQ(run.failure, "");
  EXPECT_NEAR(run.velocity[0].z(), -10 / w * std::sin(w * 0.2e-3), 1e-5 * 10 / w);
  EXPECT_NEAR(run.energy("work"), 0.5 * mass * std::pow(run.velocity[0].z(), 2), 1e-4 * run.energy("work"));
}

std::string displacement(int every) {
  return fmt::format(R"(<sensor name="way" field="displacement" component="x" every="{}"/>)", every);
}

// derived: 1 mm/s times n us is more than 0.1234 um from step 124 on; a sensor that looks every seventh step sees it
// at 126
TEST(UntilSensor, ends_at_the_first_look_that_fulfils_it) {
  for (const auto& [every, step] : std::vector<std::pair<int, int>>{{1, 124}, {7, 126}, {100, 200}}) {
    const auto run = one_ball(pull("1 mm/s"), "1 us", "sensor way > 0.1234 um or 1000", displacement(every));
    ASSERT_EQ(run.failure, "");
    EXPECT_EQ(run.curves.at("way").back().at("step"), step) << every;
    EXPECT_EQ(run.summary.at("steps"), step) << every;
    EXPECT_THAT(run.summary.dump(), HasSubstr("stage 'run' reached sensor way > 0.1234 um"));
  }
}

// derived: 1 - cos(wt) of a pull to and fro falls below 0.5 at wt = 5/3 pi, 833.3 us
TEST(UntilSensor, waits_for_what_falls_and_for_the_first_of_several) {
  const auto run =
      one_ball(pull("1 m/s * sin(2*pi * t / 1 ms)"), "1 us", "sensor speed &lt; -2 m/s or sensor far &lt;= 0.5 or 2 ms",
               R"(<sensor name="speed" field="velocity" component="x" every="1"/>
                               <sensor name="far" field="displacement" component="x" reduce="count" where="value > 79.57747e-6" every="1"/>)");
  EXPECT_EQ(run.summary.at("steps"), 0) << "nothing is far at the beginning";
  const auto later = one_ball(pull("1 m/s * sin(2*pi * t / 1 ms)"), "1 us", "sensor speed &lt; -0.5 m/s or 2 ms",
                              R"(<sensor name="speed" field="velocity" component="x" every="1"/>)");
  EXPECT_EQ(later.summary.at("steps"), 584) << "sin(wt) = -1/2 at 7/12 of a period, 583.3 us";
}

TEST(UntilSensor, forgets_the_looks_of_the_stage_before) {
  const auto run = testing::run_deck(fmt::format(R"(<scene>
    <fill><element set="all" at="0 0 0 mm" radius="1 mm" density="1000 kg/m^3"/></fill>
    <load>{}</load>
    <move><verlet time-step="1 us"/></move>
    <stage name="one" until="sensor way > 10 nm"/>
    <stage name="two" until="sensor way > 10 nm"/>
    <watch>{}</watch>
  </scene>)",
                                                 pull("1 mm/s"), displacement(8)));
  EXPECT_EQ(run.failure, "");
  EXPECT_EQ(run.summary.at("steps"), 16) << "its first look in stage two is at its beginning, step 16, where it is due";
}

TEST(UntilSensor, of_all_stages_may_look_in_one_of_them) {
  const auto run = testing::run_deck(fmt::format(R"(<scene>
    <fill><element set="all" at="0 0 0 mm" radius="1 mm" density="1000 kg/m^3"/></fill>
    <load>{}</load>
    <move><verlet time-step="1 us" until="100 or sensor way > 110.5 nm"/></move>
    <stage name="one"/>
    <stage name="two"><watch>{}</watch></stage>
  </scene>)",
                                                 pull("1 mm/s"), displacement(1)));
  EXPECT_EQ(run.failure, "");
  EXPECT_EQ(run.summary.at("steps"), 111);
}

}  // namespace
}  // namespace beadwork
