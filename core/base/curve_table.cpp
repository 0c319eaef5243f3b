#include "core/base/curve_table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

namespace beadwork {

namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\"");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1);
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (;;) {
    const auto comma = line.find(',');
    cells.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

CurveValues heading(std::string_view cell) {
  const auto open = cell.rfind('[');
  if (open == std::string_view::npos || !cell.ends_with(']')) return {std::string(cell), "1", {}};
  return {std::string(trimmed(cell.substr(0, open))), std::string(cell.substr(open + 1, cell.size() - open - 2)), {}};
}

std::optional<double> value_of(std::string_view cell) {
  if (cell.empty()) return std::numeric_limits<double>::quiet_NaN();
  if (cell.starts_with('+')) cell.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (end != cell.data() + cell.size()) return std::nullopt;
  if (error == std::errc::result_out_of_range)
    return cell.find("e-") != std::string_view::npos ? 0 : std::numeric_limits<double>::infinity();
  if (error != std::errc()) return std::nullopt;
  return value;
}

bool append_row(CurveTable& table, std::string_view line) {
  const auto cells = cells_of(line);
  if (cells.size() != table.columns.size()) return false;
  std::vector<double> row;
  for (const auto cell : cells) {
    const auto value = value_of(cell);
    if (!value) return false;
    const bool odd = !cell.empty() && !(std::abs(*value) <= largest_drawn);
    table.odd_numbers += odd;
    row.push_back(odd ? std::numeric_limits<double>::quiet_NaN() : *value);
  }
  for (std::size_t c = 0; c < row.size(); ++c) table.columns[c].values.push_back(row[c]);
  return true;
}

}  // namespace

const CurveValues* CurveTable::find(const std::string& name) const {
  const auto found = std::find_if(columns.begin(), columns.end(), [&](const CurveValues& c) { return c.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

CurveTable parse_table(const std::string& text) {
  CurveTable table;
  std::string_view rest = text;
  while (!rest.empty()) {
    const auto end = rest.find('\n');
    const bool whole = end != std::string_view::npos;
    const std::string_view line = trimmed(rest.substr(0, end));
    rest.remove_prefix(whole ? end + 1 : rest.size());
    if (line.empty() || line.starts_with('#')) continue;
    if (table.columns.empty()) {
      for (const auto cell : cells_of(line)) table.columns.push_back(heading(cell));
    } else if (!whole || !append_row(table, line)) {
      ++table.dropped_rows;
    }
  }
  return table;
}

}  // namespace beadwork
