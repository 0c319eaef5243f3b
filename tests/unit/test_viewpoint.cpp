// From where a specimen is looked at, and in which colours.
#include "workbench/report/viewpoint.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "workbench/report/color_scale.hpp"
#include "workbench/report/specimen.hpp"

namespace beadwork::report {
namespace {

/// Bonds along x, all broken, at the places that `place(share)` gives for shares from 0 to 1.
template <class Place>
record::Frame broken_at(std::size_t bonds, const Place& place) {
  record::Frame frame;
  record::Bonds family;
  family.family = "resin";
  for (std::size_t b = 0; b < bonds; ++b) {
    const Vec3 middle = place(b);
    for (const Real side : {-1.0, 1.0}) {
      frame.position.push_back(middle + side * Vec3(0.5, 0, 0));
      frame.radius.push_back(0.5);
      frame.id.push_back(static_cast<std::int64_t>(frame.id.size()));
    }
    family.ends.push_back({static_cast<Index>(2 * b), static_cast<Index>(2 * b + 1)});
    family.state.push_back(State::broken);
  }
  frame.bonds.push_back(family);
  return frame;
}

/// The k-th of points that are spread evenly, from 0 to 1.
Real even(std::size_t k, Real stride) { return std::fmod(0.5 + stride * static_cast<Real>(k), 1.0); }

Vec3 anywhere(std::size_t k, const Vec3& size) {
  return Vec3(even(k, 0.8191725) * size.x(), even(k, 0.6710436) * size.y(), even(k, 0.5497005) * size.z());
}

TEST(Viewpoint, breaks_all_over_a_disc_leave_it_seen_from_its_broad_face) {
  const Vec3 size(20, 4, 20);
  const Weak weak = weak_bonds(broken_at(60, [&](std::size_t k) { return anywhere(k, size); }), {});
  EXPECT_EQ(choose_viewpoint(weak, size, "").bodies, 1);
}

TEST(Viewpoint, a_compressed_cylinder_with_breaks_all_over_is_seen_from_its_side) {
  const Vec3 size(10, 10, 20);
  const Weak weak = weak_bonds(broken_at(60, [&](std::size_t k) { return anywhere(k, size); }), {});
  EXPECT_NE(choose_viewpoint(weak, size, "").bodies, 2);
}

TEST(Viewpoint, a_crack_is_seen_from_its_edge_and_from_above) {
  const Vec3 size(40, 6, 10);
  const auto crack = [&](std::size_t k) {
    return Vec3(20 + 0.5 * even(k, 0.3), anywhere(k, size).y(), anywhere(k, size).z());
  };
  const Viewpoint view = choose_viewpoint(weak_bonds(broken_at(30, crack), {}), size, "");
  EXPECT_EQ(view.bodies, 1);
  EXPECT_EQ(view.bonds, 0);
}

TEST(Viewpoint, a_few_breaks_in_a_plane_are_no_crack) {
  const Vec3 size(10, 20, 30);
  const auto crack = [&](std::size_t k) { return Vec3(5, 5, anywhere(k, size).z()); };
  EXPECT_EQ(choose_viewpoint(weak_bonds(broken_at(4, crack), {}), size, "").name, "broadest face");
}

TEST(Viewpoint, what_the_snapshot_asks_for_goes_first) {
  const Vec3 size(20, 4, 20);
  EXPECT_EQ(choose_viewpoint(Weak{}, size, "x").bodies, 0);
}

TEST(Viewpoint, a_snapshot_may_ask_for_several_axes) {
  record::Frame frame = broken_at(30, [&](std::size_t k) { return anywhere(k, Vec3(20, 4, 20)); });
  frame.head.view = "z y";
  ASSERT_EQ(wanted_view({frame}), "zy");
  std::vector<std::string> names;
  for (const View& view : set_up(frame, {frame}, {}, wanted_view({frame})).views)
    if (view.show == Show::bodies) names.push_back(view.name.substr(0, 12));
  EXPECT_EQ(names, (std::vector<std::string>{"seen along z", "seen along y"}));
}

TEST(ColorScale, splinters_do_not_make_all_others_alike) {
  std::vector<Real> values(1000);
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = 1 + static_cast<Real>(k);
  values.back() = 1e30;
  values.front() = std::nan("");
  const ColorScale scale = scale_over(values);
  EXPECT_LT(scale.high, 1001);
  EXPECT_TRUE(scale.above);
  EXPECT_EQ(css(scale(1e30)), css(scale(scale.high)));
  EXPECT_NE(css(scale(std::nan(""))), css(scale(scale.low)));
}

TEST(ColorScale, zero_is_in_the_middle_where_both_signs_occur) {
  const ColorScale scale = scale_over({-1, 0, 3});
  EXPECT_EQ(scale.low, -3);
  EXPECT_EQ(scale.high, 3);
  EXPECT_EQ(css(scale(0)), "#dddddd");
}

TEST(Palette, no_set_has_the_colour_of_a_state) {
  for (const Color set : palette::sets)
    for (const Color state : {palette::elastic, palette::softening, palette::broken})
      EXPECT_GT(std::hypot(set.red - state.red, set.green - state.green, set.blue - state.blue), 0.2F)
          << css(set) << " and " << css(state);
}

}  // namespace
}  // namespace beadwork::report
