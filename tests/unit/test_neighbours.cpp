// Neighbour search and space-filling order against what a plain double loop finds.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "core/base/parallel.hpp"
#include "core/base/random.hpp"
#include "core/domain/neighbours.hpp"
#include "core/domain/order.hpp"
#include "core/domain/reach.hpp"

namespace beadwork {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

struct Cloud {
  std::vector<Vec3> position;
  std::vector<Real> radius;
};

Vec3 random_point(Random& random, Real size) {
  Vec3 x;
  for (int a = 0; a < 3; ++a) x[a] = random.uniform(0, size);
  return x;
}

Cloud cloud(std::size_t count, Real size, Real smallest, Real largest, std::uint64_t seed) {
  Random random(seed);
  Cloud c;
  for (std::size_t k = 0; k < count; ++k) {
    c.position.push_back(random_point(random, size));
    // Evenly over the orders of magnitude, so that every size meets every other.
    c.radius.push_back(smallest * std::pow(largest / smallest, random.uniform()));
  }
  return c;
}

std::vector<Pair> all_against_all(const Cloud& c, Real tolerance, Real gap, std::size_t moving) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < c.position.size(); ++i)
    for (std::size_t j = i + 1; j < c.position.size(); ++j) {
      const Real reach = (1 + tolerance) * (c.radius[i] + c.radius[j]) + gap;
      if (i < moving && (c.position[j] - c.position[i]).squaredNorm() <= reach * reach)
        pairs.push_back({Index(i), Index(j)});
    }
  return pairs;
}

