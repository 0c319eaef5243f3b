// The parts of rigid walls: where each is nearest to a place, which of them a place belongs to, and which are near.
#include <gmock/gmock.h>

#include <cstring>
#include <fstream>
#include <random>

#include "core/base/failure.hpp"
#include "core/domain/nearest.hpp"
#include "core/domain/surface.hpp"
#include "core/domain/walls.hpp"
#include "core/io/stl.hpp"
#include "core/mechanics/rotation.hpp"
#include "tests/support/scratch.hpp"

namespace beadwork {
namespace {

using ::testing::HasSubstr;
using testing::Scratch;
using ::testing::ThrowsMessage;

/// One wall of these facets, which stands at the origin unturned.
struct Wall {
  explicit Wall(const std::vector<Facet>& facets) { walls.add(0, false, facets); }
  Nearest<Real> at(const Vec3& p, Index k = 0) const { return nearest<Real>(walls.facets(), k, p); }
  /// Of all facets, those that the place belongs to.
  std::vector<Nearest<Real>> met(const Vec3& p) const {
    std::vector<Nearest<Real>> all;
    for (Index k = 0; k < walls.facet_count(); ++k)
      if (const Nearest<Real> found = at(p, k); found.meets) all.push_back(found);
    return all;
  }
  Walls walls;
};

Vec3 random_place(std::mt19937& random, Real size) {
  std::uniform_real_distribution<Real> along(-size, size);
  return {along(random), along(random), along(random)};
}

Real distance_to_triangle(const Vec3& p, const Triangle& t) {
  Real least = 1e300;  // by brute force over barycentric coordinates
  for (int i = 0; i <= 60; ++i)
    for (int j = 0; i + j <= 60; ++j) {
      const Real u = i / 60., v = j / 60.;
      least = std::min(least, (p - (t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]))).norm());
    }
  return least;
}

bool holds(const Triangle& t, const Vec3& p) {
  Eigen::Matrix3d edges;
  const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
  edges << t[1] - t[0], t[2] - t[0], normal;
  const Vec3 c = edges.inverse() * (p - t[0]);
  return c[0] > -1e-9 && c[1] > -1e-9 && c[0] + c[1] < 1 + 1e-9 && std::abs(c[2]) < 1e-9;
}

/// A box of this half edge, two triangles a side, outside the outside.
std::vector<Triangle> cube(Real h) {
  std::vector<Triangle> all;
  for (int axis = 0; axis < 3; ++axis)
    for (const Real sign : {-1., 1.}) {
      const Vec3 n = sign * Vec3::Unit(axis), u = Vec3::Unit((axis + 1) % 3), v = sign * Vec3::Unit((axis + 2) % 3);
      const Vec3 a = h * (n - u - v), b = h * (n + u - v), c = h * (n + u + v), d = h * (n - u + v);
      all.push_back({a, b, c});
      all.push_back({a, c, d});
    }
  return all;
}

/// A hilly ground over a grid of n x n squares: ridges, valleys and saddles.
std::vector<Triangle> hills(int n, Real height) {
  const auto at = [&](int i, int j) { return Vec3(i, j, height * std::sin(1.7 * i + 0.3) * std::cos(2.3 * j)); };
  std::vector<Triangle> all;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      all.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      all.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return all;
}

