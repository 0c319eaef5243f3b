#include "core/mechanics/beam.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/mechanics/beam_stiffness.hpp"
#include "core/mechanics/verlet.hpp"
#include "tests/support/mechanics.hpp"

namespace beadwork {
namespace {

using namespace test;
using std::numbers::pi;

/// A beam of order one in all its stiffnesses, so that no term hides behind another.
BeamRest<Real> stout_beam(const Vec3& d) { return round_beam(d, 2.5, 0.3, 0.6 * d.norm()); }

/// Two elements as bonded, then strained and turned by `size`.
Pair strained(Random& random, const BeamRest<Real>& rest, Real size) {
  const Vec3 x1 = random_vector(random, 1);
  return {x1, x1 + rest.axis * rest.length + random_vector(random, 0.5 * size * rest.length),
          exp_map(random_vector(random, size)), exp_map(random_vector(random, size))};
}

Wrench<Real> wrench(const BeamRest<Real>& rest, const Pair& p) { return beam_wrench(rest, p.d(), p.q1, p.q2); }
Real energy(const BeamRest<Real>& rest, const Pair& p) { return beam_energy(rest, p.d(), p.q1, p.q2).total(); }

/// The 12 x 12 Euler-Bernoulli beam along x as textbooks print it, from E, G, L and the section alone.
Matrix12 textbook_beam(Real E, Real nu, Real r, Real L) {
  const Real A = pi * r * r, I = pi * r * r * r * r / 4, J = 2 * I, G = E / (2 * (1 + nu));
  const Real a = E * A / L, t = G * J / L, b12 = 12 * E * I / (L * L * L), b6 = 6 * E * I / (L * L), b4 = 4 * E * I / L,
             b2 = 2 * E * I / L;
  Matrix12 k;
  //    u1   v1    w1    X1  Y1   Z1   u2   v2    w2   X2  Y2   Z2
  k << a, 0, 0, 0, 0, 0, -a, 0, 0, 0, 0, 0,         //
      0, b12, 0, 0, 0, b6, 0, -b12, 0, 0, 0, b6,    //
      0, 0, b12, 0, -b6, 0, 0, 0, -b12, 0, -b6, 0,  //
      0, 0, 0, t, 0, 0, 0, 0, 0, -t, 0, 0,          //
      0, 0, -b6, 0, b4, 0, 0, 0, b6, 0, b2, 0,      //
      0, b6, 0, 0, 0, b4, 0, -b6, 0, 0, 0, b2,      //
      -a, 0, 0, 0, 0, 0, a, 0, 0, 0, 0, 0,          //
      0, -b12, 0, 0, 0, -b6, 0, b12, 0, 0, 0, -b6,  //
      0, 0, -b12, 0, b6, 0, 0, 0, b12, 0, b6, 0,    //
      0, 0, 0, -t, 0, 0, 0, 0, 0, t, 0, 0,          //
      0, 0, -b6, 0, b2, 0, 0, 0, b6, 0, b4, 0,      //
      0, b6, 0, 0, 0, b2, 0, -b6, 0, 0, 0, b4;
  return k;
}

/// The linear law of Andre et al. (2012), with rotation vectors theta_i relative to the chord. `lever` is the
/// length in 3B/lever: the paper writes L, the conservation of angular momentum wants l.
Wrench<Real> andre_wrench(const BeamRest<Real>& rest, const Vec3& d, const Quat& q1, const Quat& q2, Real lever) {
  const Real l = d.norm();
  const Vec3 e = d / l;
  const Vec3 axis = rest.axis.cross(e);
  const Quat chord =
      exp_map(axis.norm() > 0 ? Vec3(axis * (std::atan2(axis.norm(), rest.axis.dot(e)) / axis.norm())) : axis);
  const Vec3 theta1 = log_map(relative(chord, q1)), theta2 = log_map(relative(chord, q2));
  const Vec3 t1 = theta1 - e * e.dot(theta1), t2 = theta2 - e * e.dot(theta2);
  const Real tau = e.dot(theta2 - theta1), B = rest.bending;
  const Vec3 force = -rest.axial * (l - rest.length) * e + (3 * B / lever) * Vec3((t1 + t2).cross(e));
  return {force, -B * (2 * t1 + t2) + rest.torsion * tau * e, -B * (2 * t2 + t1) - rest.torsion * tau * e};
}

TEST(beam, force_and_torques_are_minus_the_gradient_of_its_energy_at_finite_rotations) {
  Random random(11);
  for (int trial = 0; trial < 200; ++trial) {
    const auto rest = stout_beam(random_vector(random, 1).normalized() * random.uniform(0.5, 2));
    const Pair p = strained(random, rest, 0.3);
    const Vector12 expected = -gradient([&](const Pair& at) { return energy(rest, at); }, p);
    const Vector12 found = generalised(wrench(rest, p));
    EXPECT_LT((found - expected).norm(), 1e-8 * found.norm()) << trial;
  }
}

TEST(beam, gives_no_net_force_and_no_net_torque) {
  Random random(12);
  for (int trial = 0; trial < 200; ++trial) {
    const auto rest = stout_beam(random_vector(random, 1));
    const Pair p = strained(random, rest, 0.5);
    const auto w = wrench(rest, p);
    const Real scale = w.torque1.norm() + w.torque2.norm() + p.d().norm() * w.force.norm();
    EXPECT_LT((w.torque1 + w.torque2 + p.d().cross(w.force)).norm(), 1e-15 * scale);
  }
}

TEST(beam, does_not_see_a_rigid_motion_of_the_whole) {
  Random random(13);
  for (int trial = 0; trial < 100; ++trial) {
    const auto rest = stout_beam(random_vector(random, 1));
    const Pair p = strained(random, rest, 0.4);
    const Quat turn = random_rotation(random);
    const Pair other = moved_rigidly(p, turn, random_vector(random, 3));
    EXPECT_NEAR(energy(rest, other), energy(rest, p), 1e-13 * energy(rest, p));
    const Vector12 expected = in_blocks(turn) * generalised(wrench(rest, p));
    EXPECT_LT((generalised(wrench(rest, other)) - expected).norm(), 1e-13 * expected.norm());
  }
}

/// The beam by how its end 2 lies against its end 1, which is found in double; forces in numbers of type T.
template <class T>
Vector12 by_shift(const BeamRest<Real>& rest, const Pair& p) {
  const auto number = [](Real x) { return static_cast<T>(x); };
  const auto vector = [](const Vec3& v) { return Vec<T>(v.cast<T>()); };
  const BeamRest<T> same{vector(rest.axis), number(rest.length), number(rest.axial), number(rest.bending),
                         number(rest.torsion)};
  const BeamShift<Real> shift = beam_shift(rest, p.d(), p.q1, p.q2);
  const Wrench<T> w = beam_wrench<T>(same, BeamShift<T>{vector(shift.moved),
                                                        number(shift.grown),
                                                        vector(shift.normal),
                                                        {number(shift.turn.w), vector(shift.turn.v)}});
  return generalised(
      Wrench<Real>{w.force.template cast<Real>(), w.torque1.template cast<Real>(), w.torque2.template cast<Real>()});
}

TEST(beam, is_the_same_law_by_how_one_end_lies_against_the_other) {
  Random random(31);
  for (const Real size : {1e-9, 1e-3, 0.4})
    for (int trial = 0; trial < 100; ++trial) {
      const auto rest = stout_beam(random_vector(random, 1));
      const Pair p = moved_rigidly(strained(random, rest, size), random_rotation(random), random_vector(random, 3));
      const Vector12 expected = generalised(wrench(rest, p));
      EXPECT_LT((by_shift<Real>(rest, p) - expected).norm(), 1e-13 + 1e-13 * expected.norm()) << size;
    }
}

/// How far single precision is off, over what it finds.
Real lost_digits(const BeamRest<Real>& rest, const Pair& p) {
  const Vector12 expected = by_shift<Real>(rest, p);
  return (by_shift<float>(rest, p) - expected).norm() / expected.norm();
}

// The difference of two unit vectors, in single precision, would keep no digit of a millionth.
TEST(beam, keeps_its_digits_in_single_precision_however_small_the_strain_and_large_the_turn_of_the_whole) {
  Random random(32);
  for (const Real size : {1e-6, 1e-3, 0.4})
    for (int trial = 0; trial < 100; ++trial) {
      const auto rest = stout_beam(random_vector(random, 1));
      EXPECT_LT(lost_digits(rest, moved_rigidly(strained(random, rest, size), random_rotation(random),
                                                random_vector(random, 3))),
                1e-6)
          << size;
    }
}

// A slender beam is far stiffer along than across: what is along must not be found from what is across.
TEST(beam, keeps_its_digits_in_single_precision_where_it_is_slender_and_swings) {
  Random random(33);
  for (const Real size : {1e-6, 1e-3, 0.1})
    for (int trial = 0; trial < 100; ++trial) {
      const Vec3 d = random_vector(random, 1);
      const auto rest = round_beam(d, 2.5, 0.3, 0.02 * d.norm());
      Pair p = strained(random, rest, size);
      p.x2 = p.x1 + rotate(exp_map(random_vector(random, size)), d);  // as long as it was
      EXPECT_LT(lost_digits(rest, moved_rigidly(p, random_rotation(random), Vec3(0, 0, 0))), 3e-6) << size;
    }
}

TEST(beam, does_not_care_which_end_is_called_first) {
  Random random(14);
  for (int trial = 0; trial < 100; ++trial) {
    const auto rest = stout_beam(random_vector(random, 1));
    const auto turned = round_beam(-rest.axis * rest.length, 2.5, 0.3, 0.6 * rest.length);
    const Pair p = strained(random, rest, 0.4);
    const auto w = wrench(rest, p);
    const auto other = wrench(turned, {p.x2, p.x1, p.q2, p.q1});
    const Real scale = generalised(w).norm();
    EXPECT_LT((other.force + w.force).norm(), 1e-14 * scale);
    EXPECT_LT((other.torque1 - w.torque2).norm(), 1e-14 * scale);
    EXPECT_LT((other.torque2 - w.torque1).norm(), 1e-14 * scale);
  }
}

TEST(beam, does_not_care_which_of_the_two_quaternions_stands_for_an_orientation) {
  Random random(15);
  const auto rest = stout_beam(Vec3(0.3, -1, 0.4));
  const Pair p = strained(random, rest, 0.4);
  Pair other = p;
  other.q2 = {-p.q2.w, -p.q2.v};
  EXPECT_EQ(energy(rest, other), energy(rest, p));
  EXPECT_EQ(generalised(wrench(rest, other)), generalised(wrench(rest, p)));
}

// A half-stiff bending (3EI/L^2 where 6EI/L^2 belongs) circulates in print; this is the test that it fails.
TEST(beam, its_linearisation_is_the_euler_bernoulli_matrix) {
  const Real E = 2.5, nu = 0.3, L = 1.3, r = 0.7;
  const auto rest = round_beam(Vec3(L, 0, 0), E, nu, r);
  const Pair straight{Vec3(0, 0, 0), Vec3(L, 0, 0), identity(), identity()};
  const Matrix12 expected = textbook_beam(E, nu, r, L);
  const Matrix12 found = -jacobian([&](const Pair& p) { return generalised(wrench(rest, p)); }, straight);
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-9 * expected.maxCoeff());
  EXPECT_LT((beam_stiffness(rest, straight.d(), Slope::stiffest) - expected).cwiseAbs().maxCoeff(),
            1e-14 * expected.maxCoeff());
}

TEST(beam, its_stiffness_turns_with_it) {
  Random random(16);
  const Real E = 2.5, nu = 0.2, L = 0.8, r = 0.5;
  const Quat turn = random_rotation(random);
  const Vec3 d = rotate(turn, Vec3(L, 0, 0));
  const Matrix12 expected = in_blocks(turn) * textbook_beam(E, nu, r, L) * in_blocks(turn).transpose();
  EXPECT_LT((beam_stiffness(round_beam(d, E, nu, r), d, Slope::stiffest) - expected).norm(), 1e-14 * expected.norm());
}

TEST(beam, a_tension_stiffens_it_across_and_the_time_step_minds_it_from_a_hundredth_on) {
  const auto rest = stout_beam(Vec3(1, 0, 0));
  const auto off = [&](Real length, Slope slope) {
    const Pair pulled{Vec3(0, 0, 0), Vec3(length, 0, 0), identity(), identity()};
    const Matrix12 expected = -jacobian([&](const Pair& p) { return generalised(wrench(rest, p)); }, pulled);
    return (beam_stiffness(rest, pulled.d(), slope) - expected).norm() / expected.norm();
  };
  EXPECT_LT(off(1.2, Slope::secant), 1e-9);
  EXPECT_LT(off(1.2, Slope::stiffest), 1e-9);
  EXPECT_LT(off(1.005, Slope::secant), 1e-9);
  EXPECT_GT(off(1.005, Slope::stiffest), 1e-3);
  EXPECT_GT(off(0.8, Slope::secant), 0.05) << "pushed, it would be less than nothing across";
}

TEST(beam, agrees_with_the_linear_law_of_andre_to_first_order) {
  Random random(17);
  const auto rest = stout_beam(Vec3(0.7, 0.2, -0.5));
  const Vec3 stretch = random_vector(random, 1), turn1 = random_vector(random, 1), turn2 = random_vector(random, 1);
  Real previous = 0;
  for (const Real size : {4e-4, 2e-4, 1e-4}) {
    const Pair p{Vec3(0, 0, 0), rest.axis * rest.length + stretch * size, exp_map(turn1 * size), exp_map(turn2 * size)};
    const Vector12 expected = generalised(andre_wrench(rest, p.d(), p.q1, p.q2, p.d().norm()));
    const Real off = (generalised(wrench(rest, p)) - expected).norm() / expected.norm();
    EXPECT_LT(off, size);
    if (previous > 0) {
      EXPECT_NEAR(previous / off, 2, 0.1);
    }
    previous = off;
  }
}

TEST(beam, the_rest_length_as_lever_would_lose_angular_momentum) {
  Random random(18);
  const auto rest = stout_beam(Vec3(1, 0, 0));
  const Pair p = strained(random, rest, 1e-2);
  const auto imbalance = [&](Real lever) {
    const auto w = andre_wrench(rest, p.d(), p.q1, p.q2, lever);
    return (w.torque1 + w.torque2 + p.d().cross(w.force)).norm() / w.torque1.norm();
  };
  EXPECT_LT(imbalance(p.d().norm()), 1e-14);
  EXPECT_GT(imbalance(rest.length), 1e-4);
}

TEST(beam, twisting_stores_energy_up_to_half_a_turn) {
  const auto rest = stout_beam(Vec3(1, 0, 0));
  Real previous = 0;
  for (int degree = 1; degree <= 180; ++degree) {
    const Real twist = degree * pi / 180;
    const Quat q2 = exp_map(Vec3(twist, 0, 0));
    const auto w = beam_wrench(rest, rest.axis, identity(), q2);
    EXPECT_NEAR(w.torque1[0], rest.torsion * std::sin(twist), 1e-14);
    EXPECT_NEAR(w.torque2[0], -rest.torsion * std::sin(twist), 1e-14);
    EXPECT_LT(w.force.norm(), 1e-15);
    const auto stored = beam_energy(rest, rest.axis, identity(), q2);
    EXPECT_GT(stored.torsion, previous);
    EXPECT_LT(stored.bending + stored.axial, 1e-30);
    previous = stored.torsion;
  }
}

TEST(beam, pure_bending_gives_the_moment_of_the_section) {
  const Real r = 0.2, E = 3;
  const auto rest = round_beam(Vec3(1, 0, 0), E, 0.3, r);
  const Real angle = 9 * pi / 180;
  const auto w = beam_wrench(rest, rest.axis, exp_map(Vec3(0, 0, -angle / 2)), exp_map(Vec3(0, 0, angle / 2)));
  const Real EI = E * pi * std::pow(r, 4) / 4;
  EXPECT_NEAR(w.torque1[2], EI * std::sin(angle), 1e-15);  // -0.4 % against EI angle / L
  EXPECT_NEAR(w.torque2[2], -EI * std::sin(angle), 1e-15);
  EXPECT_LT(w.force.norm(), 1e-15);
}

TEST(beam, its_energy_has_three_parts) {
  const auto rest = stout_beam(Vec3(1, 0, 0));
  const auto pulled = beam_energy(rest, Vec3(1.1, 0, 0), identity(), identity());
  EXPECT_NEAR(pulled.axial, 0.5 * rest.axial * 0.01, 1e-15);
  EXPECT_EQ(pulled.bending + pulled.torsion, 0);
  const Real small = 1e-9;  // half the digits of a difference of cosines would be gone here
  const auto bent = beam_energy(rest, Vec3(1, 0, 0), identity(), exp_map(Vec3(0, small, 0)));
  EXPECT_NEAR(bent.bending, rest.bending * small * small, 1e-12 * rest.bending * small * small);
  EXPECT_EQ(bent.axial + bent.torsion, 0);
}

/// A pair that tumbles, stretches, bends and twists.
struct Dance {
  BeamRest<Real> rest;
  Pair p;
  Vec3 v1, v2, w1, w2;
  Real m1 = 1, m2 = 1.7, I1 = 0.4, I2 = 0.9;

