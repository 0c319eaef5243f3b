#include "core/io/packing_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>
#include <utility>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"
#include "core/io/frame_reader.hpp"

namespace beadwork {

namespace {

StoredPacking first_frame(const std::filesystem::path& file) {
  const record::FrameReader reader(file, Links::follow);
  if (reader.frames().empty()) throw DeckFailure(fmt::format("error: {} holds no frame to take a packing from", file.string()));
  record::Frame frame = reader.read(reader.frames().front());
  return {std::move(frame.position), std::move(frame.radius)};
}

std::vector<std::string> words_of(std::string line) {
  std::replace(line.begin(), line.end(), ',', ' ');
  return split_words(line);
}

bool no_number_among(const std::vector<std::string>& words) {
  return std::none_of(words.begin(), words.end(), [](const std::string& word) { return parse_number(word).has_value(); });
}

/// The four numbers of a line; nothing if it holds anything else.
std::optional<std::array<Real, 4>> element_of(const std::vector<std::string>& words) {
  std::array<Real, 4> numbers;
  if (words.size() != numbers.size()) return std::nullopt;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const auto number = parse_number(words[k]);
    if (!number) return std::nullopt;
    numbers[k] = *number;
  }
  return numbers;
}

StoredPacking lines_of(const std::filesystem::path& file, Real scale) {
  std::ifstream stream(file);
  if (!stream) throw MachineFailure(fmt::format("cannot read \"{}\": {}", file.string(), std::strerror(errno)));
  StoredPacking packing;
  std::string line;
  bool names_may_come = true;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (number == 1 && line.starts_with(byte_order_mark)) line.erase(0, byte_order_mark.size());
    const std::string text(trim(line));
    if (text.empty() || text[0] == '#') continue;
    const auto words = words_of(text);
    if (std::exchange(names_may_come, false) && no_number_among(words)) continue;
    const auto n = element_of(words);
    if (!n) throw DeckFailure(fmt::format("{}:{}: error: a line holds four numbers, x y z r, got \"{}\"", file.string(), number, text));
    packing.position.push_back(scale * Vec3((*n)[0], (*n)[1], (*n)[2]));
    packing.radius.push_back(scale * (*n)[3]);
  }
  return packing;
}

}  // namespace

bool states_its_unit(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  return extension == ".h5" || extension == ".hdf5";
}

StoredPacking read_packing(const std::filesystem::path& file, Real scale) {
  StoredPacking packing = states_its_unit(file) ? first_frame(file) : lines_of(file, scale);
  if (packing.position.empty()) throw DeckFailure(fmt::format("error: {} holds no element", file.string()));
  for (std::size_t k = 0; k < packing.radius.size(); ++k)
    if (!packing.position[k].allFinite() || !std::isfinite(packing.radius[k]) || packing.radius[k] <= 0)
      throw DeckFailure(fmt::format("error: element {} of {} has a place that is not finite or a radius that is not > 0", k, file.string()));
  return packing;
}

}  // namespace beadwork
