#include <fmt/format.h>

#include "core/io/result_tables.hpp"
#include "workbench/export/formats.hpp"

namespace beadwork::exported {

namespace {

// Columns of words stand behind those of numbers.
using Words = std::vector<std::pair<std::string, const std::vector<std::string>*>>;

std::string table(const Grid& grid, const Words& words = {}) {
  std::vector<std::string> head;
  for (const Column& column : grid.columns)
    for (const std::string& component : components(column.width))
      head.push_back(fmt::format("{}{} [{}]", column.name, component, column.unit));
  for (const auto& [name, column] : words) head.push_back(name);
  std::string text = csv_line(head);
  for (std::size_t row = 0; row < grid.rows; ++row) {
    std::vector<std::string> cells;
    for (const Column& column : grid.columns)
      for (std::size_t k = 0; k < static_cast<std::size_t>(column.width); ++k)
        cells.push_back(number(column, static_cast<std::size_t>(column.width) * row + k));
    for (const auto& [name, column] : words) cells.push_back((*column)[row]);
    text += csv_line(cells);
  }
  return text;
}

/// With the ids of the elements that a bond joins in the place of their rows.
Grid with_ids(Grid bonds, const Grid& elements) {
  const Column& id = elements.at("id");
  for (Column& column : bonds.columns) {
    if (column.name != "ends") continue;
    column.name = "element";
    for (std::int64_t& end : column.integers) end = id.integers[static_cast<std::size_t>(end)];
  }
  return bonds;
}

}  // namespace

std::vector<File> as_csv(const Moment& moment) {
  std::vector<File> files{{"elements-" + moment.name + ".csv", table(moment.elements)}};
  for (const Grid& family : moment.bonds)
    files.push_back(
        {fmt::format("bonds-{}-{}.csv", family.name, moment.name), table(with_ids(family, moment.elements))});
  return files;
}

std::vector<File> as_csv(const record::Breaks& breaks, const Lengths& lengths) {
  Words words;
  if (breaks.family.size() == breaks.time.size()) words.emplace_back("family", &breaks.family);
  words.emplace_back("mode", &breaks.mode);
  return {{"breaks.csv", table(breaks_of(breaks, lengths), words)}};
}

}  // namespace beadwork::exported
