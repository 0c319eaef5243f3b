// What filling refuses, gives up or can be stopped in, and what it says then.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/packing/insertion.hpp"
#include "core/packing/report.hpp"
#include "tests/support/packings.hpp"

namespace beadwork::packing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(Packing, refuses_a_count_and_a_radius_together_and_says_what_they_mean) {
  Request request = cube(1000);
  request.mean_radius = std::cbrt(0.9 / (1000 * 4.0 / 3 * std::numbers::pi * 1.0625));  // volume fraction 0.9
  EXPECT_THAT(message_of([&] { free_filling(request); }),
              AllOf(HasSubstr("volume fraction of 0.9"), HasSubstr("give one of the two")));
  request.count.reset();
  request.mean_radius.reset();
  EXPECT_THAT(message_of([&] { free_filling(request); }), HasSubstr("neither the count nor the mean radius"));
}

TEST(Packing, refuses_requests_that_make_no_sense) {
  const auto message = [](auto change) {
    Request request = cube(100);
    change(request);
    return message_of([&] { free_filling(request); });
  };
  EXPECT_THAT(message([](Request& q) { q.count = 0; }), HasSubstr("count of elements must be at least 1"));
  EXPECT_THAT(message([](Request& q) { q.count = 2'000'000'000; }), HasSubstr("at most 134217727"));
  EXPECT_THAT(message([](Request& q) { q.dispersion.spread = 1; }), HasSubstr("spread of the radii"));
  EXPECT_THAT(message([](Request& q) { q.dispersion.spread = -0.1; }), HasSubstr("spread of the radii"));
  EXPECT_THAT(message([](Request& q) {
                q.dispersion = {RadiusLaw::truncated_gaussian, 0.2, 0};
              }),
              HasSubstr("standard deviation"));
  EXPECT_THAT(message([](Request& q) {
                q.region = Box{{0, 0, 0}, {1, 0, 1}};
              }),
              HasSubstr("box to be filled is empty"));
  EXPECT_THAT(message([](Request& q) { q.region = Cylinder{{0, 0, 0}, {0, 0, 0}, 1}; }), HasSubstr("cylinder"));
  EXPECT_THAT(message([](Request& q) { q.tries = 0; }), HasSubstr("number of tries"));
  EXPECT_THAT(message([](Request& q) { q.around = {{{0, std::nan(""), 0}}, {1}}; }), HasSubstr("obstacle 0"));
  const auto with_radius = [&](Real R) {
    return message([R](Request& q) {
      q.count.reset();
      q.mean_radius = R;
    });
  };
  EXPECT_THAT(with_radius(2), AllOf(HasSubstr("do not fit"), HasSubstr("at most 0.4")));
  EXPECT_THAT(with_radius(-1), HasSubstr("mean radius must be positive"));
  EXPECT_THAT(with_radius(1e-6), HasSubstr("at most 134217727 are possible"));
}

TEST(Packing, refuses_at_once_what_no_machine_can_hold) {
  const auto message = [](auto change) {
    Request request = cube(60);
    change(request);
    return message_of([&] { free_filling(request); });
  };
  const auto box = [&](const Vec3& extent) { return message([&](Request& q) { q.region = Box{{0, 0, 0}, extent}; }); };
  EXPECT_THAT(box({5, 5, 1e-5}),
              AllOf(HasSubstr("too thin for so few elements: 60 of them"), HasSubstr("ask for about")));
  EXPECT_THAT(box({1e9, 1, 1}), HasSubstr("too thin"));
  EXPECT_THAT(box({1e-60, 1, 1}), HasSubstr("between 1e-50 and 1e50"));
  EXPECT_THAT(box({1e120, 1e120, 1e120}), HasSubstr("between 1e-50 and 1e50"));
  EXPECT_THAT(message([](Request& q) { q.region = Cylinder{{0, 0, 0}, {0, 0, 1}, 1e-8}; }), HasSubstr("too thin"));
  EXPECT_THAT(message([](Request& q) {
                q.region = Box{{1e9, 0, 0}, {1e9 + 1, 1, 1}};
              }),
              HasSubstr("far from the origin"));
  EXPECT_THAT(message([](Request& q) {
                q.region = Box{{0, 0, 0}, {5, 5, 1e-5}};
                q.count.reset();
                q.mean_radius = 4e-6;
              }),
              HasSubstr("at most 134217727 are possible"));
}

TEST(Packing, has_no_more_cells_than_it_needs_in_a_thin_region) {
  // Cells as wide as the elements would be 4e14, and the volume over the largest number of cells says nothing of them.
  InsertionGrid grid(Box{{0, 0, 0}, {5, 5, 1e-8}}, 1e-7);
  grid.add({{1, 1, 0}, 1e-8});
  EXPECT_LT(grid.clearance({{1, 1, 1e-8}, 1e-8}, -1), 0);
  EXPECT_EQ(grid.clearance({{2, 1, 1e-8}, 1e-8}, -1), 1);
}

TEST(Packing, can_be_interrupted_in_each_of_its_long_loops) {
  // Each step is ended at its first, middle and last pause: what is thrown there comes out, and there is no other way.
  struct Stop {};
  const auto pauses_of = [](Packing p, const auto& step) {
    int count = 0;
    p.pause = [&] { ++count; };
    step(p);
    for (const int at : {1, count / 2, count}) {
      int left = at;
      p.pause = [&] {
        if (--left <= 0) throw Stop{};
      };
      EXPECT_THROW(step(p), Stop) << at << " of " << count;
    }
    return count;
  };
  const auto free = [](Packing& p) {
    Request request = cube(20000);
    request.pause = p.pause;
    free_filling(request);
  };
  EXPECT_GT(pauses_of({}, free), 20000);
  const Packing start = free_filling(cube(400));
  EXPECT_GT(pauses_of(start, [](Packing p) { forced_filling(p); }), 400);
  Request beside = cube(400);
  beside.around = {{{.5, .5, .5}}, {.2}};
  const Packing around = free_filling(beside);
  const int drawn = pauses_of(around, [](Packing p) { forced_filling(p, {.coordination = 5}); });
  EXPECT_GT(pauses_of(around, [](Packing p) { forced_filling(p, {.coordination = 5, .balanced = true}); }),
            drawn + 400);
  Packing packed = start;
  forced_filling(packed);
  // A round solves equations in many iterations, each as long as a step of arranging.
  EXPECT_GT(pauses_of(packed, [](Packing p) { relaxation(p); }), 100);
  // Cells, then the two loops of the order measure, in stretches of 8192 elements.
  const Packing lattice = [] {
    std::vector<Vec3> position;
    for (int x = 0; x < 30; ++x)
      for (int y = 0; y < 30; ++y)
        for (int z = 0; z < 30; ++z) position.push_back({x + .5, y + .5, z + .5});
    std::vector<Real> radius(position.size(), .5);
    return packing_of(Box{{0, 0, 0}, {30, 30, 30}}, {}, std::move(position), std::move(radius));
  }();
  EXPECT_GE(pauses_of(lattice, [](const Packing& p) { report(p); }), 2 * 4 + 2);
}

TEST(Packing, says_so_if_obstacles_fill_the_region) {
  Request request = cube(100);
  request.around = {{{0.5, 0.5, 0.5}}, {0.9}};
  EXPECT_THAT(message_of([&] { free_filling(request); }), HasSubstr("obstacles leave no room"));
}

TEST(Packing, says_so_if_the_coordination_number_cannot_be_reached) {
  const auto message = [](std::int64_t count, Real coordination) {
    Packing p = free_filling(cube(count));
    return message_of([&] { forced_filling(p, {.coordination = coordination, .tolerance = 0.3}); });
  };
  EXPECT_THAT(message(1, 6.2), HasSubstr("6.2 cannot be reached with 1 element:"));
  EXPECT_THAT(message(30, 6.2), HasSubstr("or for more elements"));
  EXPECT_THAT(message(1200, 10), HasSubstr("ask for a lower coordination number"));
  EXPECT_THAT(message(100, std::nan("")), HasSubstr("coordination number must be positive"));
}

TEST(Packing, refuses_tolerances_that_make_no_sense_and_steps_without_elements) {
  Packing none;
  none.region = Box{{0, 0, 0}, {1, 1, 1}};
  EXPECT_THAT(message_of([&] { forced_filling(none); }), HasSubstr("free filling comes first"));
  EXPECT_THAT(message_of([&] { relaxation(none); }), HasSubstr("free filling comes first"));
  Packing p = free_filling(cube(50));
  EXPECT_THAT(message_of([&] { forced_filling(p, {6.2, 1}); }), HasSubstr("overlap tolerance"));
  p.dispersion.spread = 0;
  EXPECT_THAT(message_of([&] { forced_filling(p, {.balanced = true}); }), HasSubstr("give them a spread"));
  p.dispersion.spread = 0.25;
  EXPECT_THAT(message_of([&] { relaxation(p, {0, 0.05}); }), HasSubstr("must be positive"));
  EXPECT_THAT(message_of([&] { relaxation(p, {1e-7, 0.9}); }), HasSubstr("below 0.5"));
}

}  // namespace
}  // namespace beadwork::packing
