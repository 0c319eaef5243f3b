#include "core/mechanics/stability.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <numbers>

#include "core/base/parallel.hpp"
#include "core/mechanics/beam_stiffness.hpp"
#include "core/mechanics/cohesive_stiffness.hpp"
#include "core/mechanics/sphere.hpp"
#include "core/mechanics/spring_stiffness.hpp"
#include "tests/support/mechanics.hpp"

namespace beadwork {
namespace {

using namespace test;
using std::numbers::pi;

struct Scene {
  std::vector<Vec3> x;
  std::vector<Real> radius, mass, inertia;
  std::vector<std::pair<Index, Index>> bonds;
  ElasticNetwork network{0};

  Mobility mobility() const { return {mass, inertia}; }
};

/// A jittered lattice with the nearest pairs bonded until Z = 6.2: radii spread by a quarter, unit density
/// and E.
Scene random_network(int nx, int ny, int nz, Real radius_ratio, std::uint64_t seed) {
  Random random(seed);
  Scene s;
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j)
      for (int k = 0; k < nz; ++k) {
        s.x.push_back(Vec3(2 * i, 2 * j, 2 * k) + random_vector(random, 0.25));
        s.radius.push_back(random.uniform(0.75, 1.25));
        s.mass.push_back(sphere_mass(1, s.radius.back()));
        s.inertia.push_back(sphere_inertia(s.mass.back(), s.radius.back()));
      }
  std::vector<std::tuple<Real, Index, Index>> pairs;
  const auto count = static_cast<Index>(s.x.size());
  for (Index i = 0; i < count; ++i)
    for (Index j = i + 1; j < count; ++j)
      pairs.emplace_back((s.x[j] - s.x[i]).norm() / (s.radius[i] + s.radius[j]), i, j);
  std::sort(pairs.begin(), pairs.end());
  pairs.resize(static_cast<std::size_t>(3.1 * count));
  s.network = ElasticNetwork(count);
  for (const auto& [gap, i, j] : pairs) {
    const Vec3 d = s.x[j] - s.x[i];
    s.bonds.emplace_back(i, j);
    add_bond(
        s.network, i, j,
        beam_stiffness(round_beam(d, 1, 0.3, radius_ratio * 0.5 * (s.radius[i] + s.radius[j])), d, Slope::stiffest));
  }
  return s;
}

/// The largest eigenvalue of M^-1 K by bisection: mu - M^-1/2 K M^-1/2 has a Cholesky factor if and only if
/// mu lies above.
Real exact_lambda(const ElasticNetwork& network, const Mobility& mobility) {
  const Index size = 6 * network.elements();
  std::vector<Eigen::Triplet<Real>> entries;
  for (Index b = 0; b < network.bonds(); ++b) {
    const Matrix12 k = network.stiffness(b);
    const auto row = [&](int dof) { return 6 * (dof < 6 ? network.first(b) : network.second(b)) + dof % 6; };
    const auto root = [&](int dof) {
      return std::sqrt(mobility.inverse(dof < 6 ? network.first(b) : network.second(b), dof % 6));
    };
    for (int r = 0; r < 12; ++r)
      for (int c = 0; c < 12; ++c) entries.emplace_back(row(r), row(c), root(r) * k(r, c) * root(c));
  }
  for (Index i = 0; i < size; ++i) entries.emplace_back(i, i, 0);
  Eigen::SparseMatrix<Real> a(size, size), one(size, size);
  a.setFromTriplets(entries.begin(), entries.end());
  one.setIdentity();
  Real low = a.diagonal().maxCoeff(), high = 0;
  for (Index i = 0; i < size; ++i) high = std::max(high, a.col(i).cwiseAbs().sum());  // Gershgorin
  Eigen::SimplicialLLT<Eigen::SparseMatrix<Real>> factor;
  factor.analyzePattern(one - a);
  while (high - low > 1e-4 * high) {
    const Real mu = 0.5 * (low + high);
    factor.factorize(mu * one - a);
    (factor.info() == Eigen::Success ? high : low) = mu;
  }
  return high;
}

// ------------------------------------------------------------------------------------------------ a pair
// alone

/// Angular frequencies squared of two spheres and a beam, by the closed forms.
struct PairModes {
  Real axial, torsion, bending;
};
PairModes pair_modes(const BeamRest<Real>& rest, Real m1, Real m2, Real I1, Real I2) {
  const Real g = (1 / m1 + 1 / m2) / (rest.length * rest.length);
  Eigen::Matrix2d k, flexible;
  k << 2, 1, 1, 2;
  flexible << 1 / I1 + g, g, g, 1 / I2 + g;
  const Eigen::Vector2cd eig = Eigen::EigenSolver<Eigen::Matrix2d>(rest.bending * k * flexible).eigenvalues();
  return {rest.axial * (1 / m1 + 1 / m2), rest.torsion * (1 / I1 + 1 / I2), eig.real().maxCoeff()};
}

TEST(stability, a_pair_has_the_frequencies_of_the_closed_forms) {
  const Real m1 = 1.3, m2 = 0.7, I1 = 0.5, I2 = 0.2;
  for (const Real ratio : {0.1, 0.5, 0.9, 1.4}) {
    const auto rest = round_beam(Vec3(0, 2, 0), 1, 0.3, ratio);
    const auto modes = pair_modes(rest, m1, m2, I1, I2);
    Eigen::Matrix<Real, 12, 1> inverse;
    inverse << Vec3::Constant(1 / m1), Vec3::Constant(1 / I1), Vec3::Constant(1 / m2), Vec3::Constant(1 / I2);
    const Real expected = std::max({modes.axial, modes.torsion, modes.bending});
    EXPECT_NEAR(bond_lambda(beam_stiffness(rest, Vec3(0, 2, 0), Slope::stiffest), inverse), expected, 1e-12 * expected)
        << ratio;
  }
}

TEST(stability, equal_spheres_have_the_printed_ratios) {
  // L = 2R: in units of k_n/m 2, 1.92 r^2 (nu = .3), 1.25 r^2, 5.25 r^2: the axial mode governs below r =
  // .617
  const Real m = 2, R = 1, I = 0.4 * m;
  for (const Real r : {0.3, 0.6, 0.63, 0.9}) {
    const auto rest = round_beam(Vec3(2 * R, 0, 0), 1, 0.3, r);
    const auto modes = pair_modes(rest, m, m, I, I);
    const Real unit = rest.axial / m;
    EXPECT_NEAR(modes.axial / unit, 2, 1e-12);
    EXPECT_NEAR(modes.torsion / unit, r * r / (0.8 * 1.3), 1e-12);
    EXPECT_NEAR(modes.bending / unit, 5.25 * r * r, 1e-12);
    EXPECT_EQ(modes.axial > modes.bending, r < 0.617);
  }
}

TEST(stability, the_step_of_a_pair_is_nine_tenths_of_the_exact_one) {
  const auto rest = round_beam(Vec3(2, 0, 0), 1, 0.3, 0.5);
  ElasticNetwork network(2);
  add_bond(network, 0, 1, beam_stiffness(rest, Vec3(2, 0, 0), Slope::stiffest));
  const std::vector<Real> mass{1, 1}, inertia{0.4, 0.4};
  const auto step = stable_step(network, Mobility(mass, inertia));
  EXPECT_NEAR(step.dt, 0.9 * 2 / std::sqrt(2 * rest.axial), 1e-5 * step.dt);
  EXPECT_FALSE(step.mode.rotates);
}

// ------------------------------------------------------------------------------------------------ networks

TEST(stability, the_product_is_the_assembled_matrix_times_the_vector) {
  const Scene s = random_network(3, 3, 2, 0.5, 1);
  Random random(5);
  const std::size_t size = 6 * s.x.size();
  Eigen::VectorXd x(size), y(size), expected = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(size));
  for (auto& value : x) value = random.normal();
  for (std::size_t b = 0; b < s.bonds.size(); ++b) {
    const auto [i, j] = s.bonds[b];
    const Vec3 d = s.x[j] - s.x[i];
    const Matrix12 k = beam_stiffness(round_beam(d, 1, 0.3, 0.25 * (s.radius[i] + s.radius[j])), d, Slope::stiffest);
    Vector12 ends;
    ends << x.segment<6>(6 * i), x.segment<6>(6 * j);
    const Vector12 f = k * ends;
    expected.segment<6>(6 * i) += f.head<6>();
    expected.segment<6>(6 * j) += f.tail<6>();
    EXPECT_LT((s.network.stiffness(static_cast<Index>(b)) - k).norm(), 1e-6 * k.norm());
  }
  s.network.multiply({x.data(), size}, {y.data(), size});
  EXPECT_LT((y - expected).norm(), 1e-6 * expected.norm());
}

