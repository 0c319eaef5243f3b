#pragma once
// A small software rasteriser for specimens: spheres, discs and segments seen along parallel rays, with a
// depth buffer, soft shading and twofold supersampling. Same input, same bytes: pictures can be compared by a
// test.

#include <cstdint>
#include <vector>

#include "core/base/types.hpp"

namespace beadwork::report {

struct Color {
  float red = 0, green = 0, blue = 0;  ///< sRGB, 0 to 1
};

/// 0xRRGGBB
constexpr Color color(std::uint32_t hex) {
  return {static_cast<float>((hex >> 16) & 255U) / 255.0F, static_cast<float>((hex >> 8) & 255U) / 255.0F,
          static_cast<float>(hex & 255U) / 255.0F};
}

constexpr Color mix(Color a, Color b, float share_of_b) {
  return {a.red + (b.red - a.red) * share_of_b, a.green + (b.green - a.green) * share_of_b,
          a.blue + (b.blue - a.blue) * share_of_b};
}

/// Four bytes a pixel, straight alpha: what nothing covers is transparent, so a picture suits light and dark
/// pages.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

/// Looks along -toward, where toward = right x up; the picture shows width x height around the centre.
struct Camera {
  Vec3 right = Vec3(1, 0, 0);
  Vec3 up = Vec3(0, 1, 0);
  Vec3 centre = Vec3(0, 0, 0);
  Real width = 1, height = 1;
};

class Canvas {
 public:
  Canvas(const Camera&, int width_in_pixels);

  /// Quickest from front to back.
  void sphere(const Vec3& centre, Real radius, Color);
  /// Flat and unshaded, edge darkened: a mark, not a body.
  void disc(const Vec3& centre, const Vec3& normal, Real radius, Color);
  void segment(const Vec3& from, const Vec3& to, Real thickness, Color);

  /// Darkens what lies deeper than its surroundings, seen over `reach` (a length): gaps and cracks stand out.
  void darken_hollows(Real reach, float strength = 0.55F);
  /// Forgets the depth: whatever is drawn from here on lies in front of what is there.
  void flatten();
  /// Fades everything drawn so far: below `opacity` 1 it becomes a backdrop.
  void fade(float opacity);

  Image image() const;

 private:
  struct Pixel {
    float red, green, blue, alpha;
  };
  struct Point {
    float x, y, depth;
  };

  Point project(const Vec3&) const;
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  void put(int x, int y, float depth, Color);
  template <class Paint>
  void for_box(float x0, float x1, float y0, float y1, const Paint&);

  Camera camera_;
  Vec3 toward_;
  int width_, height_;  ///< of the supersampled buffer
  float scale_;         ///< supersampled pixels per length
  std::vector<Pixel> pixels_;
  std::vector<float> depth_;  ///< along toward_, in supersampled pixels; larger is nearer
};

/// The bytes of a PNG file. Throws MachineFailure if libpng does.
std::vector<std::uint8_t> png(const Image&);

}  // namespace beadwork::report
