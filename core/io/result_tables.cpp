#include "core/io/result_tables.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "core/base/text.hpp"
#include "core/base/units.hpp"
#include "core/base/utf8.hpp"
#include "core/io/h5.hpp"

namespace beadwork {

namespace {

std::string csv_field(const std::string& raw) {
  const std::string text = safe_text(raw);
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + "\"";
}

std::vector<std::string> column_of(const ResultTable& table, std::size_t column) {
  std::vector<std::string> cells;
  for (const auto& row : table.rows) cells.push_back(safe_text(row[column]));
  return cells;
}

/// In SI.
struct Numbers {
  std::vector<Real> values;
  Dimension dimension;
};

std::optional<Numbers> numbers_of(const std::vector<std::string>& cells) {
  Numbers numbers;
  bool any = false;
  for (const std::string& cell : cells) {
    numbers.values.push_back(NAN);
    if (cell.empty()) continue;
    const auto amount = parse_amount(cell);
    if (!amount || (any && !(amount->unit.dimension == numbers.dimension))) return std::nullopt;
    numbers.values.back() = amount->quantity().value;
    numbers.dimension = amount->unit.dimension;
    any = true;
  }
  if (!any) return std::nullopt;
  return numbers;
}

/// "force [N]" apart: name and unit, which is "1" where none is said.
std::pair<std::string, std::string> apart(const std::string& head) {
  const std::size_t open = head.rfind(" [");
  if (open == std::string::npos || head.back() != ']') return {head, "1"};
  return {head.substr(0, open), head.substr(open + 2, head.size() - open - 3)};
}

std::string dataset_name(const std::string& name, std::map<std::string, int>& met) {
  std::string plain = safe_text(name);
  std::replace(plain.begin(), plain.end(), '/', '-');
  if (plain.empty() || plain == ".") plain = "-";
  const int twin = ++met[plain];
  return twin > 1 ? plain + " (" + std::to_string(twin) + ")" : plain;
}

void write_table(hid_t place, const ResultTable& table) {
  std::map<std::string, int> met;
  std::vector<std::string> order;
  for (std::size_t k = 0; k < table.head.size(); ++k) {
    const auto [name, unit] = apart(table.head[k]);
    order.push_back(dataset_name(name, met));
    const std::vector<std::string> cells = column_of(table, k);
    const auto numbers = numbers_of(cells);
    if (numbers)
      h5::write_reals(place, order.back(), numbers->values, 1,
                      {numbers->dimension.is_plain() ? unit : numbers->dimension.name(), name});
    else
      h5::write_texts(place, order.back(), cells);
  }
  h5::set_texts_attribute(place, "columns", order);
}

}  // namespace

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (std::size_t k = 0; k < cells.size(); ++k) line += (k ? "," : "") + csv_field(cells[k]);
  return line + "\n";
}

std::string csv_of(const ResultTable& table) {
  std::string text = csv_line(table.head);
  for (const auto& row : table.rows) text += csv_line(row);
  return text;
}

void write_result_tables(const std::filesystem::path& file,
                         const std::vector<std::pair<std::string, ResultTable>>& tables) {
  const h5::Silence silence;
  h5::MemoryFile out;
  for (const auto& [name, table] : tables) write_table(h5::make_group(out.id(), name).id(), table);
  write_atomically(file, {out.image()});
}

}  // namespace beadwork
