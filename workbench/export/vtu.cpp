#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "core/base/text.hpp"
#include "workbench/export/formats.hpp"
#include "workbench/report/text.hpp"

namespace beadwork::exported {

namespace {

constexpr const char* head =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"LittleEndian\" "
    "header_type=\"UInt64\">\n";

/// The numbers behind their length in bytes, as base64: VTK's "binary".
template <class T>
std::string array(const std::string& name, const char* type, int width, const std::vector<T>& numbers) {
  const std::uint64_t bytes = numbers.size() * sizeof(T);
  std::string raw(sizeof bytes + bytes, '\0');
  std::copy_n(reinterpret_cast<const char*>(&bytes), sizeof bytes, raw.begin());
  std::copy_n(reinterpret_cast<const char*>(numbers.data()), bytes, raw.begin() + sizeof bytes);
  return fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">{}</DataArray>\n",
                     type, xml_escaped(name), width, report::base64(raw.data(), raw.size()));
}

/// Symmetric tensors as VTK has them, xx yy zz xy yz xz.
std::vector<Real> in_order_of_vtk(const std::vector<Real>& tensors) {
  constexpr std::size_t from[] = {0, 3, 5, 1, 4, 2};
  std::vector<Real> out(tensors.size());
  for (std::size_t k = 0; k < tensors.size(); ++k) out[k] = tensors[k - k % 6 + from[k % 6]];
  return out;
}

std::string array(const Column& column) {
  const std::string name = column.unit == "1" ? column.name : fmt::format("{} [{}]", column.name, column.unit);
  if (column.is_integer) return array(name, "Int64", column.width, column.integers);
  return array(name, "Float64", column.width, column.width == 6 ? in_order_of_vtk(column.reals) : column.reals);
}

std::string data(const char* on, const Grid& grid, const char* place) {
  std::string text = fmt::format("<{}>\n", on);
  for (const Column& column : grid.columns)
    if (column.name != place) text += array(column);
  return text + fmt::format("</{}>\n", on);
}

/// Points, and cells of `each` of them.
std::string unstructured(Real time, const std::vector<Real>& points, const std::vector<std::int64_t>& cells, int each,
                         const std::string& arrays) {
  constexpr std::uint8_t vertex = 1, line = 3;  // VTK's numbers
  const std::size_t count = cells.size() / static_cast<std::size_t>(each);
  std::vector<std::int64_t> offsets(count);
  for (std::size_t k = 0; k < count; ++k) offsets[k] = each * static_cast<std::int64_t>(k + 1);
  const std::vector<std::uint8_t> types(count, each == 1 ? vertex : line);
  return fmt::format(head, "UnstructuredGrid") + "<UnstructuredGrid>\n<FieldData>\n" +
         fmt::format(
             "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" "
             "format=\"ascii\">{}</DataArray>\n</FieldData>\n",
             format_number(time)) +
         fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<Points>\n", points.size() / 3, count) +
         array("position", "Float64", 3, points) + "</Points>\n<Cells>\n" + array("connectivity", "Int64", 1, cells) +
         array("offsets", "Int64", 1, offsets) + array("types", "UInt8", 1, types) + "</Cells>\n" + arrays +
         "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

std::string elements_text(const Moment& moment) {
  std::vector<std::int64_t> cells(moment.elements.rows);
  std::iota(cells.begin(), cells.end(), 0);
  return unstructured(moment.time, moment.elements.at("position").reals, cells, 1,
                      data("PointData", moment.elements, "position"));
}

std::string bonds_text(const Moment& moment, const Grid& family) {
  return unstructured(moment.time, moment.elements.at("position").reals, family.at("ends").integers, 2,
                      data("CellData", family, "ends"));
}

std::string walls_text(const Moment& moment) {
  std::vector<Real> points;
  for (const auto& line : moment.walls)
    for (const Vec3& p : line) points.insert(points.end(), {p.x(), p.y(), p.z()});
  std::vector<std::int64_t> cells(2 * moment.walls.size());
  std::iota(cells.begin(), cells.end(), 0);
  return unstructured(moment.time, points, cells, 2, "");
}

std::string file_of(const std::string& grid, const std::string& moment) { return grid + "-" + moment + ".vtu"; }

}  // namespace

std::vector<std::string> grids_of(const Moment& moment) {
  std::vector<std::string> names{"elements"};
  for (const Grid& family : moment.bonds) names.push_back("bonds-" + family.name);
  if (!moment.walls.empty()) names.emplace_back("walls");
  return names;
}

std::vector<File> as_vtu(const Moment& moment) {
  std::vector<File> files{{file_of("elements", moment.name), elements_text(moment)}};
  for (const Grid& family : moment.bonds)
    files.push_back({file_of("bonds-" + family.name, moment.name), bonds_text(moment, family)});
  if (!moment.walls.empty()) files.push_back({file_of("walls", moment.name), walls_text(moment)});
  return files;
}

std::vector<File> vtu_series(const std::vector<Chapter>& chapters) {
  std::vector<std::string> grids;
  for (const Chapter& chapter : chapters)
    for (const std::string& grid : chapter.grids)
      if (std::find(grids.begin(), grids.end(), grid) == grids.end()) grids.push_back(grid);
  std::vector<File> files;
  for (const std::string& grid : grids) {
    std::string text = fmt::format(head, "Collection") + "<Collection>\n";
    for (const Chapter& chapter : chapters)
      if (std::find(chapter.grids.begin(), chapter.grids.end(), grid) != chapter.grids.end())
        text += fmt::format("<DataSet timestep=\"{}\" file=\"{}\"/>\n", format_number(chapter.time),
                            xml_escaped(file_of(grid, chapter.moment)));
    files.push_back({grid + ".pvd", text + "</Collection>\n</VTKFile>\n"});
  }
  return files;
}

}  // namespace beadwork::exported
