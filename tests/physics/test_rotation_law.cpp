#include <gtest/gtest.h>

#include <numbers>

#include "core/mechanics/rotation.hpp"
#include "tests/support/mechanics.hpp"

namespace beadwork {
namespace {

using std::numbers::pi;
using test::random_rotation;
using test::random_vector;

Real difference(const Quat& a, const Quat& b) { return std::max(std::abs(a.w - b.w), (a.v - b.v).norm()); }

/// Rodrigues' formula, from the axis and the angle.
Vec3 rodrigues(const Vec3& turn, const Vec3& v) {
  const Real angle = turn.norm();
  const Vec3 k = turn / angle;
  return v * std::cos(angle) + Vec3(k.cross(v)) * std::sin(angle) + k * (k.dot(v) * (1 - std::cos(angle)));
}

TEST(rotation, turns_a_vector_as_rodrigues_says) {
  Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 turn = random_vector(random, 1), v = random_vector(random, 1);
    EXPECT_LT((rotate(exp_map(turn), v) - rodrigues(turn, v)).norm(), 4e-15);
    EXPECT_LT((rotation_matrix(exp_map(turn)) * v - rodrigues(turn, v)).norm(), 4e-15);
    EXPECT_LT((rotate_back(exp_map(turn), rodrigues(turn, v)) - v).norm(), 4e-15);
  }
}

TEST(rotation, a_product_turns_first_by_the_right_then_by_the_left) {
  Random random(2);
  for (int trial = 0; trial < 100; ++trial) {
    const Quat a = random_rotation(random), b = random_rotation(random);
    const Vec3 v = random_vector(random, 1);
    EXPECT_LT((rotate(a * b, v) - rotate(a, rotate(b, v))).norm(), 4e-15);
    EXPECT_LT(difference(relative(a, b) * a, b), 1e-15);
    EXPECT_LT(difference(a * conjugate(a), identity()), 1e-15);
  }
}

TEST(rotation, the_logarithm_undoes_the_exponential_up_to_half_a_turn) {
  Random random(3);
  for (const Real angle : {0., 1e-300, 1e-160, 1e-12, 1e-8, 0.99e-4, 1.01e-4, 1e-3, 1., 3., pi - 1e-6, pi - 1e-12}) {
    const Vec3 turn = random_vector(random, 1).normalized() * angle;
    EXPECT_LT((log_map(exp_map(turn)) - turn).norm(), 4e-15 * (angle + 1e-16)) << angle;
    const Quat q = exp_map(turn);
    EXPECT_LT((log_map(Quat{-q.w, -q.v}) - turn).norm(), 4e-15 * (angle + 1e-16)) << angle;  // -q is the same rotation
  }
}

TEST(rotation, the_series_of_an_increment_is_exact_to_round_off_up_to_two_radians) {
  Random random(4);
  for (const Real angle : {0., 1e-12, 1e-4, 0.1, 0.5, 1., 1.5, 2.}) {
    const Vec3 turn = random_vector(random, 1).normalized() * angle;
    EXPECT_LT(difference(increment(turn), exp_map(turn)), 5e-16) << angle;
    EXPECT_LT(std::abs(squared_norm(increment(turn)) - 1), 1e-15) << angle;
  }
}

TEST(rotation, renormalising_brings_a_length_back_without_a_root) {
  const Quat q = exp_map(Vec3(0.3, -0.2, 0.5));
  for (const Real off : {1e-15, 1e-9, 1e-6}) {
    const Quat longer{q.w * (1 + off), q.v * (1 + off)};
    EXPECT_LT(difference(renormalise(longer), q), 2 * off * off + 4e-16);
    EXPECT_LT(difference(normalise(longer), q), 4e-16);
  }
}

TEST(rotation, works_on_single_precision_too) {
  const Quaternion<float> q = increment(Vec<float>(0.1f, 0.2f, -0.3f));
  const Vec<float> v = rotate(q, Vec<float>(1, 2, 3));
  const Vec3 expected = rodrigues(Vec3(0.1, 0.2, -0.3), Vec3(1, 2, 3));
  EXPECT_LT((v.cast<Real>() - expected).norm(), 1e-6);
}

}  // namespace
}  // namespace beadwork
