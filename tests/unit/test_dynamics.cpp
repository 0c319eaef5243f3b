// The parts that explicit movers share, each alone on a few balls: what a step does, what damping takes, what a step may
// be, and what is noticed where it goes wrong. Grips: test_grips.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/failure.hpp"
#include "core/dynamics/beta_damping.hpp"
#include "core/dynamics/dashpots.hpp"
#include "core/dynamics/law_damping.hpp"
#include "core/dynamics/local_damping.hpp"
#include "core/dynamics/rayleigh.hpp"
#include "core/dynamics/shadow.hpp"
#include "core/dynamics/stability_watch.hpp"
#include "core/dynamics/stable_step.hpp"
#include "core/dynamics/verlet_rows.hpp"
#include "tests/support/bench.hpp"

namespace beadwork {
namespace {

using ::testing::AllOf;
using testing::at_rest;
using testing::Ball;
using testing::Bench;
using ::testing::HasSubstr;

template <class F>
std::string failure_of(const F& task) {
  try {
    task();
  } catch (const PhysicsFailure& failure) {
    return failure.what();
  }
  return "";
}

std::vector<Ball> row_of(Index count) {
  std::vector<Ball> balls;
  for (Index k = 0; k < count; ++k) balls.push_back({Vec3(2.0 * k, 0, 0), 1.0 + k, 1, 0.5 + k});
  return balls;
}

// ---- rows of Verlet

TEST(VerletRows, carry_a_ball_on_its_parabola_and_a_spin_through_its_angle) {
  Bench bench(row_of(7));  // packs, and what is left of them
  const Motion all = bench.motion();
  for (Index row = 0; row < 7; ++row) {
    all.velocity.set(row, Vec3(1, 0, 2));
    all.force.set(row, all.mass[row] * Vec3(0, -10, 0));
    all.spin.set(row, Vec3(0, 0, 0.5));
    all.torque.set(row, all.inertia[row] * Vec3(0, 0, 3));
  }
  const VerletRows rows{all, 0.1, 0.05};
  EXPECT_FALSE(rows::any_of(7, [&](const auto& at) { return any(rows.advance<false>(at)); }));
  for (int step = 1; step < 10; ++step)
    EXPECT_FALSE(rows::any_of(7, [&](const auto& at) { return any(rows.advance<true>(at)); }));
  EXPECT_NEAR(all.velocity[3].y(), -9.5, 1e-13) << "half a step behind the places";
  EXPECT_FALSE(rows::any_of(7, [&](const auto& at) { return any(rows.complete(at)); }));
  for (Index row = 0; row < 7; ++row) {
    EXPECT_LT((all.place[row] - Vec3(2.0 * row + 1, -5, 2)).norm(), 1e-13) << row;
    EXPECT_LT((all.velocity[row] - Vec3(1, -10, 2)).norm(), 1e-13) << row;
    EXPECT_NEAR(all.spin[row].z(), 3.5, 1e-13);
    EXPECT_NEAR(all.orientation[row].w, std::cos(0.5 * 2), 1e-14);
    EXPECT_NEAR(all.orientation[row].v[2], std::sin(0.5 * 2), 1e-14);
  }
}

TEST(VerletRows, give_velocities_a_share_beta_of_what_forces_would) {
  Bench bench({{Vec3(0, 0, 0), 2}});
  const Motion all = bench.motion();
  all.force.set(0, Vec3(8, 0, 0));
  const VerletRows rows{all, 0.1, 0.5 * 0.25 * 0.1};
  rows.advance<false>(Rows<1>{0});
  rows.complete(Rows<1>{0});
  EXPECT_NEAR(all.velocity[0].x(), 0.25 * 4 * 0.1, 1e-15);
  EXPECT_NEAR(all.place[0].x(), 0.5 * 4 * 0.01, 1e-15);
}

TEST(VerletRows, notice_a_load_that_is_no_number_wherever_it_stands) {
  for (const Index odd : {0, 3, 6})
    for (const bool torque : {false, true}) {
      Bench bench(row_of(7));
      const Motion all = bench.motion();
      (torque ? all.torque : all.force).set(odd, Vec3(0, std::numeric_limits<Real>::infinity(), 0));
      const VerletRows rows{all, 0.1, 0.05};
      EXPECT_TRUE(rows::any_of(7, [&](const auto& at) { return any(rows.complete(at)); })) << odd << torque;
      EXPECT_TRUE(rows::any_of(7, [&](const auto& at) { return any(rows.advance<true>(at)); })) << odd << torque;
    }
}

// ---- damping

TEST(LocalDamping, turns_a_share_of_each_load_against_the_motion_unless_something_prescribes_it) {
  Bench bench(row_of(7));
  bench.prescribe({4}, 0, Grip::each, at_rest);
  bench.prescribe({5}, 5, Grip::each, at_rest);
  const Motion all = bench.motion();
  const Grips grips(bench, all, 0);
  for (Index row = 0; row < 7; ++row) {
    all.velocity.set(row, Vec3(2, -2, 0));
    all.force.set(row, Vec3(10, 10, 10));
    all.spin.set(row, Vec3(0, 0, 1));
    all.torque.set(row, Vec3(0, 0, -4));
  }
  const Real half = 0.01;
  const Real power = damp_locally(all, grips, 0.3, half);
  Real expected = 0;
  for (Index row = 0; row < 7; ++row) {
    EXPECT_EQ(all.force[row], Vec3(row == 4 ? 10 : 7, 13, 10)) << row;  // a load that is not moved along stays
    EXPECT_EQ(all.torque[row], Vec3(0, 0, row == 5 ? -4 : -5.2)) << row;
    const Real m = all.mass[row], inertia = all.inertia[row];
    expected += (row == 4 ? 0 : 3 * (2 + half * 7 / m)) + -3 * (-2 + half * 13 / m);
    expected += row == 5 ? 0 : 1.2 * (1 - half * 5.2 / inertia);
  }
  EXPECT_NEAR(power, expected, 1e-12);
}

TEST(BetaDamping, takes_energy_by_the_change_of_velocities_that_nothing_prescribes) {
  Bench bench({{Vec3(0, 0, 0), 2, 1, 0.5}, {Vec3(4, 0, 0), 3, 1, 0.5}});
  bench.prescribe({1}, 0, Grip::each, at_rest);
  const Motion all = bench.motion();
  const Grips grips(bench, all, 0);
  all.velocity.set(0, Vec3(1, 0, 0));
  BetaDamping damping;
  damping.remember(all);
  all.velocity.set(0, Vec3(3, 1, 0));
  all.velocity.set(1, Vec3(100, 2, 0));
  all.spin.set(0, Vec3(0, 0, 4));
  const Real squared = 2 * (4 + 1) + 3 * 4 + 0.5 * 16;
  EXPECT_NEAR(damping.taken(all, grips, 0.5), 0.5 / (2 * 0.25) * squared, 1e-13);
  EXPECT_EQ(damping.taken(all, grips, 1), 0);
}

// Two balls on a bond along x, of stiffnesses whose dashpots are plain numbers.
class Pair {
 public:
  explicit Pair(Real zeta, bool softens = false)
      : bench({{Vec3(0, 0, 0), 2, 1, 2}, {Vec3(2, 0, 0), 2, 1, 2}}, {{0, 1}}) {
    bench.law.stiff = {100, 36, 25, 16};
    bench.law.softens = softens;
    all = bench.motion();
    dashpots.prepare(bench, zeta, all.mass, all.inertia, false);
  }
  void act(Real half_step = 0) {
    bench.domain().clear_loads();
    dashpots.act(bench.domain(), all, half_step);
  }
  Bench bench;
  Motion all;
  Dashpots dashpots;
};

TEST(Dashpots, give_each_mode_of_a_pair_the_damping_ratio) {
  constexpr Real zeta = 0.1;
  Pair pair(zeta);
  const Motion& all = pair.all;
  // along: c = 2 zeta sqrt(k m), m = 1
  all.velocity.set(1, Vec3(3, 0, 0));
  pair.act();
  EXPECT_LT((all.force[1] - Vec3(-2 * zeta * 10 * 3, 0, 0)).norm(), 1e-13);
  EXPECT_LT((all.force[0] + all.force[1]).norm(), 1e-15);
  EXPECT_EQ(all.torque[0], Vec3::Zero());
  EXPECT_NEAR(pair.dashpots.power(all.velocity, all.spin), 2 * zeta * 10 * 9, 1e-12);
  // across: 1/m = 1 + L^2/4 (1/I1 + 1/I2) = 2
  all.velocity.set(1, Vec3(0, 0, 3));
  pair.act();
  const Real across = 2 * zeta * std::sqrt(36 / 2.0) * 3;
  EXPECT_LT((all.force[1] - Vec3(0, 0, -across)).norm(), 1e-13);
  EXPECT_LT((Vec3(2, 0, 0).cross(Vec3(all.force[1])) + all.torque[0] + all.torque[1]).norm(), 1e-13)
      << "the angular momentum is kept";
  // bending and twist: 1/I = 1
  all.velocity.set(1, Vec3::Zero());
  all.spin.set(0, Vec3(-4, -5, 0));
  all.spin.set(1, Vec3(4, 5, 0));
  pair.act();
  EXPECT_LT((all.torque[1] - Vec3(-2 * zeta * 4 * 8, -2 * zeta * 5 * 10, 0)).norm(), 1e-12);
  EXPECT_LT((all.torque[0] + all.torque[1]).norm(), 1e-15);
  EXPECT_LT(all.force[1].norm(), 1e-15);
}

TEST(Dashpots, do_not_brake_a_body_that_moves_and_turns_as_one) {
  Pair pair(0.5);
  const Vec3 v(1, 2, 3), w(0.3, -2, 5);
  for (Index row = 0; row < 2; ++row) {
    pair.all.velocity.set(row, v + w.cross(pair.all.place[row]));
    pair.all.spin.set(row, w);
  }
  pair.act();
  EXPECT_LT(pair.all.force[1].norm(), 1e-13);
  EXPECT_LT(pair.all.torque[0].norm() + pair.all.torque[1].norm(), 1e-13);
  // seen half a step later it must be the chord of then that counts: places turn on
  for (Index row = 0; row < 2; ++row) pair.all.place.add(row, 0.01 * pair.all.velocity[row]);
  pair.act(0.01);
  EXPECT_LT(pair.all.force[1].norm(), 1e-12);
  pair.act(0);
  EXPECT_GT(pair.all.force[1].norm(), 0.1);
}

TEST(Dashpots, tell_by_how_much_what_is_booked_for_them_lags) {
  Pair pair(0.1);
  pair.all.velocity.set(1, Vec3(3, 0, 0));
  pair.bench.domain().clear_loads();
  pair.all.force.set(1, Vec3(-50, 0, 0));  // the spring's
  pair.dashpots.act(pair.bench.domain(), pair.all, 0);
  EXPECT_NEAR(pair.all.force[1].x(), -56, 1e-13);
  // their force times the whole acceleration, of both ends
  EXPECT_NEAR(pair.dashpots.lag(pair.all, 0.2), 0.2 * 0.2 / 4 * (-6 * -56 / 2.0 + 6 * 6 / 2.0), 1e-13);
}

TEST(Dashpots, stiffen_their_bonds_by_two_over_the_step_and_leave_those_alone_that_soften) {
  Pair pair(0.1);
  const Matrix12 more = pair.dashpots.stiffening(pair.bench.table(), 0, Vec3(2, 0, 0), 0.01);
  EXPECT_NEAR(more(6, 6), 2 / 0.01 * 2, 1e-10);
  EXPECT_NEAR(more(0, 6), -2 / 0.01 * 2, 1e-10);
  Pair soft(0.1, true);
  EXPECT_FALSE(soft.dashpots.any());
  EXPECT_EQ(soft.dashpots.power(soft.all.velocity, soft.all.spin), 0);
  EXPECT_EQ(soft.dashpots.stiffening(soft.bench.table(), 0, Vec3(2, 0, 0), 0.01).norm(), 0);
}

TEST(LawDamping, finds_forces_at_foreseen_velocities_and_puts_the_others_back) {
  Bench bench({{Vec3(0, 0, 0), 2}, {Vec3(2, 0, 0), 4}}, {{0, 1}});
  bench.law.viscous = {5, 0, 0, 3};
  const Motion all = bench.motion();
  LawDamping damping;
  damping.prepare(bench);
  ASSERT_TRUE(damping.acts());
  all.velocity.set(1, Vec3(1, 0, 0));
  all.spin.set(1, Vec3(7, 0, 0));
  Vec3 seen = Vec3::Zero();
  damping.evaluate(
      all, [&] { all.velocity.set(1, Vec3(3, 0, 0)); }, [&] { seen = all.velocity[1]; });
  EXPECT_EQ(seen, Vec3(3, 0, 0));
  EXPECT_EQ(all.velocity[1], Vec3(1, 0, 0));
  // the force found with 3 m/s acts on what came to be 2 m/s
  all.velocity.set(1, Vec3(2, 0, 0));
  EXPECT_NEAR(damping.power(bench, all), 5 * 3 * 2 + 3 * 7 * 7, 1e-12);
  EXPECT_EQ(all.velocity[1], Vec3(2, 0, 0));
  EXPECT_EQ(all.spin[1], Vec3(7, 0, 0));
  // -f.a with f = -15 N, -21 N m on the second; a = 10/4 m/s2, -2 1/s2
  all.force.set(1, Vec3(10, 0, 0));
  all.torque.set(1, Vec3(-2, 0, 0));
  EXPECT_NEAR(damping.lag(bench, all, 0.2), -0.2 * 0.2 / 4 * (15 * 2.5 - 21 * 2), 1e-12);
}

TEST(LawDamping, is_nothing_where_no_law_moves) {
  Bench bench({{Vec3(0, 0, 0), 2}, {Vec3(2, 0, 0), 4}}, {{0, 1}});
  LawDamping damping;
  damping.prepare(bench);
  EXPECT_FALSE(damping.acts());
  EXPECT_EQ(damping.power(bench, bench.motion()), 0);
  EXPECT_EQ(damping.lag(bench, bench.motion(), 0.1), 0);
}

// ---- what the scheme keeps, and what a step may be

TEST(Shadow, is_an_eighth_of_the_squared_step_times_force_squared_over_mass_of_what_is_free) {
  Bench bench({{Vec3(0, 0, 0), 2, 1, 0.5}, {Vec3(4, 0, 0), 4, 1, 0.5}});
  bench.prescribe({1}, 0, Grip::each, at_rest);
  bench.prescribe({0, 1}, 1, Grip::mean, at_rest);
  const Motion all = bench.motion();
  const Grips grips(bench, all, 0);
  all.force.set(0, Vec3(6, 0, 0));
  all.force.set(1, Vec3(100, 8, 0));
  all.torque.set(0, Vec3(0, 0, 3));
  const Real sum = 36 / 2.0 + 64 / 4.0 + 9 / 0.5;
  EXPECT_NEAR(shadow(all, grips, 0.2, 0), 0.04 / 8 * sum, 1e-14);
  EXPECT_NEAR(shadow(all, grips, 0.2, 0.5), 3 * 0.04 / 8 * sum, 1e-14);
}

TEST(RayleighQuotient, is_that_of_the_stiffness_in_the_direction_of_the_motion) {
  Bench bench({{Vec3(0, 0, 0), 2, 1, 0.5}, {Vec3(4, 0, 0), 4, 1, 0.5}});
  const Motion all = bench.motion();
  const Real dt = 0.01, k = 300, twist = 20;
  const auto quotient = [&] {
    const Grips grips(bench, all, 0);
    all.velocity.set(0, Vec3(1, 0, 0));
    all.velocity.set(1, Vec3(-2, 0, 0));
    all.spin.set(1, Vec3(0, 0, 3));
    all.force.set(0, Vec3(5, 0, 0));
    RayleighQuotient of;
    of.remember(all);
    EXPECT_TRUE(of.remembers());
    all.force.add(0, Vec3(-k * 3 * dt, 0, 0));  // a spring between the two
    all.force.add(1, Vec3(k * 3 * dt, 0, 0));
    all.torque.add(1, Vec3(0, 0, -twist * 3 * dt));
    const Real found = of.of_step(all, grips, dt);
    EXPECT_FALSE(of.remembers());
    return found;
  };
  const Real inert = 2 + 4 * 4 + 0.5 * 9;
  EXPECT_NEAR(quotient() / (0.25 * dt * dt * (k * 9 + twist * 9) / inert), 1, 1e-12);
  bench.prescribe({1}, 0, Grip::each, at_rest);  // has no force of its own, but inertia
  EXPECT_NEAR(quotient() / (0.25 * dt * dt * (k * 3 + twist * 9) / inert), 1, 1e-12);
}

StepLimit limit_of(Bench& bench, Real more = 0) {
  const Motion all = bench.motion();
  return step_limit(bench, all.mass, all.inertia,
                    [&](const PairLaw& law, const BondTable& table, Index row, const Vec3&) {
                      return Matrix12(more * law.tangent(bench.domain(), table, row, Slope::stiffest));
                    });
}

TEST(StableStep, is_two_over_the_highest_frequency) {
  Bench bench({{Vec3(0, 0, 0), 2, 1, 2}, {Vec3(2, 0, 0), 3, 1, 2}}, {{0, 1}});
  bench.law.stiff.along = 120;
  EXPECT_NEAR(limit_of(bench).time_step * std::sqrt(120 * (1 / 2.0 + 1 / 3.0)) / 2, 1, 1e-6);
  EXPECT_THAT(limit_of(bench).by, AllOf(HasSubstr("element 0, which moves"), HasSubstr("'bonds'")));
  EXPECT_NEAR(limit_of(bench, 3).time_step / limit_of(bench).time_step, 0.5, 1e-6) << "four times as stiff";
  bench.law.stiff.twisting = 1000;
  EXPECT_NEAR(limit_of(bench).time_step * std::sqrt(1000.0) / 2, 1, 1e-6);
  EXPECT_THAT(limit_of(bench).by, HasSubstr("which turns"));
}

TEST(StableStep, knows_what_is_prescribed_and_what_is_so_only_on_the_mean) {
  Bench bench({{Vec3(0, 0, 0), 2, 1, 2}, {Vec3(2, 0, 0), 3, 1, 2}}, {{0, 1}});
  bench.law.stiff.along = 120;
  bench.prescribe({0}, 0, Grip::mean, at_rest);
  EXPECT_NEAR(limit_of(bench).time_step * std::sqrt(120 * (1 / 2.0 + 1 / 3.0)) / 2, 1, 1e-6);
  Bench turned({{Vec3(0, 0, 0), 2, 1, 2}, {Vec3(2, 0, 0), 3, 1, 2}}, {{0, 1}});
  turned.law.stiff.along = 120;
  turned.prescribe({0}, 4, Grip::each, at_rest).body.emplace(Vec3(0, 0, 0), "");
  EXPECT_NEAR(limit_of(turned).time_step * std::sqrt(120 / 3.0) / 2, 1, 1e-6)
      << "a body that turns is held in its places";
}

TEST(StableStep, has_no_limit_without_bonds_but_that_of_collisions) {
  Bench bench({{Vec3(0, 0, 0), 2}, {Vec3(2, 0, 0), 3}});
  EXPECT_FALSE(std::isfinite(limit_of(bench).time_step));
  EXPECT_EQ(limit_of(bench).by, "no bond limits it");
  bench.law.longest = 0.25;
  EXPECT_EQ(limit_of(bench).time_step, 0.25);
  EXPECT_THAT(limit_of(bench).by, HasSubstr("'bonds', whose collisions are to be resolved"));
}

// ---- where it goes wrong

TEST(StabilityWatch, names_the_element_that_passes_by_itself_in_a_step) {
  Bench bench({{Vec3(0, 0, 0), 1}, {Vec3(50, 0, 0), 1, 0.5}});
  const Motion all = bench.motion();
  bench.moment().step = 42;
  const StabilityWatch watch(bench, all, 0.05);  // of a step of 0.1 s
  all.velocity.set(1, Vec3(0, 4.99, 0));
  EXPECT_EQ(failure_of([&] { watch.look(); }), "");
  all.velocity.set(1, Vec3(0, 5.01, 0));
  EXPECT_THAT(failure_of([&] { watch.look(); }),
              AllOf(HasSubstr("step 42: element 1 moves by 1 of its radius"), HasSubstr("2 times the largest stable")));
  all.velocity.set(1, Vec3(0, std::nan(""), 0));
  EXPECT_THAT(failure_of([&] { watch.look(); }), HasSubstr("element 1 has no finite place"));
}

TEST(StabilityWatch, names_the_bond_whose_ends_part_by_a_fifth_of_its_length) {
  Bench bench({{Vec3(0, 0, 0), 1, 10}, {Vec3(2, 0, 0), 1, 10}}, {{0, 1}});
  const Motion all = bench.motion();
  const StabilityWatch watch(bench, all, 1);
  all.velocity.set(0, Vec3(0, -1.99, 0));
  all.velocity.set(1, Vec3(0, 2, 0));
  EXPECT_EQ(failure_of([&] { watch.look(); }), "");
  all.velocity.set(0, Vec3(0, -2.01, 0));
  EXPECT_THAT(failure_of([&] { watch.look(); }),
              AllOf(HasSubstr("element 0 of a bond of 'bonds' moves by 0.2"), HasSubstr("a load is too fast")));
}

TEST(StabilityWatch, names_the_element_whose_load_is_no_number) {
  Bench bench({{Vec3(0, 0, 0), 1}, {Vec3(2, 0, 0), 1}});
  const Motion all = bench.motion();
  const StabilityWatch watch(bench, all, 0);
  EXPECT_THAT(failure_of([&] { watch.stop_at_force(); }), HasSubstr("step 0: forces are not finite"));
  all.torque.set(1, Vec3(0, std::nan(""), 0));
  EXPECT_THAT(failure_of([&] { watch.stop_at_force(); }), HasSubstr("the force on element 1 is not finite"));
}

TEST(StabilityWatch, suspects_the_step_before_it_suspects_a_law) {
  EXPECT_THAT(suspect_step(1.5, false), HasSubstr("1.5 times the largest stable one"));
  EXPECT_THAT(suspect_step(0, false), HasSubstr("no bond limits the time step"));
  EXPECT_THAT(suspect_step(0.9, false),
              AllOf(HasSubstr("the tangent that a bond law states is too small"), Not(HasSubstr("damping"))));
  EXPECT_THAT(suspect_step(0.9, true), HasSubstr("its damping takes another power"));
}

}  // namespace
}  // namespace beadwork
