#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <numbers>

#include "core/mechanics/spring.hpp"
#include "core/mechanics/verlet.hpp"
#include "tests/support/mechanics.hpp"
#include "tests/support/spinning_pair.hpp"

namespace beadwork {
namespace {

using namespace test;
using std::numbers::pi;

/// One step of the oscillator a = -p (angular frequency 1) as a matrix on (p, v dt), measured from the
/// functions.
Eigen::Matrix2d step_matrix(Real h, Real beta) {
  Eigen::Matrix2d a;
  for (int k = 0; k < 2; ++k) {
    const Vec3 p(k == 0, 0, 0), v(k == 1 ? 1 / h : 0, 0, 0);
    const Vec3 next = advance<Real>(p, v, -p, h);
    a(0, k) = next[0];
    a(1, k) = correct<Real>(v, -p, -next, beta, h)[0] * h;
  }
  return a;
}

Real spectral_radius(const Eigen::Matrix2d& a) {
  return Eigen::EigenSolver<Eigen::Matrix2d>(a).eigenvalues().cwiseAbs().maxCoeff();
}

TEST(verlet, an_oscillator_steps_by_the_matrix_of_the_theory) {
  for (const Real h : {0.01, 0.3, 1., 1.9})
    for (const Real beta : {1., 0.9, 0.5}) {
      const auto a = step_matrix(h, beta);
      EXPECT_NEAR(a.trace(), 2 - (1 + beta) * h * h / 2, 1e-14);
      EXPECT_NEAR(a.determinant(), 1 - (1 - beta) * h * h / 2, 1e-14);
    }
}

TEST(verlet, is_stable_exactly_below_a_step_of_two_over_omega_whatever_beta) {
  for (const Real beta : {1., 0.999, 0.9, 0.5, 0.1}) {
    EXPECT_LE(spectral_radius(step_matrix(1.999, beta)), 1 + 1e-12) << beta;
    EXPECT_GT(spectral_radius(step_matrix(2.001, beta)), 1) << beta;
  }
  EXPECT_NEAR(spectral_radius(step_matrix(2.02, 1)), 1.33,
              0.005);  // derived: (h^2/2 - 1) + sqrt((h^2/2 - 1)^2 - 1)
}

TEST(verlet, gains_energy_at_any_step_with_beta_above_one) {
  for (const Real h : {0.01, 0.1, 1., 1.9}) EXPECT_GT(spectral_radius(step_matrix(h, 1.001)), 1 + 1e-9) << h;
  EXPECT_GT(spectral_radius(step_matrix(1, -0.5)), 1);
}

TEST(verlet, damps_by_the_square_root_of_the_determinant_while_it_swings) {
  for (const Real h : {0.1, 1., 1.5})
    for (const Real beta : {0.9, 0.99})
      EXPECT_NEAR(spectral_radius(step_matrix(h, beta)), std::sqrt(1 - (1 - beta) * h * h / 2), 1e-13);
  EXPECT_NEAR(spectral_radius(step_matrix(1, 1)), 1, 1e-13);  // beta = 1 does not damp
}

TEST(verlet, turns_the_phase_by_twice_the_arcsine_of_half_the_step) {
  for (const Real h : {0.01, 0.5, 1.5}) {
    const auto phase = std::arg(Eigen::EigenSolver<Eigen::Matrix2d>(step_matrix(h, 1)).eigenvalues()[0]);
    EXPECT_NEAR(std::abs(phase), 2 * std::asin(h / 2), 1e-12);
  }
}

TEST(verlet, beta_makes_inertia_heavier_by_its_inverse) {
  Vec3 p = zero<Vec3>(), v = zero<Vec3>();
  const Vec3 g(0, 0, -10);
  for (int step = 0; step < 1000; ++step) {
    p = advance<Real>(p, v, g, 1e-3);
    v = correct<Real>(v, g, g, 0.8, 1e-3);
  }
  EXPECT_NEAR(v[2], -8, 1e-12);
}

/// A chain of unit masses and unit springs on a line, free at both ends: exactly linear.
struct Chain {
  static constexpr int count = 10;
  Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(count, 0, count - 1), v = Eigen::VectorXd::Zero(count);

