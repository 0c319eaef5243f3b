// Fibres: where they are placed, what is listed of them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "core/domain/domain.hpp"
#include "core/packing/insertion.hpp"
#include "core/packing/packing.hpp"
#include "core/packing/parallel_discs.hpp"
#include "core/packing/report.hpp"
#include "tests/support/packings.hpp"

namespace beadwork {
namespace {

using packing::Discs;
using packing::message_of;
using packing::Place;
using packing::place_discs;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// Discs of diameter 1 in a square of that side.
Discs in_square(std::size_t count, Real side) {
  return {.low = Place(0.5, 0.5), .high = Place(side - 0.5, side - 0.5), .distance = 1, .count = count};
}

Real nearest_two(const std::vector<Place>& places) {
  Real least = std::numeric_limits<Real>::infinity();
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) least = std::min(least, (places[i] - places[j]).norm());
  return least;
}

TEST(Fibres, stand_no_nearer_than_asked_and_inside_up_to_a_volume_fraction_of_six_tenths) {
  for (const Real fraction : {0.1, 0.3, 0.5, 0.6}) {
    const Real side = 12;
    const auto count = static_cast<std::size_t>(fraction * side * side / (std::numbers::pi / 4));
    const auto places = place_discs(in_square(count, side));
    ASSERT_EQ(places.size(), count);
    EXPECT_GE(nearest_two(places), 1 - 1e-12) << fraction;
    for (const Place& x : places) {
      EXPECT_GE(x.minCoeff(), 0.5);
      EXPECT_LE(x.maxCoeff(), side - 0.5);
    }
  }
}

TEST(Fibres, stand_at_places_that_their_seed_alone_decides) {
  Discs discs = in_square(40, 10);
  const auto first = place_discs(discs), again = place_discs(discs);
  EXPECT_EQ(first, again);
  discs.seed = 2;
  EXPECT_NE(first, place_discs(discs));
}

// Where they are sparse every place is as likely: the mean of the centres and of their squares are those of the square.
TEST(Fibres, are_spread_evenly_where_there_is_room) {
  Place mean = Place::Zero(), square = Place::Zero();
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Discs discs{.low = {0, 0}, .high = {1, 1}, .distance = 0.05, .count = 10, .seed = seed};
    for (const Place& x : place_discs(discs)) {
      mean += x;
      square += x.cwiseProduct(x);
      ++count;
    }
  }
  for (int axis = 0; axis < 2; ++axis) {
    EXPECT_NEAR(mean[axis] / count, 0.5, 0.02);        // 2000 numbers: standard error .0065
    EXPECT_NEAR(square[axis] / count, 1.0 / 3, 0.02);  // .0067
  }
}

TEST(Fibres, that_do_not_fit_are_refused_with_what_does) {
  // beyond the densest packing there is, pi / sqrt(12) of the room
  EXPECT_THAT(message_of([] { place_discs(in_square(200, 12)); }),
              AllOf(HasSubstr("do not fit"), HasSubstr(" do; ask for so many")));
  const std::string message = message_of([] { place_discs(in_square(40, 6)); });
  const auto fit = static_cast<std::size_t>(std::stoi(message.substr(message.find("do not fit: ") + 12)));
  EXPECT_EQ(place_discs(in_square(fit, 6)).size(), fit) << message;
  EXPECT_GT(fit, 20u);
  Discs thin = in_square(3, 12);
  thin.high[0] = 0.4;
  EXPECT_THAT(message_of([&] { place_discs(thin); }), HasSubstr("too narrow"));
}

using packing::Ball;
using packing::InsertionGrid;

TEST(Crevices, are_reached_by_elements_that_fit_in_and_by_no_others) {
  InsertionGrid grid(packing::Box{{-2, -2, -2}, {2, 2, 2}}, 1);
  grid.add_obstacle({{-1.15, 0, 0}, 1});
  grid.add_obstacle({{1.15, 0, 0}, 1});  // 0.3 between their surfaces
  EXPECT_TRUE(grid.reachable({0, 0, 0}, 0.14));
  EXPECT_FALSE(grid.reachable({0, 0, 0}, 0.2));
  EXPECT_FALSE(grid.reachable({0.1, 0, 0}, 0.2));
  EXPECT_TRUE(grid.reachable({0, 0.9, 0}, 0.2)) << "where the two have curved away";
  EXPECT_TRUE(grid.reachable({-0.5, 0.8, 0}, 0.2)) << "at the surface of one";
  EXPECT_LE(grid.clearance(Ball{{0, 0, 0}, 0.2}, -0.5), -1) << "a quarter of its radius into either";
  EXPECT_GE(grid.clearance(Ball{{0, 0, 0}, 0.155}, -0.5), -0.1) << "a thirtieth";
}

