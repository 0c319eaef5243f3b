// The specimen as one PNG: a few frames below each other.

#include <algorithm>

#include "core/base/failure.hpp"
#include "core/io/file.hpp"
#include "workbench/report/report.hpp"
#include "workbench/report/sections.hpp"
#include "workbench/report/specimen.hpp"

namespace beadwork {
namespace report {

namespace {

/// Images below each other, each in the middle, on nothing.
Image stacked(const std::vector<Image>& images, int gap) {
  Image out;
  for (const Image& image : images) {
    out.width = std::max(out.width, image.width);
    out.height += image.height + (out.height > 0 ? gap : 0);
  }
  const auto bytes_of = [](int pixels) { return static_cast<std::size_t>(pixels) * 4; };
  out.rgba.assign(bytes_of(out.width) * static_cast<std::size_t>(out.height), 0);
  std::size_t row = 0;
  for (const Image& image : images) {
    const std::size_t left = bytes_of((out.width - image.width) / 2);
    for (std::size_t y = 0; y < static_cast<std::size_t>(image.height); ++y)
      std::copy_n(image.rgba.begin() + static_cast<std::ptrdiff_t>(y * bytes_of(image.width)), bytes_of(image.width),
                  out.rgba.begin() + static_cast<std::ptrdiff_t>((row + y) * bytes_of(out.width) + left));
    row += static_cast<std::size_t>(image.height + gap);
  }
  return out;
}

}  // namespace
}  // namespace report

void write_picture(const std::filesystem::path& run_folder, const std::filesystem::path& file, std::size_t frames) {
  using namespace report;
  const record::FrameReader reader(run_folder / "run.h5");
  const auto heads = chosen(reader.frames(), frames);
  if (heads.empty()) throw MachineFailure("'" + (run_folder / "run.h5").string() + "' holds no frames to draw");
  const record::Frame first = reader.read(reader.frames().front());
  std::vector<record::Frame> shown;
  for (const record::FrameHead& head : heads) {
    shown.push_back(reader.read(head));
    complete_displacement(shown.back(), first);
  }
  const Stage stage = set_up(first, shown, reader.sets(), wanted_view(shown));
  std::vector<Image> images;
  for (const record::Frame& frame : shown)
    for (const View& view : stage.views)
      images.push_back(draw(stage, view, frame, width_in_pixels(stage, view, 1400, 700)));
  const auto bytes = png(stacked(images, 14));
  write_atomically(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace beadwork
