// The three steps of filling, from the request to the report.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/parallel.hpp"
#include "core/base/random.hpp"
#include "core/domain/neighbours.hpp"
#include "core/packing/blocks.hpp"
#include "core/packing/crowd.hpp"
#include "core/packing/insertion.hpp"
#include "core/packing/packing.hpp"
#include "core/packing/projection.hpp"
#include "core/packing/report.hpp"
#include "core/packing/settle.hpp"
#include "tests/support/packings.hpp"

namespace beadwork::packing {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::Ge;
using ::testing::HasSubstr;
using ::testing::Le;
using ::testing::SizeIs;

/// One packing for all tests that only look at it.
const Packing& example() {
  static const Packing packing = filled(cube(3000));
  return packing;
}

Real deepest_overlap(const Packing& p, const std::vector<Vec3>& x, const std::vector<Real>& r, std::size_t moving) {
  Real deepest = 0;
  for (const Pair& pair : find_pairs_around(x, r, moving)) {
    const auto i = std::size_t(pair.i), j = std::size_t(pair.j);
    deepest = std::max(deepest, 1 - (x[j] - x[i]).norm() / (r[i] + r[j]));
  }
  const Walls walls(p.region);
  for (std::size_t i = 0; i < moving; ++i) deepest = std::max(deepest, 1 - walls.distance(x[i]) / r[i]);
  return deepest;
}

Real deepest_overlap(const Packing& p) { return deepest_overlap(p, p.position, p.radius, p.position.size()); }

std::size_t alike(const Packing& a, const Packing& b) {
  std::size_t same = 0;
  for (std::size_t i = 0; i < std::min(a.position.size(), b.position.size()); ++i)
    same += a.position[i] == b.position[i] && a.radius[i] == b.radius[i];
  return same;
}

// --- what the steps promise

TEST(Packing, three_steps_reach_the_coordination_number_without_overlap_and_inside_the_box) {
  const Packing& p = example();
  EXPECT_THAT(p.position, SizeIs(3000));
  EXPECT_LE(deepest_overlap(p), 1e-7);
  const Real contacts = 2.0 * Real(find_pairs(p.position, p.radius, 1e-3).size()) / 3000;
  EXPECT_GE(contacts, 6.2);
  EXPECT_LE(contacts, 6.4);
  EXPECT_TRUE(p.warnings.empty());
}

TEST(Packing, is_isotropic_and_dense_in_the_bulk) {
  const PackingReport r = report(example());
  EXPECT_THAT(r.fabric_bulk, Each(AllOf(Ge(1.0 / 3 - 0.01), Le(1.0 / 3 + 0.01))));
  EXPECT_GE(r.density_bulk, 0.62);
  EXPECT_LE(r.density_bulk, 0.66);
  EXPECT_LT(r.crystalline_share, 0.01);
}

TEST(Packing, keeps_the_radii_in_the_range_and_law_that_were_asked) {
  const Packing& p = example();
  const PackingReport r = report(p);
  EXPECT_GE(r.min_radius / r.mean_radius, 0.75 - 1e-3);
  EXPECT_LE(r.max_radius / r.mean_radius, 1.25 + 1e-3);
  // Kolmogorov's limit at the 5 % level for 3000 radii.
  EXPECT_LT(r.kolmogorov, 1.36 / std::sqrt(3000.0));
  Dispersion narrower = p.dispersion;
  narrower.spread = 0.2;
  EXPECT_GT(kolmogorov_distance(narrower, p.radius), 0.05) << "the distance must tell one law from another";
}

TEST(Packing, fills_a_cylinder_in_any_direction) {
  Request request = cube(1500);
  const Vec3 axis = Vec3(1, 2, 3).normalized();
  request.region = Cylinder{{5, 5, 5}, Vec3(5, 5, 5) + 3 * axis, 1};
  const Packing p = filled(request);
  EXPECT_THAT(p.position, SizeIs(1500));
  EXPECT_LE(deepest_overlap(p), 1e-7);
  for (std::size_t i = 0; i < p.position.size(); ++i) {
    const Vec3 arm = p.position[i] - Vec3(5, 5, 5);
    const Real along = arm.dot(axis);
    ASSERT_LE((arm - along * axis).norm() + p.radius[i], 1 + 1e-7);
    ASSERT_GE(along - p.radius[i], -1e-7);
    ASSERT_LE(along + p.radius[i], 3 + 1e-7);
  }
  EXPECT_GE(report(p).near.all, 6.2);
}

TEST(Packing, leaves_obstacles_alone_and_does_not_touch_them_deeper_than_allowed) {
  Request request = cube(1200);
  for (int k = 0; k < 25; ++k) {
    request.around.position.push_back({0.5, 0.5, (k + 0.5) / 25});
    request.around.radius.push_back(0.18);
  }
  Packing p = free_filling(request);
  const auto with_obstacles = [](auto all, const auto& obstacles) {
    all.insert(all.end(), obstacles.begin(), obstacles.end());
    return all;
  };
  EXPECT_EQ(deepest_overlap(p, with_obstacles(p.position, p.around.position), with_obstacles(p.radius, p.around.radius),
                            p.position.size()),
            0);
  forced_filling(p);
  relaxation(p);
  const auto x = with_obstacles(p.position, p.around.position);
  const auto r = with_obstacles(p.radius, p.around.radius);
  EXPECT_EQ(p.around.position, request.around.position);
  EXPECT_THAT(p.position, SizeIs(1200));
  EXPECT_LE(deepest_overlap(p, x, r, 1200), 1e-7);
  std::size_t touching = 0;
  for (const Pair& pair : find_pairs_around(x, r, 1200, 1e-6)) touching += pair.j >= 1200;
  EXPECT_GT(touching, 50u) << "elements rest against the obstacles";
}

TEST(Packing, draws_truncated_gaussian_radii) {
  Request request = cube(1000);
  request.dispersion = {RadiusLaw::truncated_gaussian, 0.3, 0.1};
  const Packing p = filled(request);
  EXPECT_LT(report(p).kolmogorov, 1.36 / std::sqrt(1000.0));
  EXPECT_GT(kolmogorov_distance({RadiusLaw::uniform, 0.3, 0}, p.radius), 0.1);
}

TEST(Packing, follows_from_a_mean_radius_as_well_as_from_a_count) {
  Request request = cube(1);
  request.count.reset();
  request.mean_radius = 0.05;
  const Packing p = filled(request);
  EXPECT_NEAR(report(p).mean_radius, 0.05, 0.02 * 0.05);
  EXPECT_GE(report(p).near.all, 6.2);
}

TEST(Packing, moves_radii_no_farther_than_relaxation_may) {
  Packing p = free_filling(cube(1000));
  forced_filling(p);
  const auto before = p.radius;
  relaxation(p, {.overlap = 1e-7, .radius_change = 0.02});
  Real mean = 0;
  for (std::size_t i = 0; i < before.size(); ++i) mean += p.radius[i] / before[i] / Real(before.size());
  for (std::size_t i = 0; i < before.size(); ++i) ASSERT_NEAR(p.radius[i] / before[i], mean, 0.021);
}

TEST(Packing, keeps_the_ratios_of_all_radii_if_told_to) {
  Packing p = free_filling(cube(600));
  forced_filling(p);
  const auto before = p.radius;
  relaxation(p, {.overlap = 1e-7, .radius_change = 0});
  EXPECT_LE(deepest_overlap(p), 1e-7);
  for (std::size_t i = 1; i < before.size(); ++i) ASSERT_NEAR(p.radius[i] / before[i], p.radius[0] / before[0], 1e-12);
  EXPECT_THAT(p.warnings, ::testing::Contains(HasSubstr("lowered the coordination number")));
}

/// A packing that could not be made before large elements were let grow in, and its neighbours.
struct Spread {
  RadiusLaw law;
  Real spread;
  bool box;
};

class PackingOfSpread : public ::testing::TestWithParam<Spread> {};

TEST_P(PackingOfSpread, is_packed_without_overlap_and_with_the_radii_of_its_law) {
  const Spread& asked = GetParam();
  Request request = cube(500);
  request.dispersion = {asked.law, asked.spread, 0.125};
  if (!asked.box) request.region = Cylinder{{0, 0, 0}, {0, 0, 2}, 0.5};
  const Packing p = filled(request);
  EXPECT_THAT(p.position, SizeIs(500));
  EXPECT_LE(deepest_overlap(p), 1e-7);
  const PackingReport r = report(p);
  EXPECT_LT(r.kolmogorov, 1.36 / std::sqrt(500.0));
  EXPECT_GT(r.near.without_rattlers, asked.spread > 0 ? 5.5 : 4.5)
      << "radii that are all alike cannot make room for contacts";
}

constexpr auto uniform = RadiusLaw::uniform, gaussian = RadiusLaw::truncated_gaussian;
INSTANTIATE_TEST_SUITE_P(Spreads, PackingOfSpread,
                         ::testing::Values(Spread{uniform, 0, true}, Spread{uniform, .35, true},
                                           Spread{uniform, .4, false}, Spread{uniform, .45, true},
                                           Spread{uniform, .5, true}, Spread{uniform, .5, false},
                                           Spread{uniform, .7, true}, Spread{uniform, .9, false},
                                           Spread{gaussian, .35, true}, Spread{gaussian, .45, false},
                                           Spread{gaussian, .5, true}, Spread{gaussian, .9, true}),
                         [](const auto& each) {
                           const Spread& s = each.param;
                           return std::string(s.law == uniform ? "uniform_" : "gaussian_") +
                                  std::to_string(std::lround(100 * s.spread)) + (s.box ? "_box" : "_cylinder");
                         });

TEST(Packing, lets_a_large_element_grow_in_among_small_ones) {
  // Small ones stand everywhere already: a hole for one three times as large there never is.
  Request request = cube(1500);
  request.dispersion.spread = 0.1;
  Packing p = free_filling(request);
  const Real R = p.radius[0];
  p.waiting.push_back(3 * R);
  forced_filling(p);
  EXPECT_THAT(p.position, SizeIs(1501));
  const Real largest = *std::max_element(p.radius.begin(), p.radius.end());
  EXPECT_NEAR(largest / p.radius[0], 3, 1e-9);
}

TEST(Packing, counts_contacts_in_the_bulk_if_told_to) {
  Packing p = free_filling(cube(2000));
  forced_filling(p, {.coordination = 6.6, .tolerance = 0.3, .bulk = true});
  const PackingReport r = report(p);
  EXPECT_GE(r.touching.bulk, 6.6);
  EXPECT_LE(r.touching.bulk, 6.64);
  EXPECT_LT(r.touching.all, 6);
  Packing few = free_filling(cube(30));
  EXPECT_THAT(message_of([&] { forced_filling(few, {.coordination = 6.2, .tolerance = 0.3, .bulk = true}); }),
              HasSubstr("no element is in the bulk"));
}

TEST(Packing, presses_the_bulk_as_balanced_radii_are_to_be) {
  Packing p = free_filling(cube(8000));
  forced_filling(p, {.bulk = true});
  std::vector<Real> pressing(p.position.size(), 0);  // overlaps over the diameter
  for (const Pair& pair : find_pairs_around(p.position, p.radius, p.position.size(), 0)) {
    const auto i = std::size_t(pair.i), j = std::size_t(pair.j);
    const Real overlap = p.radius[i] + p.radius[j] - (p.position[i] - p.position[j]).norm();
    pressing[i] += overlap / (2 * p.radius[i]);
    pressing[j] += overlap / (2 * p.radius[j]);
  }
  std::vector<Index> order;
  const std::vector<char> bulk = bulk_of(crowd_of(p, order));
  Real sum = 0, count = 0;
  for (std::size_t k = 0; k < order.size(); ++k)
    if (bulk[k]) sum += pressing[std::size_t(order[k])], ++count;
  EXPECT_GT(count, 4000);
  EXPECT_NEAR(sum / count, 0.012, 0.0006) << "wanted_pressing of balance.cpp";
}

TEST(Packing, ends_where_elements_just_hold_each_other_if_a_low_coordination_number_is_asked) {
  Packing p = free_filling(cube(1000));
  forced_filling(p, {.coordination = 1, .tolerance = 0.3});
  const PackingReport r = report(p);
  EXPECT_GT(r.touching.all, 4);
  EXPECT_LT(r.mean_overlap, 1e-3);
}

TEST(Packing, warns_that_equal_elements_crystallise) {
  Request request = cube(1000);
  request.dispersion.spread = 0;
  const Packing p = filled(request);
  EXPECT_LE(deepest_overlap(p), 1e-7);
  EXPECT_THAT(p.warnings, ::testing::Contains(AllOf(HasSubstr("crystal"), HasSubstr("%"))));
  EXPECT_GT(report(p).crystalline_share, 0.01);
}

// --- free filling alone

TEST(Packing, free_filling_ends_where_nothing_more_fits) {
  const Request request = cube(2000);
  const Packing p = free_filling(request);
  EXPECT_EQ(deepest_overlap(p), 0);
  EXPECT_EQ(p.position.size() + p.waiting.size(), 2000u);
  EXPECT_GT(p.waiting.size(), 500u);
  // Of many random places for the smallest element that waits, hardly one is free.
  const Real r = *std::min_element(p.waiting.begin(), p.waiting.end());
  Random random(99);
  int free_places = 0;
  for (int k = 0; k < 2000; ++k) {
    Vec3 unit;
    for (int a = 0; a < 3; ++a) unit[a] = random.uniform();
    const Vec3 x = point_in(request.region, unit, r);
    free_places += std::none_of(p.position.begin(), p.position.end(), [&](const Vec3& other) {
      return (other - x).norm() < r + p.radius[std::size_t(&other - p.position.data())];
    });
  }
  EXPECT_LE(free_places, 20);
}

TEST(Packing, free_filling_places_a_single_element) {
  const Packing p = free_filling(cube(1));
  ASSERT_THAT(p.position, SizeIs(1));
  EXPECT_EQ(deepest_overlap(p), 0);
}

// --- the same again

TEST(Packing, is_the_same_to_the_bit_with_any_number_of_threads) {
  // The parts that share their work, on enough elements that they do (blocks.hpp).
  Packing start = free_filling(cube(2 * worth_sharing));
  start.waiting.clear();
  ASSERT_GT(start.position.size(), worth_sharing);
  const auto run = [&start](int threads) {
    use_threads(threads);
    Packing p = start;
    std::vector<Index> order;
    Crowd crowd = crowd_of(p, order);
    Neighbours neighbours(0.35);
    scale_radii(crowd, 1.16);
    settle(crowd, neighbours, 60, 0);
    project(crowd, neighbours, {0.75, 1.25, 0.05}, 1e-2);
    put_back(crowd, order, p);
    return p;
  };
  const Packing alone = run(1), together = run(2), three = run(3);
  use_threads(2);
  EXPECT_EQ(alike(alone, start), 0u);
  EXPECT_EQ(alike(alone, together), start.position.size());
  EXPECT_EQ(alike(alone, three), start.position.size());
}

TEST(Packing, is_the_same_from_run_to_run_and_another_with_another_seed) {
  const Packing first = filled(cube(400, 7)), again = filled(cube(400, 7)), other = filled(cube(400, 8));
  EXPECT_EQ(alike(first, again), 400u);
  EXPECT_EQ(alike(first, other), 0u);
}

TEST(Packing, does_not_depend_on_the_unit_of_length) {
  Request small = cube(500);
  small.region = Box{{0, 0, 0}, {1e-6, 1e-6, 1e-6}};
  const PackingReport a = report(filled(cube(500))), b = report(filled(small));
  EXPECT_NEAR(a.mean_radius * 1e-6, b.mean_radius, 1e-3 * b.mean_radius);
  EXPECT_LE(b.max_overlap, 1e-7);
  EXPECT_GE(b.near.all, 6.2);
}

// --- the report, on arrangements whose figures are known

/// Spheres that touch on a face-centred cubic lattice.
Packing face_centred_cubic(int cells) {
  std::vector<Vec3> position;
  const Real a = std::sqrt(8.0);  // edge of the cell for radius 1
  for (int x = 0; x < cells; ++x)
    for (int y = 0; y < cells; ++y)
      for (int z = 0; z < cells; ++z)
        for (const Vec3& base : {Vec3(0, 0, 0), Vec3(0, .5, .5), Vec3(.5, 0, .5), Vec3(.5, .5, 0)})
          position.push_back(a * (Vec3(x, y, z) + base));
  const Vec3 edge = Vec3::Constant(a * cells);
  const Vec3 shift = Vec3::Constant(-a / 4);  // the lattice in the middle of its box
  std::vector<Real> radius(position.size(), 1);
  return packing_of(Box{shift, edge + shift}, {RadiusLaw::uniform, 0, 0}, std::move(position), std::move(radius));
}

TEST(PackingReport, knows_a_face_centred_cubic_crystal) {
  const PackingReport r = report(face_centred_cubic(8));
  EXPECT_NEAR(r.touching.bulk, 12, 1e-9);
  EXPECT_NEAR(r.near.bulk, 12, 1e-9);
  EXPECT_GT(r.bulk_count, 100u);
  EXPECT_NEAR(r.density, std::numbers::pi / std::sqrt(18.0), 1e-9);  // Gauss
  EXPECT_NEAR(r.density_bulk, std::numbers::pi / std::sqrt(18.0), 0.005);
  for (const Real value : r.fabric_bulk) EXPECT_NEAR(value, 1.0 / 3, 1e-9);
  EXPECT_GT(r.crystalline_share, 0.9);
  EXPECT_GT(r.bond_order, 0.9);
}

TEST(PackingReport, counts_without_rattlers_and_without_those_that_rattle_when_these_are_gone) {
  // A chain of three spheres in a wide box holds nobody: each link is loose once its end is.
  const Packing chain = packing_of(Box{{-9, -9, -9}, {9, 9, 9}}, {}, {{0, 0, 0}, {2, 0, 0}, {4, 0, 0}}, {1, 1, 1});
  const PackingReport r = report(chain);
  EXPECT_NEAR(r.touching.all, 4.0 / 3, 1e-12);
  EXPECT_EQ(r.touching.without_rattlers, 0);
  EXPECT_EQ(r.rattlers, 1);
  EXPECT_GT(report(example()).near.without_rattlers, report(example()).near.all);
}

TEST(PackingReport, tells_touching_contacts_from_near_ones_and_measures_overlap) {
  const Packing p = packing_of(Box{{-9, -9, -9}, {9, 9, 9}}, {}, {{0, 0, 0}, {2.001, 0, 0}, {0, 1.9, 0}}, {1, 1, 1});
  const PackingReport r = report(p, 1e-3);
  EXPECT_NEAR(r.touching.all, 2.0 / 3, 1e-12);
  EXPECT_NEAR(r.near.all, 4.0 / 3, 1e-12);
  EXPECT_NEAR(r.max_overlap, 0.05, 1e-12);
  EXPECT_NEAR(r.mean_overlap, 0.05, 1e-12);
  EXPECT_NEAR(r.fabric[2], 0.5, 1e-6);
}

TEST(PackingReport, tells_the_seconds_that_the_packing_took) {
  Packing p = packing_of(Box{{-9, -9, -9}, {9, 9, 9}}, {}, {{0, 0, 0}}, {1});
  p.seconds = 2.5;
  EXPECT_EQ(report(p).seconds, 2.5);
}

TEST(PackingReport, has_a_histogram_that_holds_every_element) {
  const PackingReport r = report(example());
  EXPECT_EQ(r.histogram.size() + 1, r.histogram_edges.size());
  std::size_t sum = 0;
  for (const std::size_t n : r.histogram) sum += n;
  EXPECT_EQ(sum, 3000u);
  EXPECT_EQ(r.count, 3000u);
  EXPECT_EQ(r.seed, 1u);
}

}  // namespace
}  // namespace beadwork::packing