// The nearest point lies at p - distance * normal, on the surface; the normal has length 1.
TEST(Facet, tells_how_far_and_in_which_direction_its_surface_is) {
  struct Case {
    Facet facet;
    Vec3 place, normal;
    Real distance;
  };
  const Real s = std::sqrt(0.5);
  const std::vector<Case> cases = {
      {Facet::of(FacetKind::plane, {0, 0, 1}, {0, 0, 1}), {5, 6, 3}, {0, 0, 1}, 2},
      {Facet::of(FacetKind::plane, {0, 0, 1}, {0, 0, 1}), {5, 6, -3}, {0, 0, 1}, -4},
      {Facet::of(FacetKind::disc, {0, 0, 0}, {0, 0, 1}, 2), {1, 1, -3}, {0, 0, -1}, 3},
      {Facet::of(FacetKind::disc, {0, 0, 0}, {0, 0, 1}, 2), {3, 0, 1}, {s, 0, s}, std::sqrt(2.)},
      {Facet::of(FacetKind::box, {0, 0, 0}, {1, 2, 3}), {0, 0, 5}, {0, 0, 1}, 2},
      {Facet::of(FacetKind::box, {0, 0, 0}, {1, 2, 3}), {-2, 3, 0}, {-s, s, 0}, std::sqrt(2.)},
      {Facet::of(FacetKind::box, {0, 0, 0}, {1, 2, 3}), {0.5, 1.9, 0}, {0, 1, 0}, -0.1},
      {Facet::of(FacetKind::cylinder, {0, 0, 0}, {0, 0, 1}, 1, 4), {3, 0, 2}, {1, 0, 0}, 2},
      {Facet::of(FacetKind::cylinder, {0, 0, 0}, {0, 0, 1}, 1, 4), {0.5, 0, -2}, {0, 0, -1}, 2},
      {Facet::of(FacetKind::cylinder, {0, 0, 0}, {0, 0, 1}, 1, 4), {2, 0, 5}, {s, 0, s}, std::sqrt(2.)},
      {Facet::of(FacetKind::cylinder, {0, 0, 0}, {0, 0, 1}, 1, 4), {0.2, 0, 3.9}, {0, 0, 1}, -0.1},
      {Facet::of(FacetKind::cylinder, {0, 0, 0}, {0, 0, 1}, 1, 4), {0, 0.9, 2}, {0, 1, 0}, -0.1},
      {Facet::of(FacetKind::hollow_cylinder, {0, 0, 0}, {0, 0, 1}, 3, 4), {2, 0, 1}, {-1, 0, 0}, 1},
      {Facet::of(FacetKind::sphere, {0, 0, 0}, {0, 0, 0}, 2), {0, 5, 0}, {0, 1, 0}, 3},
      {Facet::of(FacetKind::hollow_sphere, {0, 0, 0}, {0, 0, 0}, 9), {0, 5, 0}, {0, -1, 0}, 4},
  };
  for (const auto& [part, place, normal, distance] : cases) {
    const Nearest<Real> found = Wall({part}).at(place);
    EXPECT_NEAR(found.distance, distance, 1e-14) << static_cast<int>(part.kind) << " from " << place.transpose();
    EXPECT_NEAR((found.normal - normal).norm(), 0, 1e-14)
        << static_cast<int>(part.kind) << " from " << place.transpose();
    EXPECT_TRUE(found.meets);
  }
}

// From within, from without, and at its rim: the distance goes on without a jump.
TEST(Facet, of_a_pipe_is_thin_and_has_rims) {
  const Wall wall({Facet::of(FacetKind::pipe, {0, 0, 0}, {0, 0, 1}, 3, 4)});
  EXPECT_NEAR(wall.at({2, 0, 4}).distance, 1, 1e-14);
  EXPECT_NEAR(wall.at({2, 0, 4}).normal.x(), -1, 1e-14);
  EXPECT_NEAR(wall.at({4.5, 0, 1}).distance, 1.5, 1e-14);
  EXPECT_NEAR(wall.at({4.5, 0, 1}).normal.x(), 1, 1e-14);
  EXPECT_NEAR(wall.at({2, 0, 5}).distance, std::sqrt(2.), 1e-14);
  EXPECT_NEAR(wall.at({3, 0, -1}).distance, 1, 1e-14);
  EXPECT_NEAR(wall.at({3, 0, -1}).normal.z(), -1, 1e-14);
}

// On the axis, in the centre, on an edge: some direction, but one of length 1, and no division by nothing.
TEST(Facet, has_a_direction_wherever_the_place_is) {
  for (const Facet& part :
       {Facet::of(FacetKind::disc, {0, 0, 0}, {0, 0, 1}, 2), Facet::of(FacetKind::box, {0, 0, 0}, {1, 1, 1}),
        Facet::of(FacetKind::cylinder, {0, 0, 0}, {0, 0, 1}, 1, 4),
        Facet::of(FacetKind::hollow_cylinder, {0, 0, 0}, {0, 0, 1}, 3, 4),
        Facet::of(FacetKind::sphere, {0, 0, 0}, {0, 0, 0}, 2),
        Facet::of(FacetKind::hollow_sphere, {0, 0, 0}, {0, 0, 0}, 2)})
    for (const Vec3& place : {Vec3(0, 0, 0), Vec3(0, 0, 2), Vec3(1, 0, 0), Vec3(1, 1, 1), Vec3(2, 0, 0)}) {
      const Nearest<Real> found = Wall({part}).at(place);
      EXPECT_NEAR(found.normal.norm(), 1, 1e-14) << static_cast<int>(part.kind) << " from " << place.transpose();
      EXPECT_TRUE(std::isfinite(found.distance));
    }
}

