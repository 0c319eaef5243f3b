#include "workbench/export/grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "core/base/text.hpp"

namespace beadwork::exported {

namespace {

Column of_integers(const std::string& name, std::vector<std::int64_t> numbers, int width = 1) {
  return {name, "1", width, true, {}, std::move(numbers)};
}

Column of_vectors(const std::string& name, const std::vector<Vec3>& vectors) {
  Column column{name, "m", 3};
  for (const Vec3& v : vectors) column.reals.insert(column.reals.end(), {v.x(), v.y(), v.z()});
  return column;
}

void in_unit(Grid& grid, const Lengths& lengths) {
  for (Column& column : grid.columns) {
    if (column.unit != "m") continue;
    column.unit = lengths.name;
    for (Real& value : column.reals) value = lengths.unit.from_si(value);
  }
}

void add_fields(Grid& grid, const std::vector<record::FieldValues>& fields) {
  for (const record::FieldValues& field : fields) {
    const std::string unit = field.unit.empty() ? "1" : field.unit;
    grid.columns.push_back({field.name, unit, field.width, false, field.values, {}});
  }
}

Grid elements_of(const record::Frame& frame) {
  Grid grid{"elements", frame.position.size(), {}};
  grid.columns = {of_integers("id", frame.id), of_vectors("position", frame.position), {"radius", "m"}};
  grid.columns.back().reals = frame.radius;
  add_fields(grid, frame.fields);
  return grid;
}

Grid bonds_of(const record::Bonds& bonds) {
  Grid grid{bonds.family, bonds.ends.size(), {}};
  std::vector<std::int64_t> ends, state;
  for (const auto& [i, j] : bonds.ends) ends.insert(ends.end(), {i, j});
  for (const State each : bonds.state) state.push_back(static_cast<std::int64_t>(each));
  grid.columns = {of_integers("id", bonds.id), of_integers("ends", ends, 2), of_integers("state", state)};
  add_fields(grid, bonds.fields);
  return grid;
}

}  // namespace

const std::vector<std::string>& components(int width) {
  static const std::vector<std::string> number{""}, pair{"-1", "-2"}, vector{"-x", "-y", "-z"},
      quaternion{"-w", "-x", "-y", "-z"}, tensor{"-xx", "-xy", "-xz", "-yy", "-yz", "-zz"};
  switch (width) {
    case 1: return number;
    case 2: return pair;
    case 3: return vector;
    case 4: return quaternion;
    case 6: return tensor;
  }
  throw std::logic_error(fmt::format("a column of {} numbers a row has no names for them", width));
}

std::string number(const Column& column, std::size_t at) {
  return column.is_integer ? fmt::to_string(column.integers[at]) : format_number(column.reals[at]);
}

const Column& Grid::at(const std::string& column) const {
  const auto found = std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return c.name == column; });
  if (found == columns.end()) throw std::out_of_range("there is no column '" + column + "'");
  return *found;
}

Moment moment_of(const record::Frame& frame, const Lengths& lengths) {
  Moment moment{fmt::format("{:012}", frame.head.step),
                frame.head.step,
                frame.head.time,
                lengths.name,
                elements_of(frame),
                {},
                {}};
  in_unit(moment.elements, lengths);
  for (const record::Bonds& bonds : frame.bonds) in_unit(moment.bonds.emplace_back(bonds_of(bonds)), lengths);
  for (const auto& [from, to] : frame.walls) {
    const auto there = [&](const Vec3& p) {
      return Vec3(p.unaryExpr([&](Real x) { return lengths.unit.from_si(x); }));
    };
    moment.walls.push_back({there(from), there(to)});
  }
  return moment;
}

Grid breaks_of(const record::Breaks& breaks, const Lengths& lengths) {
  Grid grid{"breaks", breaks.time.size(), {}};
  const auto reals = [&](const char* name, const char* unit, const std::vector<Real>& numbers) {
    if (numbers.size() == grid.rows) grid.columns.push_back({name, unit, 1, false, numbers, {}});
  };
  const auto integers = [&](const char* name, const std::vector<std::int64_t>& numbers) {
    if (numbers.size() == grid.rows) grid.columns.push_back(of_integers(name, numbers));
  };
  integers("step", breaks.step);
  reals("time", "s", breaks.time);
  integers("bond", breaks.bond);
  integers("element", breaks.element);
  if (breaks.place.size() == grid.rows) grid.columns.push_back(of_vectors("place", breaks.place));
  reals("energy", "J", breaks.energy);
  in_unit(grid, lengths);
  return grid;
}

}  // namespace beadwork::exported
