// Grips alone: prescribed motions of a few balls, one step at a time, under forces that a test gives.

#include "core/dynamics/grips.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/dynamics/verlet_rows.hpp"
#include "tests/support/bench.hpp"

namespace beadwork {
namespace {

using testing::at_rest;
using testing::Bench;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A bench whose grips go through the steps of a mover; what else pulls on the balls `push` says.
class Held {
 public:
  Held(Bench& bench, Real beta, std::function<void(const Motion&)> push)
      : bench_(bench), beta_(beta), push_(std::move(push)), all_(bench.motion()), grips(bench, all_, 0) {
    grips.seize(bench_, all_, beta_);
    push_(all_);
    grips.react(bench_, all_, beta_);
  }
  void step() {
    Moment& now = bench_.moment();
    const VerletRows rows{all_, now.time_step, 0.5 * beta_ * now.time_step};
    grips.before_advance(bench_, all_);
    for (Index row = 0; row < all_.count; ++row) rows.advance<false>(Rows<1>{row});
    grips.after_advance(bench_, all_, beta_);
    now.time += now.time_step;
    ++now.step;
    push_(all_);
    grips.react(bench_, all_, beta_);
    for (Index row = 0; row < all_.count; ++row) rows.complete(Rows<1>{row});
    grips.after_correct(bench_, all_);
  }

 private:
  Bench& bench_;
  Real beta_;
  std::function<void(const Motion&)> push_;
  Motion all_;