// Outside of something convex each place has one nearest point.
TEST(Surface, that_is_convex_has_one_part_for_each_place_outside) {
  const Wall wall(facets_of(cube(1), Sides::front));
  std::mt19937 random(5);
  for (int n = 0; n < 3000; ++n) {
    const Vec3 p = random_place(random, 2.5);
    if (p.cwiseAbs().maxCoeff() <= 1) continue;
    const auto met = wall.met(p);
    ASSERT_EQ(met.size(), 1U) << p.transpose();
    const Vec3 over = p - p.cwiseMax(-1).cwiseMin(1);
    EXPECT_NEAR(met[0].distance, over.norm(), 1e-13);
    EXPECT_NEAR((met[0].normal - over.normalized()).norm(), 0, 1e-12);
  }
}

// What people draw is symmetric, and so is where they put the ball: above the diagonal of two triangles, above an edge,
// above a corner, half-way between two.
TEST(Surface, has_one_part_also_for_a_place_just_above_an_edge_or_a_corner) {
  const Wall wall(facets_of(cube(1), Sides::front));
  for (const Vec3& p : {Vec3(0, 0, 1.5), Vec3(0.3, 0.3, 1.5), Vec3(-0.3, 0.3, 1.5), Vec3(1.5, 0, 0),
                        Vec3(0, -1.5, 0.25), Vec3(1, 0, 1.5), Vec3(1, 1, 1.5), Vec3(-1, 1, 1.5), Vec3(1, -1, -1.5),
                        Vec3(1.5, 1, 1), Vec3(1.5, 1.5, 1.5), Vec3(1.5, 1.5, 0)}) {
    const auto met = wall.met(p);
    ASSERT_EQ(met.size(), 1U) << p.transpose();
    EXPECT_NEAR(met[0].distance, (p - p.cwiseMax(-1).cwiseMin(1)).norm(), 1e-13);
  }
  // Flat, of four triangles that meet in the middle, and of eight that meet on its rim.
  std::vector<Triangle> plate;
  for (int k = 0; k < 4; ++k) {
    const Real a = 0.5 * k * 3.14159265358979, b = a + 0.5 * 3.14159265358979;
    plate.push_back({Vec3(0, 0, 0), Vec3(std::round(std::cos(a)), std::round(std::sin(a)), 0),
                     Vec3(std::round(std::cos(b)), std::round(std::sin(b)), 0)});
  }
  const Wall flat(facets_of(plate));
  for (const Vec3& p :
       {Vec3(0, 0, 0.5), Vec3(0.5, 0, 0.5), Vec3(0, -0.5, 0.5), Vec3(0.25, 0.25, -0.5), Vec3(0.5, 0.5, 0.5)})
    EXPECT_EQ(flat.met(p).size(), 1U) << p.transpose();
}

// In a valley a place belongs to both sides; whatever it belongs to is nearest in its neighbourhood, and the nearest of all is
// among it.
TEST(Surface, with_hills_and_valleys_has_the_nearest_point_among_its_parts) {
  const auto triangles = hills(5, 0.8);
  const Wall wall(facets_of(triangles));
  std::mt19937 random(7);
  int in_valleys = 0;
  for (int n = 0; n < 400; ++n) {
    const Vec3 p = Vec3(2.5, 2.5, 0) + random_place(random, 2);
    Real least = 1e300;
    for (const Triangle& t : triangles) least = std::min(least, distance_to_triangle(p, t));
    const auto met = wall.met(p);
    ASSERT_FALSE(met.empty()) << p.transpose();
    in_valleys += met.size() > 1;
    Real nearest_met = 1e300;
    for (const Nearest<Real>& each : met) {
      nearest_met = std::min(nearest_met, each.distance);
      const Vec3 foot = p - each.distance * each.normal;
      int under_foot = 0;
      for (const Triangle& t : triangles) {
        if (!holds(t, foot)) continue;
        ++under_foot;
        for (const Vec3& corner : t) {  // a step along the surface leads no nearer
          const Vec3 step = foot + 1e-3 * (corner - foot);
          EXPECT_GT((p - step).norm(), each.distance - 1e-12);
        }
      }
      EXPECT_GT(under_foot, 0);
    }
    EXPECT_NEAR(nearest_met, least, 0.02);  // that of the brute force is of its grid
    EXPECT_LT(nearest_met, least + 1e-12);
  }
  EXPECT_GT(in_valleys, 20);
}

