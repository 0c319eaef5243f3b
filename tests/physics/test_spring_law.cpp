#include "core/mechanics/spring.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/mechanics/spring_stiffness.hpp"
#include "tests/support/mechanics.hpp"

namespace beadwork {
namespace {

using namespace test;

TEST(spring, pulls_along_the_line_of_centres_by_the_gradient_of_its_energy) {
  Random random(1);
  const SpringRest<Real> rest{0.8, 3};
  const Pair p{random_vector(random, 1), random_vector(random, 1), identity(), identity()};
  const Vector12 expected = -gradient([&](const Pair& at) { return spring_energy(rest, at.d()); }, p, 1e-4);
  const Vec3 f = spring_force(rest, p.d());
  EXPECT_LT((f - Vec3(expected.segment<3>(6))).norm(), 1e-9 * f.norm());
  EXPECT_LT((f + Vec3(expected.segment<3>(0))).norm(), 1e-9 * f.norm());
  EXPECT_LT(cross<Real>(f, p.d()).norm(), 1e-15 * f.norm() * p.d().norm());
  EXPECT_NEAR(spring_tension(rest, p.d()), -dot<Real>(f, p.d()) / p.d().norm(), 1e-14 * f.norm());
}

TEST(spring, its_stiffness_is_the_derivative_of_its_force) {
  Random random(2);
  const SpringRest<Real> rest{0.8, 3};
  const Pair p{Vec3(0, 0, 0), Vec3(0.7, -0.5, 0.3), identity(), identity()};
  struct Forces {
    Vec3 force, torque1, torque2;
  };
  const Matrix12 expected = -jacobian(
      [&](const Pair& at) {
        return generalised(Forces{spring_force(rest, at.d()), zero<Vec3>(), zero<Vec3>()});
      },
      p);
  EXPECT_LT((spring_stiffness(rest, p.d(), Slope::secant) - expected).norm(), 1e-9 * expected.norm());
}

// 90, 99 and 99.9 % overlap, and spacings that vary: the row of pearls has the stiffness E S / L of its
// fibre.
TEST(spring, a_row_of_any_spacing_has_the_stiffness_of_its_fibre) {
  const Real E = 86.9e9, R = 5e-6, S = std::numbers::pi * R * R;
  for (const Real overlap : {0., 0.9, 0.99, 0.999}) {
    Real length = 0, compliance = 0;
    for (int i = 0; i < 24; ++i) {
      const Real spacing = 2 * R * (1 - overlap) * (1 + 0.5 * std::sin(i));
      length += spacing;
      compliance += 1 / round_spring(spacing, E, R).axial;
    }
    EXPECT_NEAR(1 / compliance, E * S / length, 1e-13 * E * S / length) << overlap;
  }
}

// Why single precision is given what has changed since bonding, and not places.
TEST(spring, of_places_in_single_precision_ten_thousand_radii_away_does_not_feel_a_strain_of_a_millionth) {
  const auto rest = round_spring(2, 1, 0.5);
  const Real away = 1e4, other = away + 2 * (1 + 1e-6), expected = rest.axial * 2e-6;
  const Real between_places = static_cast<float>(other) - static_cast<float>(away);
  EXPECT_GT(std::abs(rest.axial * (between_places - rest.length) / expected - 1), 0.5);
  const Real changed = static_cast<float>(other - (away + 2));
  EXPECT_NEAR(rest.axial * changed, expected, 1e-5 * expected);
}

}  // namespace
}  // namespace beadwork
