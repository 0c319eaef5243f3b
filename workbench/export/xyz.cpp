#include <fmt/format.h>

#include <algorithm>

#include "core/base/text.hpp"
#include "workbench/export/formats.hpp"

namespace beadwork::exported {

namespace {

// What separates the properties from one another.
std::string plain(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == ':' || c == '"' || c == '=' || is_blank(c); }, '-');
  return name;
}

std::string head_of(const Moment& moment) {
  // "species" is what readers look for first; X is no chemical element.
  std::string properties = "species:S:1:pos:R:3:id:I:1:radius:R:1";
  for (const Column& column : moment.elements.columns)
    if (column.name != "position" && column.name != "id" && column.name != "radius")
      properties += fmt::format(":{}:{}:{}", plain(column.name), column.is_integer ? 'I' : 'R', column.width);
  return fmt::format("Properties={} pbc=\"F F F\" step={} time={} length_unit=\"{}\"", properties, moment.step,
                     format_number(moment.time), moment.length_unit);
}

void add_row(std::string& text, const Column& column, std::size_t row) {
  for (std::size_t k = 0; k < static_cast<std::size_t>(column.width); ++k)
    text += " " + number(column, static_cast<std::size_t>(column.width) * row + k);
}

std::string elements_text(const Moment& moment) {
  const Grid& elements = moment.elements;
  std::string text = fmt::format("{}\n{}\n", elements.rows, head_of(moment));
  for (std::size_t row = 0; row < elements.rows; ++row) {
    text += "X";
    for (const char* usual : {"position", "id", "radius"}) add_row(text, elements.at(usual), row);
    for (const Column& column : elements.columns)
      if (column.name != "position" && column.name != "id" && column.name != "radius") add_row(text, column, row);
    text += "\n";
  }
  return text;
}

/// A family that lacks a field has zeros there.
void add_field(std::string& text, const Grid& family, const std::pair<std::string, int>& field, std::size_t row) {
  for (const Column& column : family.columns)
    if (column.name == field.first && column.width == field.second) return add_row(text, column, row);
  for (int k = 0; k < field.second; ++k) text += " 0";
}

std::string bounds_of(const Column& position) {
  std::string text;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Real low = 0, high = 0;
    for (std::size_t k = axis; k < position.reals.size(); k += 3) {
      low = k == axis ? position.reals[k] : std::min(low, position.reals[k]);
      high = k == axis ? position.reals[k] : std::max(high, position.reals[k]);
    }
    text += format_number(low) + " " + format_number(high) + "\n";
  }
  return text;
}

std::string bonds_text(const Moment& moment, const Families& all) {
  std::size_t rows = 0;
  for (const Grid& family : moment.bonds) rows += family.rows;
  std::string text = fmt::format(
      "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ENTRIES\n{}\nITEM: BOX BOUNDS ff ff ff\n{}ITEM: ENTRIES family "
      "id element-1 element-2 state",
      moment.step, rows, bounds_of(moment.elements.at("position")));
  for (const auto& [name, width] : all.fields)
    for (const std::string& component : components(width)) text += " " + plain(name + component);
  text += "\n";
  const Column& id = moment.elements.at("id");
  for (const Grid& family : moment.bonds) {
    const auto number_of = std::find(all.names.begin(), all.names.end(), family.name) - all.names.begin() + 1;
    const Column &own = family.at("id"), &ends = family.at("ends"), &state = family.at("state");
    for (std::size_t row = 0; row < family.rows; ++row) {
      const auto end = [&](std::size_t k) { return id.integers[static_cast<std::size_t>(ends.integers[2 * row + k])]; };
      text += fmt::format("{} {} {} {} {}", number_of, own.integers[row], end(0), end(1), state.integers[row]);
      for (const auto& field : all.fields) add_field(text, family, field, row);
      text += "\n";
    }
  }
  return text;
}

}  // namespace

void Families::add(const Moment& moment) {
  for (const Grid& family : moment.bonds) {
    if (std::find(names.begin(), names.end(), family.name) == names.end()) names.push_back(family.name);
    for (const Column& column : family.columns) {
      const std::pair<std::string, int> field{column.name, column.width};
      const bool is_usual = column.name == "id" || column.name == "ends" || column.name == "state";
      if (!is_usual && std::find(fields.begin(), fields.end(), field) == fields.end()) fields.push_back(field);
    }
  }
}

std::vector<File> as_xyz(const Moment& moment, const Families& all) {
  std::vector<File> files{{"elements-" + moment.name + ".xyz", elements_text(moment)}};
  if (!all.names.empty()) files.push_back({"bonds-" + moment.name + ".dump", bonds_text(moment, all)});
  return files;
}

}  // namespace beadwork::exported