// From within, the same cube is a box whose sides alone can be touched, up to three at once.
TEST(Surface, that_is_closed_is_touched_from_within_at_its_faces) {
  const Wall wall(facets_of(cube(1), Sides::back));
  std::mt19937 random(5);
  for (int n = 0; n < 300; ++n) {
    const Vec3 p = random_place(random, 0.99);
    const auto met = wall.met(p);
    ASSERT_EQ(met.size(), 6U);
    for (const Nearest<Real>& each : met)
      EXPECT_NEAR((p - each.distance * each.normal).cwiseAbs().maxCoeff(), 1, 1e-14);
  }
  EXPECT_EQ(wall.met(Vec3(0, 0, 1.2)).size(),
            1U);  // what has passed a face touches it no more, nor the sides; the one across it does
}

// A notch on the far side is no edge for what stands in front of the body, however near it is.
TEST(Surface, with_one_side_is_not_touched_through_the_body) {
  std::vector<Triangle> body = cube(1);
  std::erase_if(body, [](const Triangle& t) { return t[0].z() < 0 && t[1].z() < 0 && t[2].z() < 0; });
  const Vec3 apex(0.1, 0.2, 0.7), rim[] = {{-1, -1, -1}, {-1, 1, -1}, {1, 1, -1}, {1, -1, -1}};
  for (int k = 0; k < 4; ++k) body.push_back({rim[k], rim[(k + 1) % 4], apex});
  const Wall full(facets_of(body, Sides::front)), shell(facets_of(body));
  std::mt19937 random(7);
  for (int n = 0; n < 300; ++n) {
    const Vec3 p = Vec3(0, 0, 1.2) + 0.15 * random_place(random, 1);
    const auto met = full.met(p);
    ASSERT_EQ(met.size(), 1U) << p.transpose();
    EXPECT_NEAR(met[0].distance, p.z() - 1, 1e-14);
    EXPECT_GT(shell.met(p).size(), 1U);  // of which the notch is a part
  }
  EXPECT_EQ(full.met(Vec3(0.1, 0.2, 0.5)).size(), 4U);  // and from below all sides of the notch are
}

// A hollow of many facets is as one of few: at a valley that is hardly bent the nearer of the two is touched, so that what is
// stored goes on without a jump; at one that is bent more both are.
TEST(Surface, that_is_round_and_hollow_is_touched_once) {
  const auto prism = [](int sides) {
    std::vector<Triangle> all;
    for (int k = 0; k < sides; ++k) {
      const auto at = [&](int n, Real z) {
        const Real angle = 2 * 3.14159265358979323846 * n / sides;
        return Vec3(4 * std::cos(angle), 4 * std::sin(angle), z);
      };
      const int next = (k + 1) % sides;
      all.push_back({at(k, -3), at(next, -3), at(next, 3)});
      all.push_back({at(k, -3), at(next, 3), at(k, 3)});
    }
    return all;
  };
  for (const int sides : {30, 360}) {
    const Wall wall(facets_of(prism(sides)));
    Real before = 0;
    for (int n = 0; n <= 5000; ++n) {
      const Real angle = n * 1e-4;
      const Vec3 p = 3.05 * Vec3(std::cos(angle), std::sin(angle), 0.01);  // a sphere of radius 1 overlaps by 5 %
      Real stored = 0;
      int touched = 0;
      for (const Nearest<Real>& each : wall.met(p))
        if (each.distance < 1) stored += 0.5 * (1 - each.distance) * (1 - each.distance), ++touched;
      ASSERT_EQ(touched, 1) << sides << " sides, at " << angle;
      if (n > 0) EXPECT_NEAR(stored, before, 1e-5) << sides << " sides, at " << angle;
      before = stored;
    }
  }
  const Wall square(facets_of(prism(4)));
  EXPECT_EQ(square.met(Vec3(2.9, 0, 0.01)).size(), 2U + 2U);  // and the two across, farther off
}

