#pragma once
// What the columns of a packing's text hold: by their names, in whatever order, with their units.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/units.hpp"

namespace beadwork {

enum class Holds { x, y, z, radius, diameter, set, id, other };

struct Heading {
  Holds holds = Holds::other;
  std::string name;               ///< as it was written, without the unit
  std::string unit_name = {};     ///< as it was written; empty where none is
  std::optional<Unit> unit = {};  ///< of a length
};

/// A heading such as `x`, `Radius [mm]`, `d (um)`, `z_mm`, `y/mm` or `"r"`; a name that is not known holds something
/// other. Throws std::invalid_argument if a place or a size has a unit that is none of length.
Heading heading_of(std::string_view text);

/// Why these columns do not tell an element: something is missing, or there twice. Empty if they do.
std::string why_no_element(const std::vector<Heading>& columns);

/// What the columns of a text without names hold: x y z radius.
std::vector<Heading> usual_columns();

}  // namespace beadwork