/// Two columns nearer to one another than an element is wide.
packing::Packing around_two_columns() {
  packing::Request request = packing::cube(1500);
  for (int k = 0; k < 20; ++k)
    for (const Real y : {0.32, 0.68}) {
      request.around.position.push_back({0.5, y, (k + 0.5) / 20});
      request.around.radius.push_back(0.16);
    }
  return packing::filled(request, {.bulk = true});
}

TEST(Crevices, do_not_make_all_elements_shrink_nor_are_they_filled) {
  const packing::Packing p = around_two_columns();
  const packing::PackingReport r = packing::report(p);
  EXPECT_EQ(r.count, 1500u);
  EXPECT_EQ(r.around.inside, 0u);
  EXPECT_LE(r.max_overlap, 1e-7);
  EXPECT_GE(r.near.bulk, 6.1);
  EXPECT_GE(r.density_bulk, 0.6);
  EXPECT_GE(r.min_radius, 0.6 * r.mean_radius) << "what is lodged is small, but not tiny";
  EXPECT_GT(r.around.touching, 100u);
}

/// Twelve fibres, two fifths of the section, in a slice with as many elements of resin as section 5 of the paper has.
packing::Packing among_fibres(bool balanced) {
  constexpr Real side = 48, depth = 30, radius = 5;
  constexpr int beads = 6;
  packing::Request request;
  request.region = packing::Box{{0, 0, 0}, {side, side, depth}};
  request.count = 840;
  request.seed = 1;
  const Discs discs{.low = Place(6, 6), .high = Place(side - 6, side - 6), .distance = 2 * radius + 1, .count = 12};
  for (const Place& place : place_discs(discs))
    for (int k = 0; k < beads; ++k) {
      request.around.position.push_back({place[0], place[1], (k + 0.5) * depth / beads});
      request.around.radius.push_back(radius);
    }
  return packing::filled(request, {.coordination = 4.5, .balanced = balanced});
}

TEST(Crevices, hold_their_elements_where_radii_are_balanced) {
  const packing::PackingReport drawn = packing::report(among_fibres(false));
  const packing::PackingReport balanced = packing::report(among_fibres(true));
  EXPECT_GT(drawn.rattlers, 0.3) << "one factor for all leaves rooms between fibres loose";
  EXPECT_LT(balanced.rattlers, 0.05);
  EXPECT_GT(balanced.near.all, drawn.near.all + 1);
  EXPECT_GT(balanced.density, drawn.density);
  EXPECT_LE(balanced.max_overlap, 1e-7);
  EXPECT_LE(balanced.max_radius, 1.3 * balanced.mean_radius) << "the law's 1.25, and what relaxation may add";
  EXPECT_LT(balanced.kolmogorov, 0.1) << "and the radii are still those of the law";
}

TEST(PairLists, follow_their_elements_when_rows_change_places) {
  Domain domain;
  domain.add_elements(4);
  domain.pairs()["fibre"] = {{0, 1}, {1, 2}};
  domain.reorder({3, 2, 1, 0});
  EXPECT_EQ(domain.pairs().at("fibre"), (PairList{{1, 2}, {2, 3}}));
}

TEST(PairLists, join_elements_to_chains_and_leave_the_others_alone) {
  Domain domain;
  domain.add_elements(6);
  EXPECT_TRUE(chains(domain).empty());
  domain.pairs()["one"] = {{0, 2}, {2, 4}};
  domain.pairs()["other"] = {{1, 5}};
  EXPECT_EQ(chains(domain), (std::vector<Index>{0, 1, 0, -1, 0, 1}));
}

}  // namespace
}  // namespace beadwork