// As programs write them: in single precision, each triangle with corners of its own.
TEST(Surface, welds_corners_that_differ_by_round_off) {
  std::vector<Triangle> plate = {{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0)},
                                 {Vec3(3e-7, 0, 0), Vec3(1, 1 - 3e-7, 0), Vec3(0, 1, 0)}};
  const Wall wall(facets_of(plate));
  for (const Real off : {-0.1, -1e-7, 0., 1e-7, 0.1})
    EXPECT_EQ(wall.met(Vec3(0.5 + off, 0.5 - off, 0.3)).size(), 1U) << off;
}

TEST(Surface, refuses_what_has_gaps_or_is_turned_inside_out) {
  const std::vector<Triangle> junction = {{Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 2, 0)},
                                          {Vec3(0, 0, 0), Vec3(1, -1, 0), Vec3(1, 0, 0)}};
  EXPECT_THAT([&] { facets_of(junction); }, ThrowsMessage<std::invalid_argument>(
                                                HasSubstr("corner (1 0 0) lies on the edge from (0 0 0) to (2 0 0)")));
  EXPECT_THAT([&] { facets_of(hills(3, 0.5), Sides::front); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("it is not closed, 12 of its edges")));
  std::vector<Triangle> turned = cube(1);
  for (Triangle& t : turned) std::swap(t[0], t[1]);
  EXPECT_THAT([&] { facets_of(turned, Sides::front); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("go round clockwise")));
  EXPECT_THAT([&] { facets_of(turned, Sides::back); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("go round clockwise")));
  EXPECT_TRUE(is_closed(turned));
  EXPECT_FALSE(is_closed(hills(3, 0.5)));
}

TEST(Surface, refuses_an_edge_that_three_triangles_share_and_what_has_no_area) {
  const Vec3 a(0, 0, 0), b(1, 0, 0);
  const std::vector<Triangle> fan = {{a, b, Vec3(0, 1, 0)}, {b, a, Vec3(0, -1, 0)}, {a, b, Vec3(0, 0, 1)}};
  EXPECT_THAT([&] { facets_of(fan); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("3 triangles share the edge from (0 0 0) to (1 0 0)")));
  const std::vector<Triangle> twisted = {{a, b, Vec3(0, 1, 0)}, {a, b, Vec3(0, -1, 1)}};
  EXPECT_NO_THROW(facets_of(twisted));
  EXPECT_THAT([&] { facets_of(twisted, Sides::front); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("go round differently")));
  const std::vector<Triangle> needle = {{a, b, Vec3(2, 0, 0)}};
  EXPECT_THAT([&] { facets_of(needle); }, ThrowsMessage<std::invalid_argument>(HasSubstr("no triangle with an area")));
  const std::vector<Triangle> lost = {{a, b, Vec3(0, std::nan(""), 0)}};
  EXPECT_THAT([&] { facets_of(lost); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("triangle 1 has a coordinate that is not finite")));
}

TEST(Walls, tell_which_of_their_facets_are_near_however_they_stand) {
  const auto triangles = hills(6, 0.5);
  Wall wall(facets_of(triangles));
  const Quat turned = exp_map(Vec3(0.3, -0.7, 1.1));
  const Pose pose{Vec3(4, -2, 1), turned};
  std::mt19937 random(3);
  std::vector<Vec3> places;
  std::vector<Real> reach;
  for (int n = 0; n < 200; ++n) {
    places.push_back(pose.position + rotate(turned, Vec3(Vec3(3, 3, 0) + random_place(random, 3))));
    reach.push_back(0.1 + 0.002 * n);
  }
  const std::vector<Index> among = {0};
  const auto found = wall.walls.near(places, reach, among, std::vector<Pose>{pose});
  EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
  int within = 0;
  for (Index e = 0; e < 200; ++e) {
    const Vec3 p = rotate_back(turned, Vec3(places[static_cast<std::size_t>(e)] - pose.position));
    for (Index k = 0; k < wall.walls.facet_count(); ++k) {
      const Nearest<Real> near = wall.at(p, k);
      if (!near.meets || near.distance > reach[static_cast<std::size_t>(e)]) continue;
      ++within;
      EXPECT_TRUE(std::binary_search(found.begin(), found.end(), Near{e, 0, k})) << e << ' ' << k;
    }
  }
  EXPECT_GT(within, 20);
  EXPECT_LT(found.size(), 200U * static_cast<std::size_t>(wall.walls.facet_count()) / 4);  // and not all that there are
}

