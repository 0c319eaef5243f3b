// A bond law that damps by itself: an oscillator held against the closed form, its stable step, and its energy.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/deck_run.hpp"

namespace beadwork {
namespace {

constexpr Real stiffness = 1e6;
const Real mass = 2000 * 4.0 / 3 * std::numbers::pi * 1e-9;
const Real omega = std::sqrt(stiffness / mass);

// One element held, the other on a spring with a dashpot, at 1 m/s.
testing::DeckRun oscillator(Real zeta, const std::string& step, Real until, Real k = stiffness) {
  return testing::run_deck(fmt::format(R"(<scene>
    <fill>
      <element set="held" at="0 0 0 mm" radius="1 mm" density="2000 kg/m^3"/>
      <element set="free" at="2 0 0 mm" radius="1 mm" density="2000 kg/m^3"/>
    </fill>
    <bond><damped-spring name="spring" between="held free" stiffness="{:.17g} N/m" viscosity="{:.17g} N.s/m"/></bond>
    <load><hold set="held"/><initial-velocity set="free" velocity="1 0 0 m/s"/></load>
    <move><verlet {} until="{:.17g} s"/></move>
    <watch><energy-ledger every="1"/></watch>
  </scene>)",
                                       k, 2 * zeta * std::sqrt(stiffness * mass), step, until));
}

// Elongation after the time t [m].
Real closed_form(Real zeta, Real t) {
  const Real decay = std::exp(-zeta * omega * t);
  if (zeta == 1) return t * decay;
  const Real root = omega * std::sqrt(std::abs(zeta * zeta - 1));
  return decay / root * (zeta < 1 ? std::sin(root * t) : std::sinh(root * t));
}

class Oscillator : public ::testing::TestWithParam<Real> {};

TEST_P(Oscillator, decays_by_the_closed_form_to_second_order_in_the_step) {
  const Real zeta = GetParam();
  const Real until = 1.2 / omega;  // a whole number of each of the steps
  const auto error = [&](int steps) {
    const auto run = oscillator(zeta, fmt::format("time-step=\"{:.17g} s\"", until / steps), until * (1 + 1e-9));
    return (run.position[1] - run.position[0]).norm() - 2e-3 - closed_form(zeta, run.summary.at("time").get<Real>());
  };
  const Real coarse = error(24), fine = error(48);
  EXPECT_LT(std::abs(coarse), 3e-3 / omega);
  EXPECT_NEAR(coarse / fine, 4, 0.4) << coarse << " " << fine;
}

TEST_P(Oscillator, has_the_stable_step_of_the_closed_form_and_is_stable_below_it_alone) {
  const Real zeta = GetParam();
  const Real limit = 2 / omega * (std::sqrt(1 + 4 * zeta * zeta) - 2 * zeta);  // h^2 + 8 zeta h = 4
  const auto found = oscillator(zeta, "safety=\"0.98\"", 500 * limit);
  EXPECT_EQ(found.failure, "");
  EXPECT_NEAR(found.summary.at("time_step").get<Real>() / limit, 0.98, 1e-3);
  EXPECT_LT(std::abs(found.velocity[1][0]), 1);
  EXPECT_LT(found.velocity[1].norm(), 0.05) << "it should have come to rest";
  EXPECT_NE(oscillator(zeta, fmt::format("time-step=\"{:.17g} s\"", 1.03 * limit), 3000 * limit).failure, "");
}

TEST_P(Oscillator, books_what_its_damping_takes) {
  const Real zeta = GetParam();
  const auto residual = [&](int steps) {
    const auto run = oscillator(zeta, fmt::format("time-step=\"{:.17g} s\"", 3 / omega / steps), 3 / omega);
    return std::abs(run.energy("residual")) / run.energy("initial");
  };
  const Real coarse = residual(60), fine = residual(120);
  EXPECT_LT(coarse, 0.03);
  EXPECT_LT(fine, coarse / 3.3);
}

// The watch takes off what the scheme swings by and what the booking lags behind by; nothing else is left, be the step
// as long as it may.
TEST_P(Oscillator, keeps_its_balance_to_round_off_at_any_step) {
  for (const char* safety : {"0.95", "0.5", "0.1"}) {
    const auto run = oscillator(GetParam(), fmt::format("safety=\"{}\"", safety), 100 / omega);
    EXPECT_EQ(run.failure, "");
    EXPECT_LT(run.summary.at("quality").at("residual_over_work").get<Real>(), 1e-9) << safety;
  }
}

INSTANTIATE_TEST_SUITE_P(Damping, Oscillator, ::testing::Values(0.01, 0.1, 0.5, 1, 2));

TEST(Damping, limits_the_step_without_any_stiffness) {
  const Real c = 2 * std::sqrt(stiffness * mass);
  const auto run = oscillator(1, "safety=\"0.9\"", 20 * mass / c, 0);
  EXPECT_EQ(run.failure, "");
  EXPECT_NEAR(run.summary.at("time_step").get<Real>() / (mass / c), 0.9, 1e-3);  // 4 c dt/m = 4
}

}  // namespace
}  // namespace beadwork
