// Newton's iteration on one unknown: what it keeps, what it shortens, what it tells.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/base/failure.hpp"
#include "core/statics/newton.hpp"

namespace beadwork {
namespace {

SymmetricMatrix one_number() { return {{0, 1}, {0}, {1}}; }

// One unknown between a spring to the ground, by any law, and a dead load that grows with the time.
class OneSpring final : public StaticModel {
 public:
  using Law = std::function<Real(Real)>;
  OneSpring(Law law, Law slope) : law_(std::move(law)), slope_(std::move(slope)) {
    supports_.fixed = {0};
    matrix_ = one_number();
  }

  const Supports& supports() const override { return supports_; }
  void begin_trial(Real time) override { time_ = time; }
  Lacking lacking() const override { return {Vector::Zero(1), Vector()}; }
  void move(const Vector& by) override { place += by[0]; }
  const Vector& forces() override { return forces_ = Vector::Constant(1, time_ - law_(place)); }
  const SymmetricMatrix& stiffness(Slope slope) override {
    matrix_.value[0] = slope == Slope::secant ? law_(place) / place : slope_(place);
    return matrix_;
  }
  Vector force_rates() override { return Vector::Ones(1); }
  Lacking support_rates() const override { return lacking(); }
  Vector moved() const override { return Vector::Constant(1, place - accepted_); }
  Real work_on_the_way() override {
    Real work = 0;
    constexpr int pieces = 1000;
    for (int k = 0; k < pieces; ++k) work += time_ - law_(accepted_ + (k + 0.5) / pieces * (place - accepted_));
    return work * (place - accepted_) / pieces;
  }
  Real time() const override { return time_; }
  Real noise() const override { return 1e-14; }
  void pause() override {
    if (--iterations_left < 0) throw Interrupted("its user wants it to stop");
  }
  void give_up() override { place = accepted_, time_ = accepted_time_; }
  void accept() { accepted_ = place, accepted_time_ = time_; }

  Real place = 0;
  int iterations_left = 1000000;

 private:
  Law law_, slope_;
  Supports supports_;
  SymmetricMatrix matrix_;
  Vector forces_;
  Real time_ = 0, accepted_ = 0, accepted_time_ = 0;
};

struct Solving {
  OneSpring model;
  SupportedSystem system{linear_solver("simplicial")};
  Newton newton{model, system, {}};

