#include "workbench/report/canvas.hpp"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/failure.hpp"

namespace beadwork::report {

namespace {

constexpr int supersampling = 2;
constexpr float nothing = std::numeric_limits<float>::lowest();

/// One light from the upper left in front, wrapped around so that no side falls black, and a darker rim.
Color shaded(Color base, float nx, float ny, float nz) {
  const float facing = -0.40F * nx + 0.52F * ny + 0.755F * nz;
  const float wrapped = std::max(0.0F, 0.35F + 0.65F * facing);
  const float light = (0.42F + 0.66F * wrapped) * (0.80F + 0.20F * nz);
  const float glint = std::max(0.0F, facing - 0.86F) * 0.9F;
  const auto channel = [&](float c) { return std::clamp(c * light + glint, 0.0F, 1.0F); };
  return {channel(base.red), channel(base.green), channel(base.blue)};
}

/// Mean over a running window of 2*reach+1 pixels, along the rows; sums in double, in one order.
void blur_across(const std::vector<float>& in, std::vector<float>& out, int width, int height, int reach) {
  for (int y = 0; y < height; ++y) {
    const std::size_t first = static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
    const auto at = [&](int x) { return static_cast<double>(in[first + static_cast<std::size_t>(x)]); };
    double sum = 0;
    int inside = 0;
    for (int x = 0; x < std::min(reach, width); ++x, ++inside) sum += at(x);
    for (int x = 0; x < width; ++x) {
      if (x + reach < width) sum += at(x + reach), ++inside;
      if (x > reach) sum -= at(x - reach - 1), --inside;
      out[first + static_cast<std::size_t>(x)] = static_cast<float>(sum / inside);
    }
  }
}

/// The same along the columns, all of them at once, so that memory is read row by row.
void blur_down(const std::vector<float>& in, std::vector<float>& out, int width, int height, int reach) {
  const auto columns = static_cast<std::size_t>(width);
  std::vector<double> sums(columns, 0);
  int inside = 0;
  const auto add = [&](int y, double sign) {
    const float* row = in.data() + static_cast<std::size_t>(y) * columns;
    for (std::size_t x = 0; x < columns; ++x) sums[x] += sign * static_cast<double>(row[x]);
    inside += sign > 0 ? 1 : -1;
  };
  for (int y = 0; y < std::min(reach, height); ++y) add(y, 1);
  for (int y = 0; y < height; ++y) {
    if (y + reach < height) add(y + reach, 1);
    if (y > reach) add(y - reach - 1, -1);
    float* row = out.data() + static_cast<std::size_t>(y) * columns;
    for (std::size_t x = 0; x < columns; ++x) row[x] = static_cast<float>(sums[x] / inside);
  }
}

void blur(std::vector<float>& values, int width, int height, int reach) {
  std::vector<float> between(values.size());
  blur_across(values, between, width, height, reach);
  blur_down(between, values, width, height, reach);
}

std::uint8_t byte(float share) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(share, 0.0F, 1.0F) * 255.0F));
}

/// In steps of 4 of 256, which no eye sees on a speckled surface: the file is a third smaller.
std::uint8_t coarse(float share) {
  const int whole = byte(share);
  return static_cast<std::uint8_t>(std::min(255, (whole + 2) / 4 * 4));
}

}  // namespace

Canvas::Canvas(const Camera& camera, int width_in_pixels) : camera_(camera), toward_(camera.right.cross(camera.up)) {
  if (!(camera.width > 0) || !(camera.height > 0) || width_in_pixels < 1)
    throw MachineFailure("a picture needs a positive size");
  const int across = std::min(width_in_pixels, 8192);
  const Real tall = std::ceil(across * camera.height / camera.width);
  width_ = supersampling * across;
  height_ = supersampling * static_cast<int>(std::clamp(tall, Real(1), Real(8192)));
  scale_ = static_cast<float>(width_ / camera.width);
  const auto count = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  pixels_.assign(count, Pixel{0, 0, 0, 0});
  depth_.assign(count, nothing);
}

