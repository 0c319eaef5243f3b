#include "core/io/packing_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"
#include "core/io/frame_reader.hpp"

namespace beadwork {

namespace {

bool is_hdf5(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  return extension == ".h5" || extension == ".hdf5";
}

StoredPacking first_frame(const std::filesystem::path& file, Real scale) {
  const record::FrameReader reader(file);
  if (reader.frames().empty()) throw DeckFailure(fmt::format("error: {} holds no frame to take a packing from", file.string()));
  record::Frame frame = reader.read(reader.frames().front());
  for (Vec3& x : frame.position) x *= scale;
  for (Real& r : frame.radius) r *= scale;
  return {std::move(frame.position), std::move(frame.radius)};
}

std::vector<Real> numbers_of(std::string line) {
  std::replace(line.begin(), line.end(), ',', ' ');
  std::vector<Real> numbers;
  for (const std::string& word : split_words(line)) {
    const auto number = parse_number(word);
    if (!number) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

StoredPacking lines_of(const std::filesystem::path& file, Real scale) {
  std::ifstream stream(file);
  if (!stream) throw MachineFailure(fmt::format("error: cannot open {}", file.string()));
  StoredPacking packing;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    const std::string text(trim(line));
    if (text.empty() || text[0] == '#') continue;
    const std::vector<Real> n = numbers_of(text);
    if (n.empty() && number == 1) continue;  // names of the columns
    if (n.size() != 4)
      throw DeckFailure(fmt::format("{}:{}: error: a line holds four numbers, x y z r, got \"{}\"", file.string(), number, text));
    packing.position.push_back(scale * Vec3(n[0], n[1], n[2]));
    packing.radius.push_back(scale * n[3]);
  }
  return packing;
}

}  // namespace

StoredPacking read_packing(const std::filesystem::path& file, Real scale) {
  StoredPacking packing = is_hdf5(file) ? first_frame(file, scale) : lines_of(file, scale);
  if (packing.position.empty()) throw DeckFailure(fmt::format("error: {} holds no element", file.string()));
  for (std::size_t k = 0; k < packing.radius.size(); ++k)
    if (!packing.position[k].allFinite() || !std::isfinite(packing.radius[k]) || packing.radius[k] <= 0)
      throw DeckFailure(fmt::format("error: element {} of {} has a place that is not finite or a radius that is not > 0", k, file.string()));
  return packing;
}

}  // namespace beadwork