TEST(stability, the_step_lies_between_half_and_all_of_the_exact_one_at_any_radius_ratio) {
  for (const Real ratio : {0.1, 0.19, 0.49, 0.71, 0.9}) {
    const Scene s = random_network(10, 10, 6, ratio, 7);
    const auto step = stable_step(s.network, s.mobility());
    const Real exact = exact_lambda(s.network, s.mobility());
    const Real found = step.dt / critical_step(exact);
    EXPECT_GE(found, 0.55) << ratio;
    EXPECT_LE(found, 0.98) << ratio;
    EXPECT_LE(step.mode.lambda, exact * (1 + 2e-4));  // the iteration comes from below
    EXPECT_GE(step.mode.lambda, 0.95 * exact) << ratio;
    EXPECT_GE(step.bound.lambda, exact * (1 - 2e-4));  // the bound never lies below
    EXPECT_LE(step.bound.lambda, 3.3 * exact) << ratio;
    RecordProperty("bound_at_" + std::to_string(ratio), std::to_string(std::sqrt(exact / step.bound.lambda)));
  }
}

TEST(stability, a_beam_alone_would_promise_too_long_a_step) {
  const Scene s = random_network(10, 10, 6, 0.49, 7);
  Real alone = 0;
  for (Index b = 0; b < s.network.bonds(); ++b) {
    Eigen::Matrix<Real, 12, 1> inverse;
    for (int dof = 0; dof < 12; ++dof)
      inverse[dof] = s.mobility().inverse(dof < 6 ? s.network.first(b) : s.network.second(b), dof % 6);
    if (b % 10 == 0) alone = std::max(alone, bond_lambda(s.network.stiffness(b), inverse));
  }
  EXPECT_LT(alone, exact_lambda(s.network, s.mobility()));
}