Canvas::Point Canvas::project(const Vec3& place) const {
  const Vec3 from = place - camera_.centre;
  return {static_cast<float>(from.dot(camera_.right)) * scale_ + 0.5F * static_cast<float>(width_),
          0.5F * static_cast<float>(height_) - static_cast<float>(from.dot(camera_.up)) * scale_,
          static_cast<float>(from.dot(toward_)) * scale_};
}

void Canvas::put(int x, int y, float depth, Color c) {
  const std::size_t at = index(x, y);
  if (depth <= depth_[at]) return;
  depth_[at] = depth;
  pixels_[at] = {c.red, c.green, c.blue, 1};
}

/// Calls paint(x, y, column, row) for each pixel whose centre may lie in the box, clipped to the picture.
template <class Paint>
void Canvas::for_box(float x0, float x1, float y0, float y1, const Paint& paint) {
  if (!(x1 >= 0 && y1 >= 0 && x0 <= static_cast<float>(width_) && y0 <= static_cast<float>(height_))) return;
  const int first_x = static_cast<int>(std::max(0.0F, x0));
  const int first_y = static_cast<int>(std::max(0.0F, y0));
  const int last_x = static_cast<int>(std::min(static_cast<float>(width_ - 1), x1));
  const int last_y = static_cast<int>(std::min(static_cast<float>(height_ - 1), y1));
  for (int y = first_y; y <= last_y; ++y)
    for (int x = first_x; x <= last_x; ++x) paint(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F, x, y);
}

void Canvas::sphere(const Vec3& centre, Real radius, Color base) {
  const Point c = project(centre);
  const float r = static_cast<float>(radius) * scale_;
  for_box(c.x - r, c.x + r, c.y - r, c.y + r, [&](float px, float py, int x, int y) {
    if (c.depth + r <= depth_[index(x, y)]) return;  // most spheres of a packing are hidden: no root for them
    const float nx = (px - c.x) / r, ny = (c.y - py) / r;
    const float rest = 1 - nx * nx - ny * ny;
    if (rest < 0) return;
    const float nz = std::sqrt(rest);
    if (c.depth + nz * r > depth_[index(x, y)]) put(x, y, c.depth + nz * r, shaded(base, nx, ny, nz));
  });
}

void Canvas::disc(const Vec3& centre, const Vec3& normal, Real radius, Color base) {
  const Point c = project(centre);
  const float r = static_cast<float>(radius) * scale_;
  const auto nr = static_cast<float>(normal.dot(camera_.right)), nu = static_cast<float>(normal.dot(camera_.up));
  // A disc seen from its side is given a little thickness, or it would vanish.
  const float nt = std::max(0.25F, std::abs(static_cast<float>(normal.dot(toward_))));
  const float sign = normal.dot(toward_) < 0 ? -1.0F : 1.0F;
  const Color edge = mix(base, Color{0, 0, 0}, 0.28F);
  for_box(c.x - r, c.x + r, c.y - r, c.y + r, [&](float px, float py, int x, int y) {
    const float dx = (px - c.x) / r, dy = (c.y - py) / r;
    const float dz = -sign * (dx * nr + dy * nu) / nt;  // on the plane of the disc
    const float square = dx * dx + dy * dy + dz * dz;
    if (square > 1) return;
    put(x, y, c.depth + dz * r, square > 0.68F ? edge : base);
  });
}

void Canvas::segment(const Vec3& from, const Vec3& to, Real thickness, Color base) {
  const Point a = project(from), b = project(to);
  const float r = std::max(0.8F, 0.5F * static_cast<float>(thickness) * scale_);
  const float ux = b.x - a.x, uy = b.y - a.y;
  const float square = std::max(ux * ux + uy * uy, 1e-12F);
  for_box(
      std::min(a.x, b.x) - r, std::max(a.x, b.x) + r, std::min(a.y, b.y) - r, std::max(a.y, b.y) + r,
      [&](float px, float py, int x, int y) {
        const float along = std::clamp(((px - a.x) * ux + (py - a.y) * uy) / square, 0.0F, 1.0F);
        const float dx = px - a.x - along * ux, dy = py - a.y - along * uy;
        const float off = (dx * dx + dy * dy) / (r * r);
        if (off > 1) return;
        const float bulge = std::sqrt(1 - off);
        put(x, y, a.depth + along * (b.depth - a.depth) + bulge * r, mix(mix(base, Color{0, 0, 0}, 0.3F), base, bulge));
      });
}