  Real energy_now() const {
    return 0.5 * (m1 * v1.squaredNorm() + m2 * v2.squaredNorm() + I1 * w1.squaredNorm() + I2 * w2.squaredNorm()) +
           energy(rest, p);
  }
  Vec3 momentum() const { return m1 * v1 + m2 * v2; }
  Vec3 spin() const { return m1 * Vec3(p.x1.cross(v1)) + m2 * Vec3(p.x2.cross(v2)) + I1 * w1 + I2 * w2; }
};

Dance dancing_pair() {
  const auto rest = round_beam(Vec3(1, 0, 0), 10, 0.3, 0.4);
  return {rest,
          {Vec3(0, 0, 0), Vec3(1.02, 0.01, 0), exp_map(Vec3(0.1, 0.05, 0)), exp_map(Vec3(-0.1, 0, 0.08))},
          Vec3(0.1, -0.5, 0.1),
          Vec3(0, 0.4, -0.1),
          Vec3(0.2, -0.1, 0.6),
          Vec3(-0.1, 0.1, 0.6)};
}

template <class Law>
void dance(Dance& s, const Law& law, Real dt, int steps) {
  Wrench<Real> w = law(s);
  for (int step = 0; step < steps; ++step) {
    const Wrench<Real> old = w;
    s.p.x1 = advance<Real>(s.p.x1, s.v1, -old.force / s.m1, dt);
    s.p.x2 = advance<Real>(s.p.x2, s.v2, old.force / s.m2, dt);
    s.p.q1 = turn<Real>(s.p.q1, s.w1, old.torque1 / s.I1, dt);
    s.p.q2 = turn<Real>(s.p.q2, s.w2, old.torque2 / s.I2, dt);
    w = law(s);
    s.v1 = correct<Real>(s.v1, -old.force / s.m1, -w.force / s.m1, 1, dt);
    s.v2 = correct<Real>(s.v2, old.force / s.m2, w.force / s.m2, 1, dt);
    s.w1 = correct<Real>(s.w1, old.torque1 / s.I1, w.torque1 / s.I1, 1, dt);
    s.w2 = correct<Real>(s.w2, old.torque2 / s.I2, w.torque2 / s.I2, 1, dt);
  }
}

TEST(beam, a_tumbling_pair_keeps_its_energy_and_both_momenta) {
  Dance s = dancing_pair();
  const Dance start = s;
  Real worst = 0;
  for (int part = 0; part < 300; ++part) {
    dance(
        s, [](const Dance& at) { return wrench(at.rest, at.p); }, 1e-3, 10);
    worst = std::max(worst, std::abs(s.energy_now() / start.energy_now() - 1));
  }
  EXPECT_LT(worst, 1e-5);
  EXPECT_LT((s.momentum() - start.momentum()).norm(), 1e-12);
  EXPECT_LT((s.spin() - start.spin()).norm(),
            1e-5);  // of second order in dt: leapfrogged spins, see the next test
}

TEST(beam, the_energy_error_of_a_step_falls_with_its_square) {
  const auto off = [](Real dt) {
    Dance s = dancing_pair();
    const Dance start = s;
    dance(
        s, [](const Dance& at) { return wrench(at.rest, at.p); }, dt, static_cast<int>(std::lround(1 / dt)));
    return std::abs(s.energy_now() / start.energy_now() - 1);
  };
  EXPECT_NEAR(off(4e-3) / off(1e-3), 16, 1);
}

TEST(beam, a_law_that_is_no_gradient_would_not_keep_the_energy) {
  Dance s = dancing_pair();
  const Real start = s.energy_now();
  dance(
      s, [](const Dance& at) { return andre_wrench(at.rest, at.p.d(), at.p.q1, at.p.q2, at.p.d().norm()); }, 1e-3,
      3000);
  EXPECT_GT(std::abs(s.energy_now() / start - 1), 1e-4);
}

TEST(beam, its_section_forces_are_those_of_statics) {
  // a cantilever bond: end 1 clamped, end 2 free of torque and loaded across, to first order
  const Real r = 0.1, E = 4, L = 1, F = 1e-7;
  const auto rest = round_beam(Vec3(L, 0, 0), E, 0.25, r);
  const Real EI = E * pi * std::pow(r, 4) / 4;
  const Real w = F * L * L * L / (3 * EI), slope = F * L * L / (2 * EI);
  const auto s = beam_section(rest, Vec3(L, w, 0), identity(), exp_map(Vec3(0, 0, slope)));
  EXPECT_NEAR(s.moment1, F * L, 1e-5 * F * L);
  EXPECT_LT(s.moment2, 1e-5 * F * L);
  EXPECT_LT(std::abs(s.torque), 1e-12 * F * L);

  const auto twisted = beam_section(rest, Vec3(1.01 * L, 0, 0), identity(), exp_map(Vec3(1e-4, 0, 0)));
  EXPECT_NEAR(twisted.axial_force, rest.axial * 0.01 * L, 1e-14);
  EXPECT_NEAR(twisted.torque, rest.torsion * 1e-4, 1e-6 * rest.torsion * 1e-4);
}

TEST(beam, its_stresses_are_those_of_a_round_section) {
  const Real r = 0.3, A = pi * r * r, I = pi * std::pow(r, 4) / 4, J = 2 * I;
  const Real N = 2, M = 0.05, T = 0.04;
  const auto s = beam_stress(BeamSection<Real>{N, 0.5 * M, M, -T}, r);
  const Real sigma = N / A + M * r / I, tau = T * r / J;
  EXPECT_NEAR(s.axial, N / A, 1e-14 * s.axial);
  EXPECT_NEAR(s.axial_bending, sigma, 1e-14 * sigma);
  EXPECT_NEAR(s.principal, 0.5 * (sigma + std::sqrt(sigma * sigma + 4 * tau * tau)), 1e-14 * sigma);
  EXPECT_GT(s.principal, s.axial_bending);
}

TEST(beam, compression_alone_never_reaches_a_tensile_stress) {
  const auto s = beam_stress(BeamSection<Real>{-5, 0, 0, 0}, 0.3);
  EXPECT_LT(s.axial, 0);
  EXPECT_LT(s.axial_bending, 0);
  EXPECT_LE(s.principal, 0);
}

TEST(beam, round_beam_has_the_stiffnesses_of_its_section) {
  const Real E = 1100e9, nu = 0.2, r = 0.49e-4, L = 2e-4, I = pi * std::pow(r, 4) / 4;
  const auto rest = round_beam(Vec3(0, L, 0), E, nu, r);
  EXPECT_NEAR(rest.axial, E * pi * r * r / L, 1e-14 * rest.axial);
  EXPECT_NEAR(rest.bending, 2 * E * I / L, 1e-14 * rest.bending);
  EXPECT_NEAR(rest.torsion, E / (2 * (1 + nu)) * 2 * I / L, 1e-14 * rest.torsion);
}

}  // namespace
}  // namespace beadwork