  Eigen::VectorXd force(const Eigen::VectorXd& at) const {
    Eigen::VectorXd f = Eigen::VectorXd::Zero(count);
    for (int i = 0; i + 1 < count; ++i) {
      const Real pull = spring_force<Real>({1, 1}, Vec3(at[i + 1] - at[i], 0, 0))[0];
      f[i] -= pull;
      f[i + 1] += pull;
    }
    return f;
  }
  /// v.v/2 + u.K u/2 - dt^2/8 |K u|^2: what velocity Verlet keeps instead of the energy.
  Real shadow_energy(Real dt) const {
    const Eigen::VectorXd u = x - Eigen::VectorXd::LinSpaced(count, 0, count - 1);
    const Eigen::VectorXd f = force(x);
    return 0.5 * v.squaredNorm() - 0.5 * u.dot(f) - dt * dt / 8 * f.squaredNorm();
  }
  void run(Real dt, int steps) {
    Eigen::VectorXd a = force(x);
    for (int step = 0; step < steps; ++step) {
      for (int i = 0; i < count; ++i) x[i] = advance<Real>(Vec3(x[i], 0, 0), Vec3(v[i], 0, 0), Vec3(a[i], 0, 0), dt)[0];
      const Eigen::VectorXd next = force(x);
      for (int i = 0; i < count; ++i)
        v[i] = correct<Real>(Vec3(v[i], 0, 0), Vec3(a[i], 0, 0), Vec3(next[i], 0, 0), 1, dt)[0];
      a = next;
    }
  }
  /// 2/omega of the highest mode: omega^2 = 2 (1 - cos(pi (n-1)/n)).
  static Real critical_step() { return 2 / std::sqrt(2 * (1 + std::cos(pi / count))); }
};

TEST(verlet, a_chain_just_below_the_critical_step_keeps_its_shadow_energy_for_a_million_steps) {
  Chain chain;
  for (int i = 0; i < Chain::count; ++i) chain.v[i] = 1e-3 * ((i * 7) % 5 - 2);
  const Real dt = 0.99 * Chain::critical_step();
  const Real start = chain.shadow_energy(dt);
  for (int part = 0; part < 100; ++part) {
    chain.run(dt, 10000);
    ASSERT_NEAR(chain.shadow_energy(dt), start, 1e-9 * start) << part;
  }
}

TEST(verlet, a_chain_just_above_the_critical_step_blows_up) {
  Chain chain;
  chain.v[0] = 1e-9;
  chain.run(1.01 * Chain::critical_step(), 100);
  EXPECT_GT(chain.v.norm(), 1);  // 1.33 a step
}

TEST(verlet, a_steady_spin_turns_exactly) {
  Quat q = identity();
  const Vec3 w(0.3, -1, 2);
  for (int step = 0; step < 1000; ++step) q = turn<Real>(q, w, zero<Vec3>(), 1e-2);
  const Quat expected = exp_map(w * 10);
  EXPECT_LT(std::min((q.v - expected.v).norm(), (q.v + expected.v).norm()), 1e-12);
  EXPECT_NEAR(squared_norm(q), 1, 1e-15);
}

/// A sphere on a torsion spring, T = -2 k u(w-frame): a pure rotation about a fixed axis, and what it stores.
template <class Turn>
Real energy_growth(const Turn& turning, Real dt, int steps) {
  const Real k = 1;
  Quat q = exp_map(Vec3(0, 0, 0.5));
  Vec3 w = zero<Vec3>();
  const auto torque = [&](const Quat& at) -> Vec3 { return -2 * k * at.w * at.v; };  // -k sin(angle)
  const auto energy = [&] { return 0.5 * w.squaredNorm() + 2 * k * q.v.squaredNorm(); };
  const Real start = energy();
  Real worst = 0;
  Vec3 alpha = torque(q);
  for (int step = 0; step < steps; ++step) {
    q = turning(q, w, alpha, dt);
    const Vec3 next = torque(q);
    w = correct<Real>(w, alpha, next, 1, dt);
    alpha = next;
    worst = std::max(worst, energy() / start);
  }
  return worst;
}

TEST(verlet, an_orientation_without_its_angular_acceleration_blows_up) {
  const auto whole = [](const Quat& q, const Vec3& w, const Vec3& alpha, Real dt) {
    return turn<Real>(q, w, alpha, dt);
  };
  const auto without = [](const Quat& q, const Vec3& w, const Vec3&, Real dt) {
    return turn<Real>(q, w, zero<Vec3>(), dt);
  };
  EXPECT_LT(energy_growth(whole, 0.1, 3000), 1.01);
  EXPECT_GT(energy_growth(without, 0.1, 3000), 2);
}

TEST(verlet, orientations_are_of_second_order) {
  const auto off = [](int steps) {  // a spin that speeds up and turns its axis, against a fine run
    Quat q = identity();
    Vec3 w(1, 0, 0);
    const Real dt = 1. / steps;
    const auto torque = [](const Quat& at) -> Vec3 { return rotate(at, Vec3(0, 1, 0)) + Vec3(0, 0, 0.5); };
    Vec3 alpha = torque(q);
    for (int step = 0; step < steps; ++step) {
      q = turn<Real>(q, w, alpha, dt);
      const Vec3 next = torque(q);
      w = correct<Real>(w, alpha, next, 1, dt);
      alpha = next;
    }
    return q;
  };
  const Quat fine = off(8000);
  const Real coarse = log_map(relative(fine, off(50))).norm(), half = log_map(relative(fine, off(100))).norm();
  EXPECT_NEAR(coarse / half, 4, 0.1);
}

// A million: tests/nightly.
TEST(verlet, ten_thousand_revolutions_of_a_bonded_pair_keep_energy_spin_and_the_length_of_a_quaternion) {
  SpinningPair pair;
  ASSERT_TRUE(pair.is_stable());
  const Real start = pair.energy();
  const Vec3 spin_start = pair.spin();
  Real worst = 0, tilt = 0;
  for (int turns = 0; turns < 10000; ++turns) {
    pair.turn_once();
    worst = std::max(worst, std::abs(pair.energy() / start - 1));
    tilt = std::max(tilt, pair.tilt());
  }
  EXPECT_LT(worst, 1e-6);
  EXPECT_LT((pair.spin() - spin_start).norm(), 1e-10 * spin_start.norm());
  EXPECT_LT(pair.stretch_of_quaternions(), 1e-12);
  EXPECT_EQ(tilt, 0);
}

TEST(verlet, a_mass_ratio_of_a_million_keeps_momentum) {
  const SpringRest<Real> rest{1, 1};
  Vec3 x1(0, 0, 0), x2(1.3, 0.2, 0), v1 = zero<Vec3>(), v2(0, 0.1, 0);
  const Real m1 = 1e6, m2 = 1, dt = 0.1;
  const Vec3 start = m1 * v1 + m2 * v2;
  Vec3 f = spring_force(rest, x2 - x1);
  for (int step = 0; step < 10000; ++step) {
    x1 = advance<Real>(x1, v1, -f / m1, dt);
    x2 = advance<Real>(x2, v2, f / m2, dt);
    const Vec3 next = spring_force(rest, x2 - x1);
    v1 = correct<Real>(v1, -f / m1, -next / m1, 1, dt);
    v2 = correct<Real>(v2, f / m2, next / m2, 1, dt);
    f = next;
  }
  EXPECT_LT((m1 * v1 + m2 * v2 - start).norm(), 1e-12);
}

}  // namespace
}  // namespace beadwork