TEST(Walls, know_how_far_their_farthest_point_has_moved) {
  Wall wall(facets_of(cube(1)));
  const Pose rest{Vec3(1, 2, 3), identity()};
  wall.walls.note(0, rest, 10);
  EXPECT_EQ(wall.walls.moved(0, rest, 0), 0);
  EXPECT_NEAR(wall.walls.moved(0, {Vec3(1, 2, 3.5), identity()}, 0), 0.5, 1e-15);
  const Pose turned{Vec3(1, 2, 3), exp_map(Vec3(0, 0, 0.1))};
  EXPECT_NEAR(wall.walls.moved(0, turned, 0), 0.1 * std::sqrt(3.), 1e-12);
  wall.walls.note(0, rest, 0.3);
  EXPECT_NEAR(wall.walls.moved(0, turned, 0.2), 0.05, 1e-12);  // of what is no farther off than that
}

std::string binary_stl(const std::vector<Triangle>& triangles) {
  std::string bytes(84 + 50 * triangles.size(), '\0');
  std::memcpy(bytes.data(), "solid of bytes", 14);  // as some programs begin it
  const auto count = static_cast<std::uint32_t>(triangles.size());
  std::memcpy(bytes.data() + 80, &count, 4);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t a = 0; a < 3; ++a) {
        const auto number = static_cast<float>(triangles[t][c][static_cast<Index>(a)]);
        std::memcpy(bytes.data() + 84 + 50 * t + 12 * (c + 1) + 4 * a, &number, 4);
      }
  return bytes;
}
std::string text_stl(const std::vector<Triangle>& triangles) {
  std::string text = "solid cube of two words\r\n";
  for (const Triangle& t : triangles) {
    text += "  facet normal nan nan nan\n    outer loop\n";
    for (const Vec3& c : t)
      text +=
          "      vertex " + std::to_string(c.x()) + " " + std::to_string(c.y()) + "\t" + std::to_string(c.z()) + "\n";
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid cube of two words\n";
}

TEST(Stl, is_read_from_text_and_from_bytes_alike) {
  const auto triangles = cube(1.5);
  for (const std::string& stl : {binary_stl(triangles), text_stl(triangles)}) {
    const auto read = parse_stl(stl, "cube.stl");
    ASSERT_EQ(read.size(), 12U);
    for (std::size_t t = 0; t < 12; ++t)
      for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(read[t][c], triangles[t][c]);
  }
  EXPECT_EQ(parse_stl(text_stl(triangles) + text_stl(triangles), "two.stl").size(), 24U);
  std::string loud = text_stl(triangles);
  for (char& c : loud) c = static_cast<char>(std::toupper(c));
  EXPECT_EQ(parse_stl("\xEF\xBB\xBF" + loud, "loud.stl").size(), 12U);
}

TEST(Stl, that_is_broken_is_told_with_its_place) {
  const std::string text = text_stl(cube(1)), bytes = binary_stl(cube(1));
  const auto saying = [](const std::string& what) { return ThrowsMessage<DeckFailure>(HasSubstr(what)); };
  EXPECT_THAT([&] { parse_stl(text.substr(0, text.size() - 30), "a.stl"); }, saying("a.stl:"));
  EXPECT_THAT([&] { parse_stl("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0,5 0\n", "a.stl"); },
              saying("a.stl:4:10: error: a number is wanted, got \"0,5\""));
  EXPECT_THAT([&] { parse_stl("solid\nfacet normal 0 0 1\ninner loop\n", "a.stl"); },
              saying("a.stl:3:1: error: 'outer' is wanted, got \"inner\""));
  EXPECT_THAT([&] { parse_stl(bytes.substr(0, bytes.size() - 1).replace(0, 5, "cubic"), "a.stl"); },
              saying("its head tells of 12 triangles, which are 684 bytes, and the file has 683"));
  EXPECT_THAT([&] { parse_stl("", "a.stl"); }, saying("no STL"));
  for (std::size_t length = 0; length < text.size() - 30; length += 7)  // cut anywhere: told, not crashed
    EXPECT_THAT([&] { parse_stl(text.substr(0, length), "a.stl"); }, saying("a.stl:"));
}

}  // namespace
}  // namespace beadwork
