// The parts of static movers, each alone: linear solvers, supports, the stiffness of a scene, acceleration, events.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "core/base/failure.hpp"
#include "core/statics/acceleration.hpp"
#include "core/statics/event.hpp"
#include "core/statics/increments.hpp"
#include "core/statics/linear_solver.hpp"
#include "core/statics/stiffness_matrix.hpp"
#include "core/statics/supported_system.hpp"

namespace beadwork {
namespace {

using Eigen::MatrixXd;

SymmetricMatrix sparse(const MatrixXd& full) {
  SymmetricMatrix matrix;
  for (int c = 0; c < full.cols(); ++c) {
    for (int r = c; r < full.rows(); ++r)
      if (r == c || full(r, c) != 0) matrix.row.push_back(r), matrix.value.push_back(full(r, c));
    matrix.begin.push_back(static_cast<int>(matrix.row.size()));
  }
  return matrix;
}

// A chain of springs between unknowns, on a bed of others where `bed` is not 0.
MatrixXd chain(int size, Real bed) {
  MatrixXd k = bed * MatrixXd::Identity(size, size);
  for (int i = 0; i + 1 < size; ++i) {
    const Real spring = 1 + i % 3;
    k(i, i) += spring, k(i + 1, i + 1) += spring;
    k(i, i + 1) -= spring, k(i + 1, i) -= spring;
  }
  return k;
}

Vector random_vector(int size, unsigned seed) {
  std::mt19937 draw(seed);
  std::uniform_real_distribution<Real> any(-1, 1);
  Vector v(size);
  for (int k = 0; k < size; ++k) v[k] = any(draw);
  return v;
}

class EachSolver : public testing::TestWithParam<std::string> {};

TEST_P(EachSolver, solves_what_is_definite) {
  const auto solver = linear_solver(GetParam());
  const MatrixXd k = chain(50, 0.3);
  const SymmetricMatrix matrix = sparse(k);
  solver->analyse(matrix);
  EXPECT_TRUE(solver->factor(matrix).whole);
  Vector x = random_vector(50, 1);
  const Vector b = x;
  EXPECT_TRUE(solver->solve(x));
  EXPECT_LT((k * x - b).norm(), 1e-8 * b.norm());
}

TEST_P(EachSolver, factors_again_with_the_order_that_it_found) {
  const auto solver = linear_solver(GetParam());
  solver->analyse(sparse(chain(30, 1)));
  for (const Real bed : {1., 5.}) {
    const MatrixXd k = chain(30, bed);
    const SymmetricMatrix matrix = sparse(k);
    EXPECT_TRUE(solver->factor(matrix).whole);
    Vector x = random_vector(30, 2);
    const Vector b = x;
    solver->solve(x);
    EXPECT_LT((k * x - b).norm(), 1e-8 * b.norm());
  }
}

TEST_P(EachSolver, takes_another_pattern_and_forgets_the_numbers_before) {
  const auto solver = linear_solver(GetParam());
  for (const int size : {30, 9, 12}) {
    const MatrixXd k = chain(size, 1);
    const SymmetricMatrix matrix = sparse(k);
    solver->analyse(matrix);
    EXPECT_TRUE(solver->factor(matrix).whole);
    Vector x = random_vector(size, 6);
    const Vector b = x;
    solver->solve(x);
    EXPECT_LT((k * x - b).norm(), 1e-8 * b.norm());
  }
}

TEST_P(EachSolver, counts_what_is_negative_and_solves_with_it_if_it_says_so) {
  const auto solver = linear_solver(GetParam());
  if (!solver->takes_indefinite()) return;  // definite matrices alone, and it says so
  MatrixXd k = chain(40, 0.5);
  k(7, 7) -= 6, k(23, 23) -= 9;
  const SymmetricMatrix matrix = sparse(k);
  solver->analyse(matrix);
  const Factored factored = solver->factor(matrix);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> modes(k);
  EXPECT_EQ(factored.negative, (modes.eigenvalues().array() < 0).count());
  Vector x = random_vector(40, 3);
  const Vector b = x;
  solver->solve(x);
  EXPECT_LT((k * x - b).norm(), 1e-8 * b.norm());
}

TEST_P(EachSolver, names_an_unknown_of_what_nothing_holds) {
  const auto solver = linear_solver(GetParam());
  if (!solver->takes_indefinite()) return;  // it has no pivots
  MatrixXd k = MatrixXd::Zero(20, 20);
  k.topLeftCorner(12, 12) = chain(12, 0.5);
  k.bottomRightCorner(8, 8) = chain(8, 0);  // drifts
  const SymmetricMatrix matrix = sparse(k);
  solver->analyse(matrix);
  EXPECT_GE(solver->factor(matrix).weakest, 12);
}

INSTANTIATE_TEST_SUITE_P(Linear, EachSolver, testing::ValuesIn(linear_solvers()), [](const auto& name) {
  std::string word = name.param;
  std::erase(word, '-');
  return word;
});

TEST(Solvers, that_do_not_exist_are_refused) { EXPECT_THROW(linear_solver("magic"), std::logic_error); }

// The same by a dense system with a multiplier for each support.
Vector by_multipliers(const MatrixXd& k, const Supports& supports, const Vector& f, const Lacking& lacking) {
  const auto n = static_cast<int>(k.rows());
  std::vector<std::pair<Vector, Real>> rows;
  for (int u = 0; u < n; ++u)
    if (supports.is_fixed(u)) rows.emplace_back(Vector::Unit(n, u), lacking.fixed[u]);
  for (std::size_t m = 0; m < supports.means.size(); ++m) {
    Vector row = Vector::Zero(n);
    for (const int u : supports.means[m].unknowns) row[u] += 1. / static_cast<Real>(supports.means[m].unknowns.size());
    rows.emplace_back(row, lacking.means[static_cast<Eigen::Index>(m)]);
  }
  const auto c = static_cast<int>(rows.size());
  MatrixXd all = MatrixXd::Zero(n + c, n + c);
  Vector right(n + c);
  all.topLeftCorner(n, n) = k;
  right.head(n) = f;
  for (int r = 0; r < c; ++r) {
    all.block(n + r, 0, 1, n) = rows[static_cast<std::size_t>(r)].first.transpose();
    all.block(0, n + r, n, 1) = rows[static_cast<std::size_t>(r)].first;
    right[n + r] = rows[static_cast<std::size_t>(r)].second;
  }
  return all.fullPivLu().solve(right).head(n);
}

void expect_as_by_multipliers(const MatrixXd& k, const Supports& supports, const Lacking& lacking) {
  SupportedSystem system(linear_solver("simplicial"));
  system.analyse(sparse(k));
  EXPECT_TRUE(system.factor(sparse(k), supports).whole);
  const Vector f = random_vector(static_cast<int>(k.rows()), 4);
  Vector du;
  EXPECT_TRUE(system.solve(f, lacking, du));
  const Vector exact = by_multipliers(k, supports, f, lacking);
  EXPECT_LT((du - exact).norm(), 1e-9 * exact.norm());
}

TEST(SupportedSystems, move_what_is_fixed_as_far_as_it_lacks) {
  Supports supports{std::vector<char>(20, 0), {}};
  supports.fixed[0] = supports.fixed[19] = 1;
  Lacking lacking{Vector::Zero(20), Vector(0)};
  lacking.fixed[19] = 0.25;
  expect_as_by_multipliers(chain(20, 0), supports, lacking);
}

TEST(SupportedSystems, move_means_alone_though_nothing_else_holds) {
  Supports supports{std::vector<char>(20, 0), {{{2, 3, 4, 5}, 3}}};
  Lacking lacking{Vector::Zero(20), Vector::Constant(1, -0.5)};
  expect_as_by_multipliers(chain(20, 0), supports, lacking);
}

TEST(SupportedSystems, hold_several_means_beside_what_is_fixed_in_them) {
  Supports supports{std::vector<char>(24, 0), {{{1, 2, 3}, 2}, {{3, 10, 11, 12}, 11}, {{20, 21, 22, 23}, 21}}};
  supports.fixed[23] = 1;
  Lacking lacking{Vector::Zero(24), Vector(3)};
  lacking.fixed[23] = 0.3;
  lacking.means << 0.1, -0.2, 0.4;
  expect_as_by_multipliers(chain(24, 0), supports, lacking);
}

TEST(Supports_, take_what_is_even_over_a_mean_and_leave_the_rest) {
  Supports supports{std::vector<char>(6, 0), {{{0, 1, 2}, 0}}};
  supports.fixed[5] = 1;
  Vector f(6);
  f << 4, 5, 6, -1, 0, 9;
  const Vector left = supports.unbalanced(f);
  Vector expected(6);
  expected << -1, 0, 1, -1, 0, 0;
  EXPECT_LT((left - expected).norm(), 1e-14);
}

TEST(StiffnessMatrices, add_up_bonds_in_units_of_a_length) {
  const Real length = 0.5;
  StiffnessMatrix scene(3, {{0, 1}, {1, 2}}, length);
  MatrixXd full = MatrixXd::Zero(18, 18);
  const std::pair<Index, Index> bonds[] = {{0, 1}, {1, 2}, {0, 1}};  // two of one pair
  for (unsigned b = 0; b < 3; ++b) {
    Matrix12 k;
    for (int c = 0; c < 12; ++c) k.col(c) = random_vector(12, 10 + 20 * b + static_cast<unsigned>(c));
    scene.add(bonds[b].first, bonds[b].second, k);
    MatrixXd half = 0.5 * (k + k.transpose());
    for (const int turn : {3, 9}) half.middleRows(turn, 3) /= length, half.middleCols(turn, 3) /= length;
    const int i = 6 * bonds[b].first, j = 6 * bonds[b].second;
    full.block(i, i, 6, 6) += half.topLeftCorner(6, 6), full.block(j, j, 6, 6) += half.bottomRightCorner(6, 6);
    full.block(i, j, 6, 6) += half.topRightCorner(6, 6), full.block(j, i, 6, 6) += half.bottomLeftCorner(6, 6);
  }
  const MatrixXd found = MatrixXd(scene.matrix().lower()).selfadjointView<Eigen::Lower>();
  EXPECT_LT((found - full).norm(), 1e-13 * full.norm());
}

TEST(StiffnessMatrices, of_more_numbers_than_can_be_counted_are_refused) {
  EXPECT_EQ(numbers_of_stiffness(3, 2, false), 3 * 6 + 2 * 9);
  EXPECT_EQ(numbers_of_stiffness(8'000'000, 24'000'000, true), 8 * 129'000'000);
  EXPECT_THROW(numbers_of_stiffness(10'000'000, 31'000'000, true), MachineFailure);
  EXPECT_NO_THROW(numbers_of_stiffness(10'000'000, 31'000'000, false)) << "of springs";
}

TEST(StiffnessMatrices, hold_what_nothing_resists_and_nothing_else) {
  StiffnessMatrix scene(2, {{0, 1}}, 0);
  Vec3 n(1, 2, 2);
  n /= 3;
  scene.add(0, 1, stiffness::between_centres(7 * (n * n.transpose())));
  scene.hold_idle();
  const MatrixXd k = MatrixXd(scene.matrix().lower()).selfadjointView<Eigen::Lower>();
  EXPECT_NEAR(n.dot(k.topLeftCorner<3, 3>() * n), 7, 1e-12);  // along the spring as it was
  const Vec3 across(2, -1, 0);
  EXPECT_GT(across.dot(k.topLeftCorner<3, 3>() * across) / across.squaredNorm(), 1);
  EXPECT_NEAR((k.topLeftCorner<3, 3>() * n - 7 * n).norm(), 0, 1e-12);
}

TEST(Accelerations, solve_a_linear_problem_in_as_many_steps_as_the_stiffness_is_wrong_in) {
  const MatrixXd k = chain(30, 0.5);
  MatrixXd kept = k;
  for (const int u : {3, 11, 17}) kept(u, u) *= 4;  // of rank 3
  const Vector b = random_vector(30, 5);
  const auto left_after = [&](bool accelerated) {
    Acceleration acceleration;
    Vector x = Vector::Zero(30);
    for (int round = 0; round < 6; ++round) {
      const Vector correction = kept.ldlt().solve(b - k * x);
      x += accelerated ? acceleration.step(correction) : correction;
    }
    return (b - k * x).norm() / b.norm();
  };
  EXPECT_LT(left_after(true), 1e-9);
  EXPECT_GT(left_after(false), 1e-3);
}

TEST(Events, are_found_in_one_round_where_the_utilisation_is_a_straight_line) {
  EventSearch search(0.2, 1.8, 1e-6);
  const Real share = search.next();
  EXPECT_NEAR(share, 0.5, 1e-6);
  EXPECT_TRUE(search.take(share, 0.2 + 1.6 * share));
}

// The share at which the search ends, and after how many rounds.
template <class F>
std::pair<Real, int> found_event(const F& utilisation) {
  EventSearch search(utilisation(0.), utilisation(1.), 1e-9);
  for (int round = 1; round <= EventSearch::most_rounds; ++round) {
    const Real share = search.next();
    if (search.take(share, utilisation(share))) return {share, round};
  }
  return {-1, EventSearch::most_rounds + 1};
}

TEST(Events, are_found_in_a_few_rounds_on_a_curve) {
  const auto [share, rounds] = found_event([](Real s) { return 3 * s * s; });
  EXPECT_NEAR(3 * share * share, 1, 1e-8);
  EXPECT_LT(rounds, 10);
}

TEST(Events, are_found_at_a_jump_of_any_height) {
  for (const Real at : {0.01, 0.3, 0.5, 0.9})
    for (const Real below : {0.1, 0.9, 0.999})
      for (const Real above : {1.1, 2., 10., 100.}) {
        const auto [share, rounds] = found_event([&](Real s) { return s < at ? below : above; });
        EXPECT_GE(share, at) << below << " " << above;
        EXPECT_NEAR(share, at, 1e-11) << below << " " << above;
      }
}

TEST(Increments, end_when_what_is_pulled_has_come_so_far) {
  Constraint slow, fast, turned;
  slow.driven = fast.driven = turned.driven = true;
  turned.axis = 4;
  slow.motion = [](Real t) { return PrescribedMotion{-2 * t, -2, 0}; };
  fast.motion = [](Real t) { return PrescribedMotion{t * t, 2 * t, 2}; };
  turned.motion = [](Real t) { return PrescribedMotion{1000 * t, 1000, 0}; };
  const std::vector<Constraint> all{slow, fast, turned};
  EXPECT_NEAR(*time_of_displacement(all, 0, 1), 0.5, 1e-12);
  EXPECT_NEAR(*time_of_displacement(all, 5, 11), 6, 1e-12);
  EXPECT_FALSE(time_of_displacement(std::vector<Constraint>{turned}, 0, 1));
}

TEST(Increments, are_cut_in_half_down_to_the_smallest_and_grown_again) {
  Real kept = 1;
  IncrementShare share(kept, 0.2);
  EXPECT_TRUE(share.cut());
  EXPECT_TRUE(share.cut());
  EXPECT_EQ(share.share(), 0.25);
  EXPECT_TRUE(share.cut());
  EXPECT_EQ(share.share(), 0.2);
  EXPECT_FALSE(share.cut());
  share.grow(20, 25);
  EXPECT_EQ(share.share(), 0.2);
  for (int k = 0; k < 5; ++k) share.grow(3, 25);
  EXPECT_EQ(kept, 1);
}

}  // namespace
}  // namespace beadwork
