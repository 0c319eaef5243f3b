#include "core/mechanics/response.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/mechanics/bonded_packing.hpp"

namespace beadwork {
namespace {

using ::testing::DoubleNear;
using ::testing::Optional;

Response made_up(const std::vector<Real>& places, const std::function<Real(Real)>& law) {
  Response response;
  for (const Real place : places) response.note(place, law(place));
  return response;
}

TEST(Response, of_a_straight_line_is_the_line) {
  const Response line = made_up({0.1, 0.3, 0.9}, [](Real r) { return 0.5 - 0.4 * r; });
  EXPECT_NEAR(line.at(0.2), 0.42, 1e-14);
  EXPECT_NEAR(line.at(0.75), 0.2, 1e-14);
  EXPECT_THAT(line.where(0.2), Optional(DoubleNear(0.75, 1e-12)));
}

TEST(Response, is_found_backwards_where_it_falls_as_where_it_rises) {
  const std::vector<Real> places{0.1, 0.15, 0.2, 0.3, 0.4, 0.55, 0.7, 0.9};
  const auto falls = [](Real r) { return 0.45 / (1 + 2 * r * r); };
  const auto rises = [](Real r) { return r * r; };
  for (const Real there : {0.12, 0.33, 0.62, 0.85}) {
    EXPECT_THAT(made_up(places, falls).where(falls(there)), Optional(DoubleNear(there, 0.006)));
    EXPECT_THAT(made_up(places, rises).where(rises(there)), Optional(DoubleNear(there, 0.006)));
  }
}

// Cubics through such points overshoot unless their slopes are bounded.
TEST(Response, that_falls_from_point_to_point_falls_between_them) {
  Response steps;
  const std::vector<Real> values{0.4, 0.399, 0.2, 0.1995, 0.199, 0.01};
  for (std::size_t k = 0; k < values.size(); ++k) steps.note(static_cast<Real>(k), values[k]);
  for (Real r = 0.01; r <= 5; r += 0.01) EXPECT_LE(steps.at(r), steps.at(r - 0.01) + 1e-15) << r;
}

TEST(Response, does_not_go_beyond_what_was_measured) {
  const Response response = made_up({0.1, 0.5, 0.9}, [](Real r) { return 0.5 - 0.4 * r; });
  EXPECT_FALSE(response.where(0.6));
  EXPECT_FALSE(response.where(0.05));
  EXPECT_DOUBLE_EQ(response.range().low, 0.14);
  EXPECT_DOUBLE_EQ(response.range().high, 0.46);
  EXPECT_FALSE(Response().where(0.3));
}

TEST(Response, of_points_that_scatter_is_read_at_the_first_place_that_has_the_value) {
  Response noisy;
  for (const auto& [place, value] : std::map<Real, Real>{{1, 0.4}, {2, 0.3}, {3, 0.32}, {4, 0.2}})
    noisy.note(place, value);
  EXPECT_THAT(noisy.where(0.35), Optional(DoubleNear(1.5, 0.1)));
  EXPECT_LT(*noisy.where(0.31), 2);
}

TEST(Scatter, is_that_of_a_sample) {
  const Scatter spread = scatter_of({1, 2, 3, 4});
  EXPECT_DOUBLE_EQ(spread.mean, 2.5);
  EXPECT_DOUBLE_EQ(spread.deviation, std::sqrt(5. / 3));
  EXPECT_EQ(scatter_of({7}).deviation, 0);
}

// Derived: K7 of both of the paper's materials, with Z = 6.2 and phi = 0.64.
TEST(BondedPacking, has_the_stiffness_of_the_closed_form) {
  EXPECT_NEAR(stiffness_ratio({6.2, 0.64, 0.49}, 0.24), 0.12385, 1e-5);
  EXPECT_NEAR(stiffness_ratio({6.2, 0.64, 0.19}, 0.37), 0.009311, 1e-6);
}

}  // namespace
}  // namespace beadwork
