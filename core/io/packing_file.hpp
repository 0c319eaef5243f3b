#pragma once
// A packing that is stored once and used by many decks: centres and radii of elements, and their sets.

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/base/failure.hpp"
#include "core/base/pause.hpp"
#include "core/base/types.hpp"

namespace beadwork {

/// A set was asked for that the file does not hold.
struct NoSuchSet : DeckFailure {
  using DeckFailure::DeckFailure;
};

struct StoredPacking {
  std::vector<Vec3> position;
  std::vector<Real> radius;
  std::map<std::string, std::vector<std::size_t>> sets = {};  ///< which elements, ascending
  /// Listed neighbours, by the name of their set.
  std::map<std::string, std::vector<std::pair<std::size_t, std::size_t>>> pairs = {};
  std::vector<std::string> warnings = {};
};

/// What a deck says of a text.
struct TextForm {
  std::string unit = {};  ///< of lengths; empty: that of the headings, m where these have none
  std::vector<std::string> columns =
      {};  ///< their headings in order, "-" for one that is passed over; empty: those of the text
};

/// True of a run.h5, whose lengths say themselves in which unit they are.
bool states_its_unit(const std::filesystem::path& file);

/// Why these are no columns of a packing; empty if they are.
std::string why_no_columns(const std::vector<std::string>& columns);

/// Reads the first frame of a run.h5, or a text (packing_text.hpp). MachineFailure if the file cannot be opened;
/// DeckFailure, with line and column where there are any, if it holds something else, a number that is not finite, a
/// radius <= 0, or no element.
StoredPacking read_packing(const std::filesystem::path& file, const TextForm& form, const Pause& pause = never_paused);

/// The members of a set. Throws NoSuchSet.
const std::vector<std::size_t>& members_of(const StoredPacking& packing, const std::string& set,
                                           const std::filesystem::path& file);

/// Those elements alone that are in a set. Throws NoSuchSet.
StoredPacking part_of(const StoredPacking& packing, const std::string& set, const std::filesystem::path& file);

}  // namespace beadwork