TEST(stability, one_stiff_contact_sets_the_step_and_is_named) {
  Scene s = random_network(6, 6, 6, 0.3, 3);
  const auto before = stable_step(s.network, s.mobility());
  const Vec3 d = s.x[101] - s.x[100];
  const Softening<Real> stiff{1e4, 0.1, 1};
  const CohesiveRest<Real> rest{d.norm(), 1};
  add_bond(s.network, 100, 101, opening_stiffness(stiff, rest, d, 0, Slope::stiffest));
  const auto step = stable_step(s.network, s.mobility());
  EXPECT_LT(step.dt, 0.2 * before.dt);
  EXPECT_TRUE(step.mode.element == 100 || step.mode.element == 101);
  EXPECT_FALSE(step.mode.rotates);
  EXPECT_GT(step.mode.share, 0.2);
  EXPECT_EQ(step.bound.bond, s.network.bonds() - 1);
  const Real exact = exact_lambda(s.network, s.mobility());
  EXPECT_GE(step.bound.lambda, exact * (1 - 2e-4));
  EXPECT_LE(step.bound.lambda, 1.5 * exact);
}

TEST(stability, thick_beams_are_limited_by_a_rotation) {
  const Scene s = random_network(4, 4, 4, 0.9, 2);
  std::vector<Real> light = s.inertia;
  light[17] *= 1e-3;
  const auto step = stable_step(s.network, Mobility(s.mass, light));
  EXPECT_EQ(step.mode.element, 17);
  EXPECT_TRUE(step.mode.rotates);
}

