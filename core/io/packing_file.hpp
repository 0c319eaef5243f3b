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

/// True of a run.h5, whose lengths say themselves in which unit they are.
bool states_its_unit(const std::filesystem::path& file);

/// Reads the first frame of a run.h5, or a text of lines `x y z r` (blanks or commas between the numbers), its numbers
/// times `scale`. In a text, lines that begin with # are passed over, and the first other one if no word of it is a
/// number: names of the columns. MachineFailure if the file cannot be opened; DeckFailure, with the line where there is
/// one, if it holds something else, a number that is not finite, a radius <= 0, or no element.
StoredPacking read_packing(const std::filesystem::path& file, Real scale);

}  // namespace beadwork
