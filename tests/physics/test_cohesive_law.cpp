#include "core/mechanics/cohesive.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <numbers>

#include "core/mechanics/cohesive_stiffness.hpp"
#include "core/mechanics/dual.hpp"
#include "core/mechanics/verlet.hpp"
#include "tests/support/mechanics.hpp"

namespace beadwork {
namespace {

using namespace test;
using std::numbers::pi;

using Both = IndependentModes<CohesiveModes::both>;
using Shear = IndependentModes<CohesiveModes::shear>;

// strength 6 Pa, K = 60 Pa/m, G = 3 J/m^2
const Softening<Real> law{60, 0.1, 1};
const Softening<Real> slide{40, 0.15, 0.8};
const Both both{law, slide};
const Shear shear{law, slide};
const CohesiveRest<Real> rest{2, 0.5};

/// Work done by opening to `to` in small steps from `from`, and the history that is left.
Real work_of_opening(Real from, Real to, Real& history, int steps = 20000) {
  Real work = 0, before = traction(law, from, history);
  for (int i = 1; i <= steps; ++i) {
    const Real u = from + (to - from) * i / steps;
    history = std::max(history, u);
    const Real now = traction(law, u, history);
    work += 0.5 * (before + now) * (to - from) / steps;
    before = now;
  }
  return work;
}

// ------------------------------------------------------------------------------------------------ the scalar
// law

TEST(cohesion, is_elastic_then_softens_to_zero_at_the_final_opening) {
  EXPECT_EQ(traction(law, 0.05, 0.), 3);
  EXPECT_EQ(traction(law, 0.1, 0.), 6);  // the strength
  EXPECT_NEAR(traction(law, 0.55, 0.), 3, 1e-14);
  EXPECT_EQ(traction(law, 1., 0.), 0);
  EXPECT_EQ(traction(law, 5., 0.), 0);
}

TEST(cohesion, encloses_the_fracture_energy) {
  Real history = 0;
  EXPECT_NEAR(work_of_opening(0, 1, history), 0.5 * 6 * 1, 1e-8);  // Eq (5): G = F_c u_p / (2 S)
  EXPECT_NEAR(fracture_energy(law), 3, 1e-15);
  EXPECT_EQ(dissipated_per_area(law, 1.), fracture_energy(law));
  EXPECT_EQ(dissipated_per_area(law, 7.), fracture_energy(law));
}

TEST(cohesion, a_cycle_of_opening_and_closing_dissipates_exactly_what_the_law_says) {
  Real history = 0, work = 0;
  for (const Real peak : {0.08, 0.3, 0.3, 0.6, 0.95}) {
    work += work_of_opening(0, peak, history);
    work += work_of_opening(peak, 0, history);
    EXPECT_NEAR(work, dissipated_per_area(law, history), 1e-7) << peak;
  }
  work += work_of_opening(0, 1.2, history);
  EXPECT_NEAR(work, fracture_energy(law), 1e-7);
}

TEST(cohesion, work_is_at_all_times_what_is_stored_and_what_is_gone) {
  Real history = 0, work = 0, u = 0;
  for (const Real to : {0.05, 0.4, 0.1, 0.7, 0.5, 0.9}) {
    work += work_of_opening(u, to, history);
    u = to;
    EXPECT_NEAR(work, stored_per_area(law, u, history) + dissipated_per_area(law, history), 1e-7) << to;
  }
}

TEST(cohesion, unloads_to_the_origin_and_reloads_on_the_same_line) {
  EXPECT_EQ(traction(law, 0., 0.5), 0);
  const Real full = traction(law, 0.5, 0.5);
  EXPECT_NEAR(traction(law, 0.25, 0.5), full / 2, 1e-15);
  EXPECT_LT(traction(law, 0.05, 0.5), traction(law, 0.05, 0.));
  EXPECT_NEAR(damage(law, 0.5), (1 - 0.1 / 0.5) / (1 - 0.1), 1e-15);  // d = u_p (k - u_e) / (k (u_p - u_e))
}

TEST(cohesion, compression_is_elastic_and_never_damages) {
  for (const Real history : {0., 0.5, 2.}) EXPECT_EQ(traction(law, -0.2, history), -12) << history;
  const auto pressed = cohesive_pull<Real>(law, rest, Vec3(1.5, 0, 0), 0);
  EXPECT_EQ(pressed.history, 0);
  EXPECT_NEAR(pressed.force[0], 0.5 * 60 * 0.5, 1e-14);  // pushes end 2 away
}

TEST(cohesion, a_million_cycles_below_the_greatest_opening_so_far_change_nothing) {
  for (const Real start : {0.05, 0.6}) {  // still sound; softened
    Real history = start;
    const Real before = traction(law, 0.04, history);
    for (int cycle = 0; cycle < 1000000; ++cycle) {
      const Real u = start * (cycle % 2 == 0 ? 1. : -0.3);
      history = cohesive_pull<Real>(law, rest, Vec3(0, 0, rest.length + u), history).history;
    }
    EXPECT_NEAR(traction(law, 0.04, history), before, 1e-14);
    EXPECT_NEAR(history, start, 1e-15);
  }
}

TEST(cohesion, a_jump_past_the_final_opening_in_one_step_breaks_and_dissipates_all) {
  const auto torn = cohesive_pull<Real>(law, rest, Vec3(50, 0, 0), 0);
  EXPECT_EQ(torn.force.norm(), 0);
  EXPECT_EQ(dissipated_per_area(law, torn.history), fracture_energy(law));
  EXPECT_EQ(traction(law, 0.01, torn.history), 0);
}

TEST(cohesion, a_brittle_law_still_dissipates_exactly_its_energy) {
  const Softening<Real> brittle{1e9, 1e-8, 1};
  EXPECT_EQ(integrity(brittle, 1e-8), 1);
  EXPECT_NEAR(dissipated_per_area(brittle, 0.5), 0.5 * fracture_energy(brittle), 1e-7);
  EXPECT_EQ(dissipated_per_area(brittle, 1.), fracture_energy(brittle));
}

TEST(cohesion, the_force_is_a_function_of_the_state_and_the_accepted_history) {
  const Vec3 d(2.4, 0.1, 0);
  const auto first = cohesive_pull<Real>(law, rest, d, 0.2);
  cohesive_pull<Real>(law, rest, Vec3(2.9, 0, 0), 0.2);  // a trial that is not accepted
  const auto again = cohesive_pull<Real>(law, rest, d, 0.2);
  EXPECT_EQ(first.force, again.force);
  EXPECT_EQ(first.history, again.history);
}

TEST(cohesion, areas_are_those_of_the_paper) {
  EXPECT_NEAR(contact_area(0.1, 0.2), pi * 0.15 * 0.15, 1e-16);
  EXPECT_NEAR(contact_area_on_large(0.4), pi * 0.16, 1e-16);
}

// ------------------------------------------------------------------------------------------------- in space

template <class Modes>
struct Acted {
  Wrench<Real> wrench;
  Openings<Real> history;
};

/// A pair's contact, as the loop over bonds runs it.
template <class Modes>
Acted<Modes> act(const Modes& modes, const ContactArms<Real>& arms, const Vec3& d, const Quat& q1, const Quat& q2,
                 const Openings<Real>& history) {
  const auto at = pair_faces<Real>(rest.length, arms, d, q1, q2);
  const auto now = cohesive_state(modes, at, rest.area, CohesiveHistory<Modes, Real>{history, 0.});
  return {cohesive_wrench(modes, at, rest.area, now.share), now.after.modes};
}

template <class Modes>
Real stored(const Modes& modes, const PairFaces<Real>& at, const Openings<Real>& history) {
  return held_energy(modes, rest.area, at.opening,
                     cohesive_state(modes, at, rest.area, CohesiveHistory<Modes, Real>{history, 0.}).share);
}

/// Two elements in contact, then moved apart and turned by `size`.
struct Contact {
  Pair p;
  ContactArms<Real> arms;
};

Contact moved_contact(Random& random, Real size) {
  const Vec3 x1 = random_vector(random, 1);
  const Pair bonded{x1, x1 + random_vector(random, 1).normalized() * rest.length, random_rotation(random),
                    random_rotation(random)};
  const auto arms = contact_arms(bonded.d(), 0.8, 1.2, bonded.q1, bonded.q2);
  return {moved(bonded, Vector12::NullaryExpr([&](Eigen::Index) { return size * random.normal(); })), arms};
}

PairFaces<Real> state(const Contact& c, const Pair& p) {
  return pair_faces<Real>(rest.length, c.arms, p.d(), p.q1, p.q2);
}

TEST(cohesion, a_new_contact_is_closed_whatever_the_orientations) {
  Random random(1);
  const Contact c = moved_contact(random, 0);
  EXPECT_LT(std::abs(state(c, c.p).opening.normal), 1e-15);
  EXPECT_LT(state(c, c.p).opening.shear, 1e-15);
}

template <class Modes>
void force_is_the_gradient(const Modes& modes, const Openings<Real>& history) {
  Random random(2);
  int counted = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Contact c = moved_contact(random, 0.15);
    const auto now = state(c, c.p).opening;
    // with the damage held: unloading, or below the onset; away from the kink at u_n = 0
    if (now.normal > history.normal - 0.02 || now.shear > history.shear - 0.02 || std::abs(now.normal) < 0.02) continue;
    ++counted;
    const auto energy = [&](const Pair& p) { return stored(modes, state(c, p), history); };
    const Vector12 expected = -gradient(energy, c.p);
    const auto found = act(modes, c.arms, c.p.d(), c.p.q1, c.p.q2, history);
    EXPECT_LT((generalised(found.wrench) - expected).norm(), 1e-8 * expected.norm()) << trial;
  }
  EXPECT_GT(counted, 30);
}

TEST(cohesion, force_and_torques_are_minus_the_gradient_while_the_damage_stands) {
  force_is_the_gradient(both, {0.7, 0.6});
  force_is_the_gradient(shear, {100, 0.6});
}

TEST(cohesion, gives_no_net_torque_at_any_opening) {
  Random random(3);
  for (int trial = 0; trial < 200; ++trial) {
    const Contact c = moved_contact(random, 0.2);
    const auto w = act(both, c.arms, c.p.d(), c.p.q1, c.p.q2, {0, 0}).wrench;
    const Real scale = w.torque1.norm() + w.torque2.norm() + w.force.norm() * c.p.d().norm();
    EXPECT_LE((w.torque1 + w.torque2 + c.p.d().cross(w.force)).norm(), 1e-15 * scale + 1e-300);
  }
}

TEST(cohesion, does_not_see_a_rigid_motion_and_does_not_drift) {
  Random random(4);
  const Contact c = moved_contact(random, 0.1);
  const auto start = act(both, c.arms, c.p.d(), c.p.q1, c.p.q2, {0, 0});
  Pair p = c.p;
  Openings<Real> history = start.history;
  for (int turn = 0; turn < 1000; ++turn) {
    p = moved_rigidly(p, random_rotation(random), random_vector(random, 0.01));
    history = act(both, c.arms, p.d(), p.q1, p.q2, history).history;
  }
  EXPECT_NEAR(state(c, p).opening.shear, state(c, c.p).opening.shear, 1e-12);
  EXPECT_NEAR(history.shear, start.history.shear, 1e-12);
  EXPECT_NEAR(history.normal, start.history.normal, 1e-12);
}

TEST(cohesion, rolling_without_sliding_is_no_slip_and_spinning_in_place_is) {
  const Vec3 d(2, 0, 0);
  const auto arms = contact_arms(d, 1, 1, identity(), identity());
  const Real angle = 1e-3;
  const Quat up = exp_map(Vec3(0, 0, angle)), down = exp_map(Vec3(0, 0, -angle));
  EXPECT_LT(pair_faces<Real>(rest.length, arms, d, up, down).opening.shear, 1e-8);  // opposite spins: cog wheels
  EXPECT_NEAR(pair_faces<Real>(rest.length, arms, d, up, up).opening.shear, 2 * angle,
              1e-8);  // alike: both surfaces slide
}

TEST(cohesion, does_not_care_which_end_is_called_first) {
  Random random(5);
  const Contact c = moved_contact(random, 0.1);
  const auto one = act(both, c.arms, c.p.d(), c.p.q1, c.p.q2, {0, 0});
  const auto other = act(both, {c.arms.arm2, c.arms.arm1}, -c.p.d(), c.p.q2, c.p.q1, {0, 0});
  EXPECT_LT((one.wrench.force + other.wrench.force).norm(), 1e-14);
  EXPECT_LT((one.wrench.torque1 - other.wrench.torque2).norm(), 1e-14);
  EXPECT_EQ(one.history.normal, other.history.normal);
  EXPECT_NEAR(one.history.shear, other.history.shear, 1e-15);
}

TEST(cohesion, failure_in_either_mode_takes_both_and_leaves_only_contact) {
  const auto arms = contact_arms(Vec3(2, 0, 0), 1, 1, identity(), identity());
  const auto at = [&](const Vec3& d, Openings<Real> history) {
    return act(both, arms, d, identity(), identity(), history);
  };
  EXPECT_GT(at(Vec3(2.05, 0.1, 0), {0, 0}).wrench.force.norm(), 0.5);
  EXPECT_EQ(at(Vec3(2.05, 0.1, 0), {0, 0.8}).wrench.force.norm(), 0);  // slid off before
  EXPECT_EQ(at(Vec3(2.05, 0.1, 0), {1, 0}).wrench.force.norm(), 0);    // opened before
  EXPECT_TRUE(both.failed(at(Vec3(2.01, 0.9, 0), {0, 0}).history));
  const auto pressed = at(Vec3(1.9, 0, 0), {1, 0}).wrench;
  EXPECT_NEAR(pressed.force[0], 0.5 * 60 * 0.1, 1e-13);
  EXPECT_EQ(at(Vec3(1.9, 0.05, 0), {1, 0}).wrench.torque1.norm(), 0);  // no friction
}

TEST(cohesion, a_failed_contact_dissipates_no_more) {
  const auto arms = contact_arms(Vec3(2, 0, 0), 1, 1, identity(), identity());
  for (const Openings<Real> failed : {Openings<Real>{0, 0.9}, Openings<Real>{1.1, 0}}) {  // slid off; opened
    const auto moved = act(both, arms, Vec3(2.7, 0.3, 0), identity(), identity(), failed);
    EXPECT_EQ(rest.area * both.dissipated(moved.history), rest.area * both.dissipated(failed));
  }
}

TEST(cohesion, the_energy_balance_closes_when_one_mode_takes_the_other_along) {
  // opened a little, then slid off: work = D_n + D_s + what the normal mode still held
  const auto arms = contact_arms(Vec3(2, 0, 0), 1, 1, identity(), identity());
  Openings<Real> history{0, 0};
  Real work = 0, released = 0;
  Vec3 d(2, 0, 0), before = zero<Vec3>();
  const int steps = 40000;
  for (int i = 1; i <= steps; ++i) {
    const Real x = 2. * i / steps;
    const Vec3 next = x < 1 ? Vec3(2 + 0.3 * x, 0, 0) : Vec3(2.3, (x - 1) * 1.5, 0);
    const auto now = act(both, arms, next, identity(), identity(), history);
    released += cohesive_lost(both, pair_faces<Real>(rest.length, arms, next, identity(), identity()), rest.area,
                              CohesiveHistory<Both, Real>{history, 0.}, CohesiveHistory<Both, Real>{now.history, 0.});
    work -= 0.5 * (before + now.wrench.force).dot(next - d);
    history = now.history;
    before = act(both, arms, next, identity(), identity(), history)
                 .wrench.force;  // what the other mode held goes at the end of the step
    d = next;
  }
  ASSERT_TRUE(both.failed(history));
  EXPECT_GT(released, 0.01 * work);
  EXPECT_NEAR(work, rest.area * both.dissipated(history) + released, 1e-7 * work);
}

TEST(cohesion, shear_alone_dissipates_its_own_fracture_energy) {
  const auto arms = contact_arms(Vec3(2, 0, 0), 1, 1, identity(), identity());
  Openings<Real> history{0, 0};
  Real work = 0, angle = 0;
  Vec3 before = zero<Vec3>();
  for (int i = 1; i <= 20000; ++i) {  // end 2 spins in place: pure sliding, the torque does the work
    const Real to = 1.2 * i / 20000;
    const auto now = act(shear, arms, Vec3(2, 0, 0), identity(), exp_map(Vec3(0, 0, to)), history);
    work -= 0.5 * (before + now.wrench.torque2)[2] * (to - angle);
    history = now.history;
    before = now.wrench.torque2;
    angle = to;
  }
  EXPECT_TRUE(shear.failed(history));
  EXPECT_NEAR(work, rest.area * fracture_energy(slide), 1e-6);
}

// ------------------------------------------------------------------------------------------------- stiffness

// The derivative of every law that ships is compared with differences in tests/unit/test_bond_laws.cpp.

TEST(cohesion, a_closed_contact_has_the_stiffness_of_both_modes) {
  Random random(7);
  const Contact c = moved_contact(random, 0);
  const auto forces = [&](const Pair& at) {
    return generalised(act(both, c.arms, at.d(), at.q1, at.q2, {0, 0}).wrench);
  };
  const Matrix12 expected = -jacobian(forces, c.p);
  const Matrix12 found = shared_stiffness(both, state(c, c.p), rest.area, Openings<Real>{1, 1});
  EXPECT_LT((found - expected).norm(), 1e-8 * expected.norm());
}

TEST(cohesion, a_softening_contact_has_a_negative_slope_and_a_positive_secant) {
  const auto slope = [&](Real opening, Real history) {
    using Number = Dual<1>;
    return traction<Number>(as<Number>(law), Number::coordinate(opening, 0), history).slope[0];
  };
  EXPECT_NEAR(slope(0.5, 0.3), -6 / 0.9, 1e-13);
  EXPECT_NEAR(slope(0.5, 0.5 + 1e-9), traction(law, 0.5, 0.5) / 0.5, 1e-6);
  EXPECT_EQ(slope(2, 0), 0);
  EXPECT_EQ(slope(-1, 2), 60);
  const auto along = [&](Real opening, Real history, Slope which) {
    return opening_stiffness(law, rest, Vec3(rest.length + opening, 0, 0), history, which)(0, 0) / rest.area;
  };
  EXPECT_NEAR(along(0.5, 0.3, Slope::secant), traction(law, 0.5, 0.3) / 0.5, 1e-13);
  EXPECT_NEAR(along(0.5, 0.3, Slope::stiffest), 60, 1e-12);
  EXPECT_EQ(along(2, 0, Slope::secant), 0);
}

TEST(cohesion, a_secant_is_never_negative) {
  Random random(9);
  for (int trial = 0; trial < 50; ++trial) {
    const Real opening = random.uniform(-0.5, 1.5), history = random.uniform(0, 1.2);
    const Vec3 d = rotate(random_rotation(random), Vec3(rest.length + opening, 0, 0));
    const Eigen::SelfAdjointEigenSolver<Matrix12> modes(opening_stiffness(law, rest, d, history, Slope::secant));
    EXPECT_GT(modes.eigenvalues().minCoeff(), -1e-12) << opening << ' ' << history;
  }
}

// --------------------------------------------------------------------------------- what the deck may give

TEST(cohesion, the_onset_follows_from_exactly_one_of_stiffness_onset_and_ratio) {
  const Real strength = 5.7e6, energy = 560;  // the double cantilever beam
  const Real open = 2 * energy / strength;
  EXPECT_NEAR(final_opening(strength, energy), 0.1964912e-3, 1e-10);
  for (const auto& by :
       {softening_by_stiffness(strength, energy, strength / (0.05 * open)),
        softening_by_onset(strength, energy, 0.05 * open), softening_by_ratio(strength, energy, 0.05)}) {
    EXPECT_NEAR(by.open, open, 1e-18);
    EXPECT_NEAR(by.onset, 0.05 * open, 1e-18);
    EXPECT_NEAR(by.stiffness * by.onset, strength, 1e-8);
    EXPECT_NEAR(fracture_energy(by), energy, 1e-9);
    EXPECT_TRUE(is_softening(by));
  }
}

TEST(cohesion, a_law_that_does_not_soften_is_recognised) {
  EXPECT_FALSE(is_softening(softening_by_ratio(5., 1., 1.)));   // u_e = u_p
  EXPECT_FALSE(is_softening(softening_by_onset(5., 1., 0.5)));  // u_e > u_p
  EXPECT_FALSE(is_softening(softening_by_onset(5., 0., 0.1)));  // no energy
  EXPECT_FALSE(is_softening(softening_by_ratio(0., 1., 0.1)));  // no strength
  EXPECT_FALSE(is_softening(softening_by_stiffness(5., 1., 0.)));
  EXPECT_TRUE(is_softening(softening_by_ratio(5., 1., 1e-8)));  // brittle, but a law
}

// --------------------------------------------------------------------------------- in time

TEST(cohesion, an_oscillating_contact_keeps_energy_and_both_momenta_while_it_is_sound) {
  const auto arms = contact_arms(Vec3(2, 0, 0), 1, 1, identity(), identity());
  Vec3 x1(0, 0, 0), x2(2, 0, 0), v1(0, -0.02, 0), v2(0.05, 0.02, 0.01), w1(0, 0.02, 0.03), w2(0, 0, 0.03);
  Quat q1 = identity(), q2 = identity();
  const Real dt = 1e-3, inertia = 0.4;
  const auto acting = [&] { return act(both, arms, x2 - x1, q1, q2, {0, 0}).wrench; };
  const auto energy = [&] {
    const auto at = pair_faces<Real>(rest.length, arms, x2 - x1, q1, q2);
    return 0.5 * (v1.squaredNorm() + v2.squaredNorm() + inertia * (w1.squaredNorm() + w2.squaredNorm())) +
           stored(both, at, {0, 0});
  };
  const auto spin = [&]() -> Vec3 { return cross(x1, v1) + cross(x2, v2) + inertia * (w1 + w2); };
  const Real start = energy();
  const Vec3 spin_start = spin(), momentum_start = v1 + v2;
  Real worst = 0;
  auto on = acting();
  for (int step = 0; step < 10000; ++step) {
    const auto old = on;
    x1 = advance<Real>(x1, v1, -old.force, dt);
    x2 = advance<Real>(x2, v2, old.force, dt);
    q1 = turn<Real>(q1, w1, old.torque1 / inertia, dt);
    q2 = turn<Real>(q2, w2, old.torque2 / inertia, dt);
    on = acting();
    v1 = correct<Real>(v1, -old.force, -on.force, 1, dt);
    v2 = correct<Real>(v2, old.force, on.force, 1, dt);
    w1 = correct<Real>(w1, old.torque1 / inertia, on.torque1 / inertia, 1, dt);
    w2 = correct<Real>(w2, old.torque2 / inertia, on.torque2 / inertia, 1, dt);
    worst = std::max(worst, std::abs(energy() / start - 1));
  }
  EXPECT_LT(worst, 2e-4);
  EXPECT_LT((spin() - spin_start).norm(), 1e-13);
  EXPECT_LT((v1 + v2 - momentum_start).norm(), 1e-14);
}

}  // namespace
}  // namespace beadwork