 public:
  Grips grips;
};

constexpr Real acceleration = 3;
PrescribedMotion falling(Real t) { return {0.5 * acceleration * t * t, acceleration * t, acceleration}; }

TEST(Grips, moves_each_element_alike_by_the_force_that_is_lacking) {
  Bench bench({{Vec3(1, 0, 0), 2}, {Vec3(5, 7, 0), 3}, {Vec3(9, 0, 0), 1}});
  bench.prescribe({0, 1}, 0, Grip::each, falling);
  Held held(bench, 1, [](const Motion& all) {
    for (Index row = 0; row < 3; ++row) all.force.set(row, Vec3(-10, 1, 0));
  });
  const Constraint& c = bench.constraints()[0];
  EXPECT_NEAR(c.reaction, (2 + 3) * acceleration + 2 * 10, 1e-13);
  for (int k = 0; k < 10; ++k) held.step();
  const Motion all = bench.motion();
  EXPECT_NEAR(all.place[0].x(), 1 + 0.5 * acceleration, 1e-14);
  EXPECT_NEAR(all.place[1].x(), 5 + 0.5 * acceleration, 1e-14);
  EXPECT_NEAR(all.velocity[1].x(), acceleration, 1e-14);
  EXPECT_NEAR(all.place[1].y(), 7 + 0.5 / 3, 1e-14) << "along y it is free";
  EXPECT_NEAR(all.place[2].x(), 9 - 5, 1e-13) << "it is not gripped at all";
  EXPECT_NEAR(c.work, 0.5 * 5 * acceleration * acceleration + 20 * 0.5 * acceleration, 1e-12);
}

TEST(Grips, books_what_a_jump_of_velocity_brings_with_the_inertia_of_the_scheme) {
  for (const Real beta : {1.0, 0.5}) {
    Bench bench({{Vec3(0, 0, 0), 2}, {Vec3(5, 0, 0), 3}});
    bench.motion().velocity.set(0, Vec3(0, 1, 0));
    bench.prescribe({0, 1}, 1, Grip::each, [](Real t) { return PrescribedMotion{4 * t, 4, 0}; });
    const Held held(bench, beta, [](const Motion&) {});
    EXPECT_NEAR(bench.constraints()[0].work, (0.5 * 5 * 16 - 0.5 * 2) / beta, 1e-13);
  }
}

TEST(Grips, turns_elements_about_their_centres_by_just_the_angle_that_is_prescribed) {
  Bench bench({{Vec3(0, 0, 0), 1, 1, 0.25}});
  bench.prescribe({0}, 5, Grip::each, [](Real t) { return PrescribedMotion{t * t * t, 3 * t * t, 6 * t}; });
  Held held(bench, 1, [](const Motion& all) { all.torque.set(0, Vec3(0, 0, -2)); });
  for (int k = 0; k < 10; ++k) held.step();
  const Motion all = bench.motion();
  EXPECT_NEAR(all.orientation[0].w, std::cos(0.5), 1e-14);
  EXPECT_NEAR(all.orientation[0].v[2], std::sin(0.5), 1e-14);
  EXPECT_NEAR(bench.constraints()[0].reaction, 0.25 * 6 + 2, 1e-13);
  EXPECT_NEAR(bench.constraints()[0].work, 0.5 * 0.25 * 9 + 2 * 1, 1e-13);
}

TEST(Grips, hold_nothing_where_nothing_turns) {
  Bench bench({{Vec3(0, 0, 0), 1}}, {}, false);
  bench.prescribe({0}, 3, Grip::each, falling);
  Held held(bench, 1, [](const Motion&) {});
  held.step();
  EXPECT_EQ(bench.constraints()[0].reaction, 0);
  EXPECT_EQ(bench.constraints()[0].work, 0);
}

TEST(Grips, shares_the_force_of_a_mean_so_that_light_elements_give_way_more) {
  Bench bench({{Vec3(0, 0, 0), 1}, {Vec3(4, 0, 0), 3}});
  bench.prescribe({0, 1}, 0, Grip::mean, at_rest);
  const Real pull = 8;
  Held held(bench, 1, [&](const Motion& all) {
    all.force.set(0, Vec3(pull, 0, 0));
    all.force.set(1, Vec3::Zero());
  });
  // a1 + a2 = 0 with 1 a1 = pull + f and 3 a2 = f
  const Real share = -pull / (1 + 1.0 / 3);
  EXPECT_NEAR(bench.constraints()[0].reaction, 2 * share, 1e-13);
  for (int k = 0; k < 10; ++k) held.step();
  const Motion all = bench.motion();
  EXPECT_NEAR(all.place[0].x() + all.place[1].x(), 4, 1e-14);
  EXPECT_NEAR(all.place[0].x(), 0.5 * (pull + share), 1e-13);
  EXPECT_NEAR(all.velocity[1].x(), share / 3, 1e-13);
  EXPECT_EQ(bench.constraints()[0].work, 0) << "a mean at rest makes no way";
}

TEST(Grips, of_means_tell_how_much_of_the_forces_they_keep_from_moving_anything) {
  Bench bench({{Vec3(0, 0, 0), 1}, {Vec3(4, 0, 0), 3}, {Vec3(8, 0, 0), 1}});
  bench.prescribe({0, 1}, 0, Grip::mean, at_rest);
  bench.prescribe({2}, 0, Grip::each, at_rest);
  const Motion all = bench.motion();
  Grips grips(bench, all, 0);
  for (Index row = 0; row < 3; ++row) all.force.set(row, Vec3(row == 1 ? 0 : 8, 5, 0));
  EXPECT_NEAR(grips.held_by_means(all), 8 * 8 / (1 + 1.0 / 3), 1e-12);
  grips.react(bench, all, 1);
  EXPECT_NEAR(grips.held_by_means(all), 0, 1e-12) << "the mean feels no force any more";
}

TEST(Grips, of_a_mean_and_of_each_differ_in_what_they_drive) {
  Bench bench({{Vec3(0, 0, 0), 1}, {Vec3(4, 0, 0), 3}, {Vec3(8, 0, 0), 3}});
  bench.prescribe({0, 1}, 0, Grip::mean, at_rest);
  bench.prescribe({1}, 4, Grip::each, at_rest);
  const Grips grips(bench, bench.motion(), 0);
  EXPECT_THAT(grips.rows(), ElementsAre(0, 1));
  EXPECT_EQ(grips.held(0), 0b1u);
  EXPECT_EQ(grips.driven(0), 0u);
  EXPECT_EQ(grips.held(1), 0b10001u);
  EXPECT_EQ(grips.driven(1), 0b10000u);
  EXPECT_TRUE(grips.drives(1, 4));
  EXPECT_FALSE(grips.drives(1, 0));
  EXPECT_TRUE(grips.holds_any(0, 3));
  EXPECT_FALSE(grips.holds_any(2, 1));
}

// ---- what breaks

// A row of four, of which a mean holds the first three; the third hangs on the fourth.
Bench row_of_four() {
  return Bench({{Vec3(0, 0, 0), 1}, {Vec3(2, 0, 0), 1}, {Vec3(4, 0, 0), 1}, {Vec3(6, 0, 0), 1}},
               {{0, 1}, {1, 2}, {2, 3}});
}

TEST(Grips, leaves_what_no_bond_holds_out_of_a_mean) {
  Bench bench = Bench({{Vec3(0, 0, 0), 1}, {Vec3(2, 0, 0), 1}, {Vec3(40, 0, 0), 1}}, {{0, 1}});
  bench.prescribe({0, 1, 2}, 0, Grip::mean, at_rest);
  const Grips grips(bench, bench.motion(), 0);
  EXPECT_THAT(grips.rows(), ElementsAre(0, 1));
  ASSERT_EQ(bench.said.size(), 1u);
  EXPECT_THAT(bench.said[0], HasSubstr("1 of the 3 elements of 'set 1'"));
  Bench loose({{Vec3(0, 0, 0), 1}, {Vec3(40, 0, 0), 1}});
  loose.prescribe({0, 1}, 0, Grip::mean, at_rest);
  EXPECT_THAT(Grips(loose, loose.motion(), 0).rows(), ElementsAre(0, 1)) << "where no bond holds any, all are meant";
  loose.prescribe({0, 1}, 1, Grip::each, at_rest);
  EXPECT_EQ(loose.said.size(), 0u);
}

TEST(Grips, are_loosened_by_breaks_at_the_members_of_a_mean_alone) {
  Bench bench = row_of_four();
  bench.prescribe({0}, 0, Grip::mean, at_rest);
  bench.prescribe({3}, 0, Grip::each, at_rest);
  const Grips grips(bench, bench.motion(), 0);
  bench.break_bond(0);
  bench.break_bond(2);
  const auto& breaks = bench.domain().breaks().breaks;
  EXPECT_TRUE(grips.loosened(breaks, 0));
  EXPECT_FALSE(grips.loosened(breaks, 1)) << "bond 2 is not at the mean";
  EXPECT_FALSE(grips.loosened(breaks, 2));
}

TEST(Grips, take_over_what_a_mean_has_let_go_with_half_a_step_of_its_share) {
  Bench bench({{Vec3(0, 0, 0), 1}, {Vec3(2, 0, 0), 1}, {Vec3(40, 0, 0), 4}}, {{0, 1}, {1, 2}});
  bench.prescribe({0, 1, 2}, 0, Grip::mean, at_rest);
  const Motion all = bench.motion();
  Grips before(bench, all, 0);
  for (Index row = 0; row < 3; ++row) {
    all.force.set(row, Vec3(row == 2 ? -12 : 0, 0, 0));
    all.velocity.set(row, Vec3(row == 2 ? 5 : -2.5, 0, 0));
  }
  before.react(bench, all, 1);
  Constraint& c = bench.constraints()[0];
  const Real share = 3 / (1 + 1 + 0.25);  // a0 + a1 + a2 = 0 with a0 = a1 = f and 4 a2 = f - 12
  EXPECT_NEAR(c.reaction, 3 * share, 1e-13);
  bench.moment().step = 7;
  bench.break_bond(1);
  const Grips anew(bench, all, 7);
  EXPECT_THAT(anew.rows(), ElementsAre(0, 1));
  anew.take_over(bench, before, all);
  EXPECT_NEAR(c.reaction, 2 * share, 1e-13);
  const Real way = 0.1 * (5 + 0.05 * (share - 12) / 4);
  EXPECT_NEAR(c.work, 0.5 * share * way, 1e-13);
}

TEST(Grips, know_once_bonds_have_broken_that_they_need_not_hold_them_any_more) {
  Bench bench({{Vec3(0, 0, 0), 2}, {Vec3(2, 0, 0), 2}});
  bench.prescribe({0, 1}, 0, Grip::each, falling);
  bench.prescribe({0, 1}, 1, Grip::mean, at_rest);
  const Motion all = bench.motion();
  Grips grips(bench, all, 0);
  all.force.set(0, Vec3(-7, -6, 0));
  grips.react(bench, all, 1);
  EXPECT_NEAR(bench.constraints()[0].reaction, 4 * acceleration + 7, 1e-13);
  EXPECT_NEAR(bench.constraints()[1].reaction, 6, 1e-13);
  all.force.add(0, Vec3(7, 6, 0));  // the bond that pulled acts no longer
  grips.bonds_broke(bench, all, 1);
  EXPECT_NEAR(bench.constraints()[0].reaction, 4 * acceleration, 1e-13);
  EXPECT_NEAR(bench.constraints()[1].reaction, 0, 1e-13);
}

// ---- a body that turns

TEST(Grips, turn_a_body_about_its_axis_by_torque_and_force) {
  Bench bench({{Vec3(3, 1, 5), 2, 1, 0.5}, {Vec3(1, 5, 6), 1, 1, 0.25}});
  const auto from = bench.domain().elements().add({"from", On::elements, Type::vec3, "m", "", ""}).view<Vec3>();
  for (Index row = 0; row < 2; ++row) from.set(row, bench.motion().place[row]);
  Constraint& c = bench.prescribe({0, 1}, 5, Grip::each, falling);
  c.body.emplace(Vec3(1, 1, 0), "from");
  const Vec3 push(0.5, 7, -3);
  Held held(bench, 1, [&](const Motion& all) {
    all.force.set(0, push);
    all.force.set(1, Vec3::Zero());
    for (Index row = 0; row < 2; ++row) all.torque.set(row, Vec3(1, 1, row));
  });
  const Real inertia = 2 * 4 + 0.5 + 1 * 16 + 0.25;
  EXPECT_NEAR(c.reaction, inertia * acceleration - 2 * 7 - 1, 1e-12) << "the push has an arm of 2, one couple is 1";
  // accelerations at rest: 2 m along y, 4 m along -x
  EXPECT_LT((c.force() - Vec3(-4 * acceleration, 2 * 2 * acceleration, 0) + push).norm(), 1e-12);
  for (int k = 0; k < 10; ++k) held.step();
  const Motion all = bench.motion();
  const Real angle = 0.5 * acceleration;
  EXPECT_LT((all.place[0] - Vec3(1 + 2 * std::cos(angle), 1 + 2 * std::sin(angle), 5)).norm(), 1e-14);
  EXPECT_LT((all.velocity[0] - acceleration * Vec3(-2 * std::sin(angle), 2 * std::cos(angle), 0)).norm(), 1e-13);
  EXPECT_LT((all.spin[1] - Vec3(0, 0, acceleration)).norm(), 1e-14);
  EXPECT_NEAR(all.orientation[1].v[2], std::sin(0.5 * angle), 1e-14);
  EXPECT_EQ(all.orientation[1].v[0], 0);
  // work: of inertia, against the couple, and against the push by the trapezoid of its torque
  const auto angle_at = [](int k) { return 0.5 * acceleration * 0.01 * k * k; };
  const auto torque_at = [&](int k) { return 2 * (std::cos(angle_at(k)) * 7 - std::sin(angle_at(k)) * 0.5); };
  Real work = 0.5 * inertia * acceleration * acceleration - angle;
  for (int k = 0; k < 10; ++k) work -= 0.5 * (torque_at(k) + torque_at(k + 1)) * (angle_at(k + 1) - angle_at(k));
  EXPECT_NEAR(c.work, work, 1e-11);
  EXPECT_EQ(held.grips.driven(0), 0b111111u);
}

TEST(Grips, leave_a_body_free_along_its_axis_if_it_is_to_be) {
  Bench bench({{Vec3(1, 0, 0), 2}});
  bench.domain().elements().add({"from", On::elements, Type::vec3, "m", "", ""}).view<Vec3>().set(0, Vec3(1, 0, 0));
  Constraint& c = bench.prescribe({0}, 5, Grip::each, falling);
  c.body.emplace(Vec3(0, 0, 0), "from", false);
  Held held(bench, 1, [&](const Motion& all) { all.force.set(0, Vec3(0, 0, 4)); });
  EXPECT_EQ(held.grips.driven(0), 0b111011u);
  EXPECT_EQ(c.force().z(), 0);
  for (int k = 0; k < 10; ++k) held.step();
  EXPECT_NEAR(bench.motion().place[0].z(), 1, 1e-14);
  EXPECT_NEAR(bench.motion().place[0].x(), std::cos(0.5 * acceleration), 1e-14);
}

}  // namespace
}  // namespace beadwork
