#pragma once
// What is exported of a frame: grids of points and of lines between them, whose columns each format writes in its way.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/units.hpp"
#include "core/io/frame_reader.hpp"

namespace beadwork::exported {

/// `width` numbers a row, row by row: integers or reals, the other is empty.
struct Column {
  std::string name, unit = "1";
  int width = 1;
  bool is_integer = false;
  std::vector<Real> reals = {};
  std::vector<std::int64_t> integers = {};
};
/// What is put behind the name of a column for each of its components: "-x" "-y" "-z", "-xx" ...; "" for a number.
const std::vector<std::string>& components(int width);
/// One number of a column, the shortest text that reads back to the same.
std::string number(const Column& column, std::size_t at);

struct Grid {
  std::string name;  ///< "elements", "resin"
  std::size_t rows = 0;
  std::vector<Column> columns;
  /// Throws std::out_of_range where there is none.
  const Column& at(const std::string& column) const;
};

struct Moment {
  std::string name;  ///< of its files: twelve digits of the step, so that they sort
  std::int64_t step = 0;
  Real time = 0;            ///< [s]
  std::string length_unit;  ///< of positions and radii
  Grid elements;            ///< id, position, radius, and what was recorded
  std::vector<Grid> bonds;  ///< id, ends (rows of the elements), state (0 intact, 1 softening, 2 broken), and so on
  std::vector<std::array<Vec3, 2>> walls;  ///< lines that show them
};

/// The unit in which lengths are written; all else is in SI.
struct Lengths {
  std::string name = "m";
  Unit unit = {};
};

Moment moment_of(const record::Frame& frame, const Lengths& lengths);
Grid breaks_of(const record::Breaks& breaks, const Lengths& lengths);

}  // namespace beadwork::exported
