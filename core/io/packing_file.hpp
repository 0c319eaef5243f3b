#pragma once
// A packing that is stored once and used by many decks: centres and radii of elements.

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/types.hpp"

namespace beadwork {

struct StoredPacking {
  std::vector<Vec3> position;
  std::vector<Real> radius;
};

/// Reads the first frame of a run.h5, or a text of lines `x y z r` (blanks or commas between the numbers; a first line
/// of names and lines that begin with # are passed over), each number times `scale`. MachineFailure if the file cannot
/// be opened; DeckFailure with the line if it holds something else, a number that is not finite, or a radius <= 0.
/// Throws DeckFailure also where there is no element.
StoredPacking read_packing(const std::filesystem::path& file, Real scale);

}  // namespace beadwork
