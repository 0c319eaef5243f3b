// The rasteriser: what is nearer hides what is behind, edges are smooth, bytes repeat.
#include "workbench/report/canvas.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "core/base/failure.hpp"
#include "core/base/random.hpp"

namespace beadwork::report {
namespace {

constexpr Color red{1, 0, 0}, blue{0, 0, 1};

Camera square(Real side) {
  Camera camera;
  camera.width = camera.height = side;
  return camera;
}

struct Rgba {
  int red, green, blue, alpha;
};

Rgba at(const Image& image, int x, int y) {
  const std::uint8_t* p = image.rgba.data() + 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                                                   static_cast<std::size_t>(x));
  return {p[0], p[1], p[2], p[3]};
}

TEST(Canvas, the_nearer_sphere_hides_the_farther_in_whatever_order_they_are_drawn) {
  for (const bool near_first : {true, false}) {
    Canvas canvas(square(4), 64);
    const Vec3 near(0, 0, 1), far(0, 0, -1);
    canvas.sphere(near_first ? near : far, 1, near_first ? red : blue);
    canvas.sphere(near_first ? far : near, 1, near_first ? blue : red);
    const Rgba middle = at(canvas.image(), 32, 32);
    EXPECT_GT(middle.red, 120);
    EXPECT_LT(middle.blue, 100);
  }
}

TEST(Canvas, y_points_up_and_x_to_the_right) {
  Canvas canvas(square(4), 64);
  canvas.sphere(Vec3(1, 1, 0), 0.5, red);
  const Image image = canvas.image();
  EXPECT_EQ(at(image, 48, 16).alpha, 255);
  EXPECT_EQ(at(image, 16, 48).alpha, 0);
}

TEST(Canvas, what_nothing_covers_is_transparent_and_the_edge_is_smooth) {
  Canvas canvas(square(4), 64);
  canvas.sphere(Vec3(0.011, 0.007, 0), 1, red);
  const Image image = canvas.image();
  EXPECT_EQ(at(image, 0, 0).alpha, 0);
  int partly = 0;
  for (int x = 0; x < 64; ++x)
    for (int y = 0; y < 64; ++y) partly += at(image, x, y).alpha > 0 && at(image, x, y).alpha < 255;
  EXPECT_GT(partly, 20);
}

TEST(Canvas, a_sphere_covers_pi_r_squared) {
  Canvas canvas(square(4), 200);
  canvas.sphere(Vec3::Zero(), 1, red);
  const Image image = canvas.image();
  Real covered = 0;
  for (int x = 0; x < 200; ++x)
    for (int y = 0; y < 200; ++y) covered += at(image, x, y).alpha / 255.0;
  EXPECT_NEAR(covered / (200.0 * 200.0) * 16, 3.14159, 0.01);  // derived: area of the disc
}

TEST(Canvas, a_disc_seen_from_its_edge_stays_visible_and_a_segment_has_its_thickness) {
  Canvas canvas(square(4), 100);
  canvas.disc(Vec3::Zero(), Vec3(0, 1, 0), 1, blue);
  EXPECT_EQ(at(canvas.image(), 50, 50).alpha, 255);
  Canvas other(square(4), 100);
  other.segment(Vec3(-1, 0, 0), Vec3(1, 0, 0), 0.4, red);
  const Image line = other.image();
  EXPECT_EQ(at(line, 50, 46).alpha, 255);
  EXPECT_EQ(at(line, 50, 42).alpha, 0);
}

TEST(Canvas, after_flatten_a_mark_lies_in_front_of_what_was_drawn) {
  Canvas canvas(square(4), 64);
  canvas.sphere(Vec3(0, 0, 5), 1, red);
  canvas.flatten();
  canvas.disc(Vec3(0, 0, -5), Vec3(0, 0, 1), 1, blue);
  EXPECT_GT(at(canvas.image(), 32, 32).blue, 200);
}

TEST(Canvas, spheres_outside_or_without_a_place_are_left_out) {
  Canvas canvas(square(4), 32);
  canvas.sphere(Vec3(100, 0, 0), 1, red);
  canvas.sphere(Vec3(std::nan(""), 0, 0), 1, red);
  canvas.sphere(Vec3(1e300, 1e300, 0), 1, red);
  for (const std::uint8_t byte : canvas.image().rgba) EXPECT_EQ(byte, 0);
}

Image packing(int count) {
  Canvas canvas(square(10), 600);
  Random random(7);
  for (int i = 0; i < count; ++i)
    canvas.sphere(Vec3(random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-5, 5)), 0.12, color(0x7FA8CC));
  canvas.darken_hollows(0.5);
  return canvas.image();
}

TEST(Canvas, the_same_picture_has_the_same_bytes) {
  const auto bytes = png(packing(5000));
  EXPECT_EQ(bytes, png(packing(5000)));
  ASSERT_GT(bytes.size(), 100U);
  EXPECT_EQ(0, std::memcmp(bytes.data(), "\x89PNG\r\n\x1a\n", 8));
}

TEST(Canvas, a_size_that_is_not_one_is_refused) {
  Camera camera;
  camera.width = 0;
  EXPECT_THROW(Canvas(camera, 100), MachineFailure);
  EXPECT_THROW(png(Image{10, 10, {}}), MachineFailure);
}

}  // namespace
}  // namespace beadwork::report
