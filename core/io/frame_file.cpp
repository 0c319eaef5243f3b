#include "core/io/frame_file.hpp"

#include <algorithm>

#include "core/io/wall_outlines.hpp"

namespace beadwork {

namespace {

// The named columns first, then the asked-for ones that are not among them.
void write_columns(hid_t group, const Table& table, std::initializer_list<const char*> always,
                   const std::vector<const Column*>& asked) {
  std::vector<const Column*> columns;
  for (const char* name : always) columns.push_back(&table.column(name));
  for (const Column* column : asked)
    if (std::find(columns.begin(), columns.end(), column) == columns.end()) columns.push_back(column);
  for (const Column* column : columns) h5::write_column(group, *column, table.size());
}

void write_family(hid_t place, const FamilyRequest& request) {
  const BondTable& table = *request.table;
  const h5::Handle group = h5::make_group(place, table.name());
  h5::set_attribute(group.id(), "law", request.law);
  std::vector<Index> ends;
  ends.reserve(2 * static_cast<std::size_t>(table.size()));
  for (Index bond = 0; bond < table.size(); ++bond)
    ends.insert(ends.end(), {table.first()[bond], table.second()[bond]});
  h5::write_indices(group.id(), "ends", ends, 2, {"1", "Rows of the two elements in this frame"});
  write_columns(group.id(), table.rows(), {"id", "state"}, request.columns);
}

// A frame of a scene without walls has no word of them.
void write_walls(hid_t group, const Domain& domain) {
  std::vector<Real> numbers;
  for (const auto& line : wall_outlines(domain))
    for (const Vec3& end : line) numbers.insert(numbers.end(), end.begin(), end.end());
  if (!numbers.empty()) h5::write_reals(group, "walls", numbers, 6, {"m", "Lines that show the walls: from and to"});
}

XdmfGrid describe_grid(hid_t place, const std::string& name, const std::string& title, const std::string& path) {
  XdmfGrid grid{title, path, {}};
  const h5::Handle group = h5::open_group(place, name);
  for (const std::string& dataset : h5::names_in(group.id())) {
    const h5::Shape shape = h5::shape_of(group.id(), dataset);
    XdmfArray array{dataset, 0, 1, shape.integer, shape.bytes};
    if (!shape.extent.empty()) array.rows = shape.extent[0];
    if (shape.extent.size() > 1) array.width = shape.extent[1];
    grid.arrays.push_back(array);
  }
  return grid;
}

}  // namespace

void write_frame(hid_t group, const FrameStamp& stamp, const FrameRequest& request, const Domain& domain) {
  h5::set_attribute(group, "time", stamp.time);
  h5::set_attribute(group, "step", stamp.step);
  h5::set_attribute(group, "stage", static_cast<std::int64_t>(stamp.stage));
  if (request.picture) h5::set_attribute(group, "picture", std::int64_t{1});
  if (!request.view.empty()) h5::set_attribute(group, "view", request.view);
  const h5::Handle elements = h5::make_group(group, "elements");
  write_columns(elements.id(), domain.elements(), {"id", "position", "radius"}, request.elements);
  write_walls(group, domain);
  const h5::Handle bonds = h5::make_group(group, "bonds");
  for (const FamilyRequest& family : request.bonds) write_family(bonds.id(), family);
}

XdmfFrame describe_frame(hid_t group, const std::string& place) {
  XdmfFrame frame;
  frame.time = h5::real_attribute(group, "time");
  frame.elements = describe_grid(group, "elements", "elements", place + "/elements");
  const h5::Handle bonds = h5::open_group(group, "bonds");
  for (const std::string& family : h5::names_in(bonds.id()))
    frame.bonds.push_back(describe_grid(bonds.id(), family, "bonds " + family, place + "/bonds/" + family));
  return frame;
}

}  // namespace beadwork