void Canvas::darken_hollows(Real reach, float strength) {
  const float range = std::max(1.0F, static_cast<float>(reach) * scale_);
  std::vector<float> covered(depth_.size()), depth(depth_.size());
  for (std::size_t i = 0; i < depth_.size(); ++i) {
    covered[i] = depth_[i] > nothing ? 1.0F : 0.0F;
    depth[i] = covered[i] > 0 ? depth_[i] : 0.0F;
  }
  const int window = std::max(1, static_cast<int>(range * 0.5F));
  for (int pass = 0; pass < 2; ++pass) {
    blur(depth, width_, height_, window);
    blur(covered, width_, height_, window);
  }
  for (std::size_t i = 0; i < depth_.size(); ++i) {
    if (depth_[i] <= nothing || covered[i] <= 0) continue;
    const float below = std::clamp((depth[i] / covered[i] - depth_[i]) / range, 0.0F, 1.0F);
    const float keep = 1 - strength * below;
    pixels_[i].red *= keep;
    pixels_[i].green *= keep;
    pixels_[i].blue *= keep;
  }
}

void Canvas::flatten() { std::fill(depth_.begin(), depth_.end(), nothing); }

void Canvas::fade(float opacity) {
  for (Pixel& pixel : pixels_) pixel.alpha *= opacity;
}

Image Canvas::image() const {
  Image image{width_ / supersampling, height_ / supersampling, {}};
  image.rgba.reserve(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 4);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      Pixel sum{0, 0, 0, 0};
      for (int s = 0; s < supersampling * supersampling; ++s) {
        const auto row = static_cast<std::size_t>(supersampling * y + s / supersampling);
        const auto column = static_cast<std::size_t>(supersampling * x + s % supersampling);
        const Pixel& p = pixels_[row * static_cast<std::size_t>(width_) + column];
        sum.red += p.red * p.alpha, sum.green += p.green * p.alpha, sum.blue += p.blue * p.alpha;
        sum.alpha += p.alpha;
      }
      const float share = sum.alpha > 0 ? 1 / sum.alpha : 0.0F;
      for (const float c : {sum.red, sum.green, sum.blue}) image.rgba.push_back(coarse(c * share));
      image.rgba.push_back(byte(sum.alpha / (supersampling * supersampling)));
    }
  return image;
}

std::vector<std::uint8_t> png(const Image& image) {
  const auto row_bytes = static_cast<std::size_t>(image.width) * 4;
  if (image.width < 1 || image.height < 1 || image.rgba.size() != row_bytes * static_cast<std::size_t>(image.height))
    throw MachineFailure("a picture's bytes do not match its size");
  std::vector<std::uint8_t> out;
  // libpng reports errors by a function that must not return; throwing through its frames is what it allows
  // in C++.
  const auto fail = [](png_structp, png_const_charp message) {
    throw MachineFailure(std::string("libpng: ") + message);
  };
  const auto warn = [](png_structp, png_const_charp) {};
  png_structp writer = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, warn);
  png_infop info = writer ? png_create_info_struct(writer) : nullptr;
  if (!info) {
    png_destroy_write_struct(&writer, nullptr);
    throw MachineFailure("libpng cannot start");
  }
  const auto append = [](png_structp png, png_bytep data, std::size_t size) {
    auto* bytes = static_cast<std::vector<std::uint8_t>*>(png_get_io_ptr(png));
    bytes->insert(bytes->end(), data, data + size);
  };
  try {
    png_set_write_fn(writer, &out, append, [](png_structp) {});
    png_set_IHDR(writer, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), 8,
                 PNG_COLOR_TYPE_RGB_ALPHA, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_compression_level(writer, 6);
    png_write_info(writer, info);
    for (int y = 0; y < image.height; ++y)
      png_write_row(writer, image.rgba.data() + static_cast<std::size_t>(y) * row_bytes);
    png_write_end(writer, info);
  } catch (...) {
    png_destroy_write_struct(&writer, &info);
    throw;
  }
  png_destroy_write_struct(&writer, &info);
  return out;
}

}  // namespace beadwork::report
