#include "core/io/packing_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"
#include "core/io/frame_reader.hpp"
#include "core/io/packing_text.hpp"

namespace beadwork {

namespace {

using Places = std::unordered_map<std::int64_t, std::size_t>;  // of ids in a frame

Places places_of(const record::Frame& frame) {
  Places place;
  for (std::size_t k = 0; k < frame.id.size(); ++k) place.emplace(frame.id[k], k);
  return place;
}

std::map<std::string, std::vector<std::pair<std::size_t, std::size_t>>> recorded_pairs(
    const record::FrameReader& reader, const Places& place) {
  std::map<std::string, std::vector<std::pair<std::size_t, std::size_t>>> pairs;
  for (const auto& [name, ids] : reader.pairs())
    for (std::size_t k = 0; k + 1 < ids.size(); k += 2) {
      const auto one = place.find(ids[k]), other = place.find(ids[k + 1]);
      if (one != place.end() && other != place.end() && one != other)
        pairs[name].push_back(std::minmax(one->second, other->second));
    }
  return pairs;
}

std::map<std::string, std::vector<std::size_t>> recorded_sets(const record::FrameReader& reader, const Places& place) {
  std::map<std::string, std::vector<std::size_t>> sets;
  for (const auto& [name, ids] : reader.sets()) {
    auto& members = sets[name];
    for (const std::int64_t id : ids)
      if (const auto found = place.find(id); found != place.end()) members.push_back(found->second);
    std::sort(members.begin(), members.end());
    members.erase(std::unique(members.begin(), members.end()), members.end());
    if (members.empty() && !ids.empty()) sets.erase(name);  // of walls
  }
  return sets;
}

// They are elements without a radius.
void leave_out_walls(record::Frame& frame) {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < frame.radius.size(); ++k) {
    if (frame.radius[k] == 0) continue;
    frame.id[kept] = frame.id[k];
    frame.position[kept] = frame.position[k];
    frame.radius[kept++] = frame.radius[k];
  }
  frame.id.resize(kept);
  frame.position.resize(kept);
  frame.radius.resize(kept);
}

StoredPacking first_frame(const std::filesystem::path& file) {
  const record::FrameReader reader(file, SymbolicLinks::follow);
  if (reader.frames().empty())
    throw DeckFailure(fmt::format("error: {} holds no frame to take a packing from", file.string()));
  record::Frame frame = reader.read(reader.frames().front());
  leave_out_walls(frame);
  const Places place = places_of(frame);
  StoredPacking packing{std::move(frame.position), std::move(frame.radius), recorded_sets(reader, place),
                        recorded_pairs(reader, place)};
  for (std::size_t k = 0; k < packing.radius.size(); ++k)
    if (!packing.position[k].allFinite() || !std::isfinite(packing.radius[k]) || packing.radius[k] <= 0)
      throw DeckFailure(fmt::format(
          "error: element {} of {} has a place that is not finite or a radius that is not > 0", k, file.string()));
  return packing;
}

}  // namespace

bool states_its_unit(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  return extension == ".h5" || extension == ".hdf5";
}

std::string why_no_columns(const std::vector<std::string>& columns) {
  std::vector<Heading> headings;
  for (const std::string& column : columns) {
    if (column == "-") continue;
    try {
      headings.push_back(heading_of(column));
    } catch (const std::invalid_argument& wrong) {
      return wrong.what();
    }
    if (headings.back().holds == Holds::other)
      return "no column is called \"" + column +
             "\"; known: x, y, z, radius (r), diameter (d), set, id, and - for one that is passed over";
  }
  return why_no_element(headings);
}

StoredPacking read_packing(const std::filesystem::path& file, const TextForm& form, const Pause& pause) {
  StoredPacking packing = states_its_unit(file) ? first_frame(file) : read_packing_text(file, form, pause);
  if (packing.position.empty()) throw DeckFailure(fmt::format("error: {} holds no element", file.string()));
  return packing;
}

const std::vector<std::size_t>& members_of(const StoredPacking& packing, const std::string& set,
                                           const std::filesystem::path& file) {
  const auto found = packing.sets.find(set);
  if (found != packing.sets.end()) return found->second;
  std::vector<std::string> known;
  for (const auto& each : packing.sets) known.push_back(each.first);
  throw NoSuchSet(fmt::format("{} has no set '{}'{}", file.string(), set,
                              known.empty() ? ", nor any other" : did_you_mean(set, known)));
}

StoredPacking part_of(const StoredPacking& packing, const std::string& set, const std::filesystem::path& file) {
  const std::vector<std::size_t>& members = members_of(packing, set, file);
  StoredPacking part;
  part.warnings = packing.warnings;
  std::unordered_map<std::size_t, std::size_t> place;
  for (const std::size_t k : members) {
    place.emplace(k, part.position.size());
    part.position.push_back(packing.position[k]);
    part.radius.push_back(packing.radius[k]);
  }
  for (const auto& [name, others] : packing.sets) {
    std::vector<std::size_t>& kept = part.sets[name];  // also one that has no member here
    for (const std::size_t k : others)
      if (const auto here = place.find(k); here != place.end()) kept.push_back(here->second);
  }
  for (const auto& [name, list] : packing.pairs)
    for (const auto& [first, second] : list) {
      const auto one = place.find(first), other = place.find(second);
      if (one != place.end() && other != place.end())
        part.pairs[name].push_back(std::minmax(one->second, other->second));
    }
  return part;
}

}  // namespace beadwork