  Solving(OneSpring::Law law, OneSpring::Law slope) : model(std::move(law), std::move(slope)) {
    system.analyse(one_number());
  }
};

TEST(Newtons, can_be_stopped_before_an_equilibrium_is_found) {
  Solving s([](Real u) { return u + u * u * u; }, [](Real u) { return 1 + 3 * u * u; });
  s.model.iterations_left = 2;
  EXPECT_THROW(s.newton.go(5, Manner::thorough), Interrupted);
  EXPECT_EQ(s.newton.costs().solves, 2);
}

Real stiffening(Real u) { return u + u * u * u / 10; }
Real its_slope(Real u) { return 1 + 3 * u * u / 10; }

TEST(Newtons, go_on_with_their_stiffness_from_one_increment_to_the_next) {
  Solving s([](Real u) { return 3 * u; }, [](Real) { return 3; });
  for (int k = 1; k <= 8; ++k) {
    EXPECT_TRUE(s.newton.go(k).converged());
    s.model.accept();
  }
  EXPECT_NEAR(s.model.place, 8 / 3., 1e-12);
  EXPECT_EQ(s.newton.costs().factors, 1);
}

// Where one iteration does, nothing else asks for a new one: and whether a state is stable, its pivots alone tell.
TEST(Newtons, find_a_new_stiffness_now_and_then_where_all_is_linear) {
  Solving s([](Real u) { return 3 * u; }, [](Real) { return 3; });
  for (int k = 1; k <= 50; ++k) {
    EXPECT_TRUE(s.newton.go(k).converged());
    s.model.accept();
  }
  EXPECT_EQ(s.newton.costs().factors, 3);
}

TEST(Newtons, give_a_stiffness_up_that_has_served_too_long) {
  Solving s(stiffening, its_slope);
  for (int k = 1; k <= 40; ++k) {
    ASSERT_TRUE(s.newton.go(0.05 * k).converged()) << k;
    s.model.accept();
    EXPECT_NEAR(stiffening(s.model.place), 0.05 * k, 1e-6 * k);
  }
  EXPECT_GT(s.newton.costs().factors, 1);
  EXPECT_LT(s.newton.costs().factors, 20);
}

TEST(Newtons, that_take_over_a_stiffness_come_to_the_same_bits) {
  Solving whole(stiffening, its_slope), second(stiffening, its_slope);
  for (int k = 1; k <= 7; ++k) {
    if (k == 5) {
      second.model.place = whole.model.place;
      second.model.accept();
      second.newton.take_factor(whole.system.stiffness(), whole.newton.served());
    }
    whole.newton.go(0.1 * k);
    whole.model.accept();
    if (k < 5) continue;
    second.newton.go(0.1 * k);
    second.model.accept();
    EXPECT_EQ(second.model.place, whole.model.place) << k;
  }
  EXPECT_LT(second.newton.costs().factors, whole.newton.costs().factors);
}

// From 0 the slope of atan leads to twice as far and more, and from there farther and farther.
TEST(Newtons, shorten_steps_that_lead_beyond_where_forces_vanish) {
  Solving s([](Real u) { return std::atan(u); }, [](Real u) { return 1 / (1 + u * u); });
  s.model.place = 3;
  s.model.accept();
  EXPECT_TRUE(s.newton.go(-0.5, Manner::thorough).converged());
  EXPECT_NEAR(s.model.place, -std::tan(0.5), 1e-6);
}

// Past the top of a sine the next equilibrium lies a turn farther on: near the top the stiffness itself leads far.
TEST(Newtons, refuse_an_equilibrium_beyond_a_snap) {
  Solving s([](Real u) { return std::sin(u) + 0.05 * u; }, [](Real u) { return std::cos(u) + 0.05; });
  Real load = 0;
  for (NewtonResult result; load < 1.2; s.model.accept()) {
    for (const Manner manner : {Manner::quick, Manner::thorough, Manner::careful}) {
      result = s.newton.go(load + 0.02, manner);
      if (result.converged()) break;
      s.model.give_up();
      s.newton.forget_factor();
    }
    if (!result.converged()) break;
    load += 0.02;
  }
  EXPECT_NEAR(load, 1.0787, 0.021);  // sin u + u/20 at cos u = -1/20
  EXPECT_LT(s.model.place, 1.63);
}

// The load is 1 at the top of a sine; behind it the way goes on where the load goes back.
TEST(Newtons, that_are_led_by_a_motion_go_over_a_peak) {
  Solving s([](Real u) { return std::sin(u); }, [](Real u) { return std::cos(u); });
  for (int k = 1; k <= 10; ++k) {
    ASSERT_TRUE(s.newton.go_by(Vector::Ones(1), 0.25).converged()) << k;
    EXPECT_NEAR(s.model.moved()[0], 0.25, 1e-12);
    EXPECT_NEAR(s.model.time(), std::sin(0.25 * k), 1e-6);
    s.model.accept();
  }
  EXPECT_NEAR(s.model.place, 2.5, 1e-12);
}

TEST(Newtons, tell_of_negative_pivots_at_the_state_that_they_begin_with) {
  Solving s([](Real u) { return std::sin(u); }, [](Real u) { return std::cos(u); });
  s.model.place = 2;  // past the top
  s.model.accept();
  EXPECT_EQ(s.newton.go(std::sin(2.) + 1e-3, Manner::thorough).negative, 1);
}

TEST(Supports_, have_a_sign_of_their_own) {
  Supports held;
  held.fixed = {0, 1, 0, 0};
  held.means.push_back({{0, 2}, 0});
  Supports same = held, other = held, pinned = held;
  other.fixed[3] = 1;
  pinned.means[0].pinned = 2;
  EXPECT_EQ(held.sign(), same.sign());
  EXPECT_NE(held.sign(), other.sign());
  EXPECT_NE(held.sign(), pinned.sign());
}

}  // namespace
}  // namespace beadwork
