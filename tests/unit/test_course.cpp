#include "core/mechanics/course.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace beadwork {
namespace {

constexpr Real pi = std::numbers::pi;

VelocityCourse sine(Real speed, Real w) {
  return {[=](Real t) { return speed * std::sin(w * t); }, [=](Real t) { return speed * w * std::cos(w * t); }, {}};
}

// derived: the integral of v0 sin(w t) is v0/w (1 - cos(w t))
TEST(course, stands_where_the_integral_of_its_velocity_says) {
  const Real w = 2 * pi / 1e-3, speed = 0.002;
  const VelocityCourse course = sine(speed, w);
  for (const Real t : {0.0, 1e-9, 1.7e-5, 2.5e-4, 9.99e-4, 3.21e-3, 0.0234}) {
    EXPECT_NEAR(course.at(t).displacement, speed / w * (1 - std::cos(w * t)), 1e-12 * speed / w) << t;
    EXPECT_EQ(course.at(t).velocity, speed * std::sin(w * t));
    EXPECT_EQ(course.at(t).acceleration, speed * w * std::cos(w * t));
  }
}

TEST(course, does_not_depend_on_the_times_that_were_asked_before) {
  const Real w = 2 * pi / 1e-3;
  const VelocityCourse steps = sine(1, w), other_steps = sine(1, w);
  for (int k = 0; k <= 5000; ++k) steps.at(k * 1e-6);
  for (const Real t : {0.5e-6, 7e-6, 2.5e-4, 9.999e-4, 5e-3}) {
    const VelocityCourse fresh = sine(1, w);
    EXPECT_EQ(steps.at(t).displacement, fresh.at(t).displacement) << t;
    EXPECT_EQ(other_steps.at(t).displacement, fresh.at(t).displacement) << t;
  }
}

// derived: a square wave of 1 m/s that turns every 0.3 s, told of its jumps or not; |sin| bends where it is 0
TEST(course, goes_through_jumps_and_kinks_to_rounding) {
  const auto still = [](Real) { return Real(0); };
  const auto there_and_back = [](Real t) { return t < 0.3 ? 1.0 : t < 0.6 ? -1.0 : 0.0; };
  for (const auto& kinks : {std::vector<Real>{0.3, 0.6}, std::vector<Real>{}}) {
    const VelocityCourse course(there_and_back, still, kinks);
    EXPECT_NEAR(course.at(0.3).displacement, 0.3, 1e-15) << kinks.size();
    EXPECT_NEAR(course.at(0.45).displacement, 0.15, 1e-15) << kinks.size();
    EXPECT_NEAR(course.at(1).displacement, 0, 1e-15) << kinks.size();
  }
  const VelocityCourse bends([](Real t) { return std::abs(std::sin(pi * t)); },
                             [](Real t) { return (std::sin(pi * t) < 0 ? -pi : pi) * std::cos(pi * t); }, {});
  EXPECT_NEAR(bends.at(10).displacement, 20 / pi, 1e-14);
  EXPECT_NEAR(bends.at(10.5).displacement, 21 / pi, 1e-14);
}

// A pulse of a ten thousandth of the time that has passed is no more than a point to whoever looks at even times.
TEST(course, does_not_miss_a_short_pulse_whose_borders_it_is_told) {
  const auto pulse = [](Real t) { return t >= 1 && t < 1.0001 ? 5.0 : 0.0; };
  const VelocityCourse course(pulse, [](Real) { return 0.0; }, {1, 1.0001});
  EXPECT_NEAR(course.at(3).displacement, 5e-4, 1e-15);
}

// Panels end at powers of two and between: whole periods of such a sine, in which all that is odd cancels. Rounded
// times move the phase by 1e-16 wt in each of wt radians.
TEST(course, does_not_take_many_whole_periods_for_rest) {
  for (const Real period : {1.0, 1.0 / 64, 1e-3}) {
    const Real w = 2 * pi / period;
    const VelocityCourse course = sine(1, w);
    for (const Real t : {0.7, 9.2, 33.3, 150.4})
      EXPECT_NEAR(course.at(t).displacement * w, 1 - std::cos(w * t), 1e-14 + 2e-16 * w * t * w * t)
          << period << " " << t;
  }
}

TEST(course, resolves_a_slow_beginning_and_a_chirp) {
  // derived: the integrals are t^2.5/2.5 and sin(t^2); of the second a rounded time moves the velocity by 1e-16 * 4 t^3
  const VelocityCourse power([](Real t) { return t * std::sqrt(t); }, [](Real t) { return 1.5 * std::sqrt(t); }, {});
  for (const Real t : {1e-9, 1e-3, 2.0}) EXPECT_NEAR(power.at(t).displacement / std::pow(t, 2.5) * 2.5, 1, 1e-14) << t;
  const VelocityCourse chirp([](Real t) { return 2 * t * std::cos(t * t); },
                             [](Real t) { return 2 * std::cos(t * t) - 4 * t * t * std::sin(t * t); }, {});
  for (const Real t : {1.0, 10.0, 50.0}) EXPECT_NEAR(chirp.at(t).displacement, std::sin(t * t), 4e-15 * t * t) << t;
}

TEST(course, is_no_number_once_its_velocity_was_none) {
  const VelocityCourse course([](Real t) { return std::sqrt(1 - t); }, [](Real t) { return -0.5 / std::sqrt(1 - t); },
                              {});
  EXPECT_NEAR(course.at(0.5).displacement, 2.0 / 3 * (1 - std::pow(0.5, 1.5)), 1e-15);
  EXPECT_TRUE(std::isnan(course.at(1.5).displacement));
  EXPECT_TRUE(std::isnan(course.at(1e6).displacement));
  EXPECT_NEAR(course.at(0.5).displacement, 2.0 / 3 * (1 - std::pow(0.5, 1.5)), 1e-15);
}

TEST(course, gives_up_where_it_would_never_come_to_an_end) { EXPECT_THROW(sine(1, 1e9).at(1e9), std::runtime_error); }

TEST(course, has_moved_nothing_before_it_begins) {
  const VelocityCourse course([](Real t) { return 3 + t; }, [](Real) { return 1.0; }, {});
  EXPECT_EQ(course.at(-1).displacement, 0);
  EXPECT_EQ(course.at(-1).velocity, 3);
  EXPECT_EQ(course.at(0).displacement, 0);
  EXPECT_EQ(course.at(0).acceleration, 1);
}

}  // namespace
}  // namespace beadwork