std::string message_of(const Cloud& c) {
  try {
    find_pairs(c.position, c.radius);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "nothing was thrown";
}

TEST(Neighbours, finds_the_pairs_that_a_double_loop_finds) {
  const Cloud c = cloud(2000, 10, 0.3, 0.5, 1);
  for (const Real tolerance : {0.0, 1e-3, 0.5}) {
    const auto pairs = find_pairs(c.position, c.radius, tolerance);
    EXPECT_GT(pairs.size(), 1000u);
    EXPECT_EQ(pairs, all_against_all(c, tolerance, 0, c.position.size())) << tolerance;
  }
  EXPECT_EQ(find_pairs(c.position, c.radius, 0.1, 0.3), all_against_all(c, 0.1, 0.3, c.position.size()));
}

TEST(Neighbours, finds_all_pairs_when_radii_differ_a_hundredfold) {
  const Cloud c = cloud(3000, 20, 0.02, 2, 2);
  const auto pairs = find_pairs(c.position, c.radius, 0.01);
  EXPECT_EQ(pairs, all_against_all(c, 0.01, 0, c.position.size()));
  Real largest_ratio = 1;
  for (const Pair& p : pairs)
    largest_ratio = std::max(largest_ratio, c.radius[std::size_t(p.i)] / c.radius[std::size_t(p.j)]);
  EXPECT_GT(largest_ratio, 50) << "the cloud has to hold pairs of very different size";
}

TEST(Neighbours, finds_elements_that_just_touch_on_a_lattice) {
  Cloud c;
  for (int x = 0; x < 8; ++x)
    for (int y = 0; y < 8; ++y)
      for (int z = 0; z < 8; ++z) c.position.push_back({2.0 * x, 2.0 * y, 2.0 * z});
  c.radius.assign(c.position.size(), 1.0);
  EXPECT_EQ(find_pairs(c.position, c.radius).size(), 3u * 7 * 8 * 8);
}

TEST(Neighbours, leaves_out_pairs_of_two_obstacles) {
  const Cloud c = cloud(800, 5, 0.1, 1, 3);
  for (const std::size_t moving : {0u, 300u, 800u})
    EXPECT_EQ(find_pairs_around(c.position, c.radius, moving, 0.1, 0.05), all_against_all(c, 0.1, 0.05, moving));
}

TEST(Neighbours, is_not_slowed_down_by_one_element_far_away) {
  // If the cells grew with the extent, all elements but one would share a cell: 10^10 distances, minutes.
  Cloud c = cloud(100000, 40, 0.3, 0.5, 4);
  const auto without = find_pairs(c.position, c.radius);
  c.position.push_back({1e9, -1e9, 1e9});
  c.radius.push_back(0.4);
  EXPECT_EQ(find_pairs(c.position, c.radius), without);
}

TEST(Neighbours, finds_coincident_centres_and_points_without_size) {
  const Cloud c{{{1, 2, 3}, {4, 4, 4}, {1, 2, 3}}, {0, 0, 0}};
  EXPECT_EQ(find_pairs(c.position, c.radius), (std::vector<Pair>{{0, 2}}));
}

TEST(Neighbours, takes_an_empty_cloud_and_a_single_element) {
  EXPECT_TRUE(find_pairs({}, {}).empty());
  const Cloud c{{{1, 2, 3}}, {1}};
  EXPECT_TRUE(find_pairs(c.position, c.radius).empty());
}

TEST(Neighbours, gives_the_same_list_for_any_number_of_threads) {
  const Cloud c = cloud(60000, 40, 0.3, 0.6, 5);
  use_threads(1);
  const auto alone = find_pairs(c.position, c.radius, 0.1);
  use_threads(3);
  const auto together = find_pairs(c.position, c.radius, 0.1);
  use_threads(2);
  EXPECT_EQ(alone, together);
}

TEST(Neighbours, names_the_element_that_is_not_finite) {
  const Real nan = std::numeric_limits<Real>::quiet_NaN(), infinity = std::numeric_limits<Real>::infinity();
  EXPECT_THAT(message_of({{{0, 0, 0}, {0, nan, 0}}, {1, 1}}), HasSubstr("position of element 1 is not finite"));
  EXPECT_THAT(message_of({{{infinity, 0, 0}, {0, 0, 0}}, {1, 1}}), HasSubstr("position of element 0"));
  EXPECT_THAT(message_of({{{0, 0, 0}, {0, 0, 0}}, {1, nan}}), HasSubstr("radius of element 1"));
  EXPECT_THAT(message_of({{{0, 0, 0}, {0, 0, 0}}, {-1, 1}}), HasSubstr("radius of element 0 is negative"));
  EXPECT_THAT(message_of({{{0, 0, 0}}, {1, 1}}), HasSubstr("1 positions but 2 radii"));
  EXPECT_THAT(message_of({{{-1.7e308, 0, 0}, {1.7e308, 0, 0}}, {1, 1}}), HasSubstr("too far apart"));
}

TEST(Neighbours, lists_the_neighbours_of_each_element_both_ways_and_in_order) {
  const std::vector<Pair> pairs{{0, 2}, {0, 3}, {1, 3}, {2, 3}};
  const NeighbourList list = neighbours_of(pairs, 5);
  EXPECT_THAT(list.of(0), ::testing::ElementsAre(2, 3));
  EXPECT_THAT(list.of(1), ::testing::ElementsAre(3));
  EXPECT_THAT(list.of(3), ::testing::ElementsAre(0, 1, 2));
  EXPECT_TRUE(list.of(4).empty());
}

TEST(HilbertOrder, visits_every_point_once_and_neighbours_one_after_another) {
  // A grid of 16^3 points: along a Hilbert curve each step leads to a grid neighbour.
  std::vector<Vec3> position;
  for (int k = 0; k < 16 * 16 * 16; ++k) position.push_back({Real(k % 16), Real(k / 16 % 16), Real(k / 256)});
  const auto order = hilbert_order(position);
  std::vector<Index> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  std::vector<Index> every(position.size());
  std::iota(every.begin(), every.end(), 0);
  EXPECT_EQ(sorted, every);
  for (std::size_t k = 1; k < order.size(); ++k)
    ASSERT_DOUBLE_EQ((position[std::size_t(order[k])] - position[std::size_t(order[k - 1])]).norm(), 1) << k;
}

TEST(HilbertOrder, keeps_the_order_of_coincident_points_and_refuses_what_is_not_finite) {
  EXPECT_EQ(hilbert_order(std::vector<Vec3>(3, Vec3(1, 1, 1))), (std::vector<Index>{0, 1, 2}));
  EXPECT_TRUE(hilbert_order({}).empty());
  EXPECT_THROW(hilbert_order(std::vector<Vec3>{{0, 0, 0}, {0, std::nan(""), 0}}), std::invalid_argument);
}

TEST(Neighbours, of_a_heap_are_refused_before_they_are_looked_for) {
  Cloud c;
  c.position.assign(40000, Vec3(1, 1, 1));
  c.radius.assign(40000, 1e-3);
  c.position.push_back({0, 0, 0});
  c.radius.push_back(1e-3);
  EXPECT_THAT(message_of(c), AllOf(HasSubstr("so close together"), HasSubstr("about 799980000 pairs")));
}

TEST(Neighbours, search_can_be_interrupted) {
  const Cloud c = cloud(100, 1, .01, .1, 1);
  struct Stop {};
  EXPECT_THROW(find_pairs(c.position, c.radius, 0, 0, [] { throw Stop{}; }), Stop);
}

// --- pairs that reach over a third element

std::vector<Pair> next_only(const Cloud& c, const std::vector<Pair>& pairs) {
  const std::vector<Index> between = elements_between(c.position, c.radius, pairs);
  std::vector<Pair> next;
  for (std::size_t p = 0; p < pairs.size(); ++p)
    if (between[p] < 0) next.push_back(pairs[p]);
  return next;
}

TEST(Reach, a_row_of_overlapping_elements_is_left_with_its_next_neighbours) {
  Cloud row;
  std::vector<Pair> expected;
  for (int k = 0; k < 25; ++k) {
    row.position.push_back({0.2 * k, 0.02 * (k % 2), 0});  // a little crooked
    row.radius.push_back(k % 3 == 0 ? 1.1 : 1);
    if (k > 0) expected.push_back({Index(k - 1), Index(k)});
  }
  const auto pairs = find_pairs(row.position, row.radius);
  EXPECT_GT(pairs.size(), 150u);
  EXPECT_EQ(next_only(row, pairs), expected);
}

TEST(Reach, a_wide_gap_reaches_over_the_elements_of_a_lattice) {
  Cloud lattice;
  for (int x = 0; x < 5; ++x)
    for (int y = 0; y < 5; ++y) {
      lattice.position.push_back({2.0 * x, 2.0 * y, 0});
      lattice.radius.push_back(1);
    }
  const auto wide = find_pairs(lattice.position, lattice.radius, 1.01);  // up to the second along a row
  const auto touching_and_across = find_pairs(lattice.position, lattice.radius, 0.5);
  EXPECT_EQ(next_only(lattice, wide), touching_and_across);
}

TEST(Reach, elements_that_touch_have_nothing_between_them_however_small_those_beside) {
  // Three of radius 1 touch one another; the fourth sits in the hole between them and touches all.
  const Real side = 2 / std::sqrt(3.0);
  Cloud c;
  for (int k = 0; k < 3; ++k) {
    const Real angle = 2 * std::numbers::pi * k / 3;
    c.position.push_back({side * std::cos(angle), side * std::sin(angle), 0});
    c.radius.push_back(1);
  }
  c.position.push_back({0, 0, 0});
  c.radius.push_back(side - 1);
  const auto pairs = find_pairs(c.position, c.radius, 1e-9);
  EXPECT_EQ(pairs.size(), 6u);
  EXPECT_EQ(next_only(c, pairs), pairs);
}

}  // namespace
}  // namespace beadwork
