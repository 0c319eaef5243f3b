#pragma once
// Curves as CSV, read: the first line names the columns with their units, `step [1],time [s],force [N]`.

#include <string>
#include <vector>

namespace beadwork {

struct CurveValues {
  std::string name, unit;
  std::vector<double> values;  ///< a cell that is empty or `nan` is NaN: a gap in the curve
  bool is_reference() const { return name.starts_with("reference"); }
};

struct CurveTable {
  std::vector<CurveValues> columns;
  int dropped_rows = 0;  ///< rows that were cut off or held something other than numbers
  int odd_numbers = 0;   ///< infinite, no number, or too large to be drawn: gaps, too

  std::size_t rows() const { return columns.empty() ? 0 : columns.front().values.size(); }
  const CurveValues* find(const std::string& name) const;  ///< nullptr if there is none
};

/// A row that is not whole is dropped and counted, and so is a last line without its end, which is still being written.
CurveTable parse_table(const std::string& text);

/// Numbers beyond it are no measure of anything, and their squares overflow.
constexpr double largest_drawn = 1e150;

}  // namespace beadwork