TEST(stability, springs_need_no_inertia) {
  // a free chain: lambda = 2 k/m (1 + cos(pi/n))
  const Index count = 12;
  ElasticNetwork network(count);
  for (Index i = 0; i + 1 < count; ++i)
    add_bond(network, i, i + 1, spring_stiffness({1, 3}, Vec3(1, 0, 0), Slope::stiffest));
  const std::vector<Real> mass(count, 2);
  const Mobility mobility(mass, {});
  const Real exact = 2 * 3. / 2 * (1 + std::cos(pi / count));
  EXPECT_NEAR(exact_lambda(network, mobility), exact, 2e-4 * exact);
  const auto mode = power_iteration(network, mobility, 2000);
  EXPECT_NEAR(mode.lambda, exact, 1e-6 * exact);
  EXPECT_GE(bond_bound(network, mobility).lambda, exact);
  EXPECT_FALSE(mode.rotates);
}

TEST(stability, what_is_held_limits_no_step) {
  ElasticNetwork network(2);
  add_bond(network, 0, 1, spring_stiffness({1, 3}, Vec3(1, 0, 0), Slope::stiffest));
  const std::vector<Real> mass{2, 2};
  Mobility mobility(mass, {});
  EXPECT_NEAR(power_iteration(network, mobility).lambda, 3, 1e-6);  // k (1/m + 1/m)
  mobility.hold(0, 0);
  EXPECT_NEAR(power_iteration(network, mobility).lambda, 1.5, 1e-6);
  EXPECT_NEAR(bond_bound(network, mobility).lambda, 1.5, 1e-5);
  mobility.hold(1, 0);
  EXPECT_EQ(power_iteration(network, mobility).lambda, 0);
  EXPECT_TRUE(std::isinf(stable_step(network, mobility).dt));
}

TEST(stability, the_bound_is_not_deceived_by_a_bond_with_many_middling_modes) {
  // a thick beam has the greater norm, a spring elsewhere the higher frequency
  const auto rest = round_beam(Vec3(2, 0, 0), 1, 0.3, 0.6);
  const Real k = 1.05 * rest.axial;
  ElasticNetwork network(4);
  add_bond(network, 0, 1, beam_stiffness(rest, Vec3(2, 0, 0), Slope::stiffest));
  add_bond(network, 2, 3, spring_stiffness({2, k}, Vec3(2, 0, 0), Slope::stiffest));
  const std::vector<Real> mass(4, 1), inertia(4, 0.4);
  const auto bound = bond_bound(network, Mobility(mass, inertia));
  EXPECT_EQ(bound.bond, 1);
  EXPECT_NEAR(bound.lambda, 2 * k, 1e-5 * k);
}

TEST(stability, no_bonds_no_limit) {
  const ElasticNetwork network(3);
  const std::vector<Real> mass(3, 1);
  EXPECT_TRUE(std::isinf(stable_step(network, Mobility(mass, mass)).dt));
}

TEST(stability, gives_the_same_bits_with_any_number_of_threads) {
  const Scene s = random_network(8, 8, 20, 0.5, 4);  // 1280 elements: more than one block of a sum
  const int before = threads_in_use();
  use_threads(1);
  const auto one = stable_step(s.network, s.mobility());
  use_threads(3);
  const auto three = stable_step(s.network, s.mobility());
  use_threads(before);
  EXPECT_EQ(one.dt, three.dt);
  EXPECT_EQ(one.mode.lambda, three.mode.lambda);
  EXPECT_EQ(one.mode.element, three.mode.element);
  EXPECT_EQ(one.bound.lambda, three.bound.lambda);
}

}  // namespace
}  // namespace beadwork
