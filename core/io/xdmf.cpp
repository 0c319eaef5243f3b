#include "core/io/xdmf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "core/base/text.hpp"

namespace beadwork {

namespace {

const XdmfArray& array(const XdmfGrid& grid, std::string_view name) {
  const auto found =
      std::find_if(grid.arrays.begin(), grid.arrays.end(), [&](const auto& a) { return a.name == name; });
  if (found == grid.arrays.end()) throw std::logic_error(fmt::format("grid '{}' has no array '{}'", grid.name, name));
  return *found;
}

std::string data_item(const XdmfGrid& grid, const XdmfArray& array, std::string_view file) {
  const std::string extent =
      array.width > 1 ? fmt::format("{} {}", array.rows, array.width) : fmt::format("{}", array.rows);
  const char* type = !array.integer ? "Float" : array.bytes == 1 ? "UChar" : "Int";
  return fmt::format(
      "<DataItem Dimensions=\"{}\" NumberType=\"{}\" Precision=\"{}\" Format=\"HDF\">{}:{}/{}</DataItem>", extent, type,
      array.bytes, file, xml_escaped(grid.group), xml_escaped(array.name));
}

// Six numbers are a symmetric tensor: xx xy xz yy yz zz, as XDMF has them.
const char* attribute_type(std::size_t width) {
  return width == 1 ? "Scalar" : width == 3 ? "Vector" : width == 6 ? "Tensor6" : "Matrix";
}

std::string attributes(const XdmfGrid& grid, std::string_view skip, const char* center, std::string_view file) {
  std::string out;
  for (const XdmfArray& a : grid.arrays)
    if (a.name != skip)
      out += fmt::format("    <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">{}</Attribute>\n",
                         xml_escaped(a.name), attribute_type(a.width), center, data_item(grid, a, file));
  return out;
}

std::string geometry(const XdmfGrid& elements, std::string_view file) {
  return fmt::format("    <Geometry GeometryType=\"XYZ\">{}</Geometry>\n",
                     data_item(elements, array(elements, "position"), file));
}

std::string uniform(Real time, const std::string& name, const std::string& content) {
  return fmt::format("   <Grid Name=\"{}\" GridType=\"Uniform\">\n    <Time Value=\"{}\"/>\n{}   </Grid>\n",
                     xml_escaped(name), time, content);
}

XdmfPart points(Real time, const XdmfGrid& elements, std::string_view file) {
  const std::string topology =
      fmt::format("    <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\" NodesPerElement=\"1\"/>\n",
                  array(elements, "position").rows);
  const std::string content = topology + geometry(elements, file) + attributes(elements, "position", "Node", file);
  return {elements.name, uniform(time, elements.name, content)};
}

// Lines name their ends by row, so they share the elements' centres.
XdmfPart lines(Real time, const XdmfGrid& bonds, const XdmfGrid& elements, std::string_view file) {
  const XdmfArray& ends = array(bonds, "ends");
  const std::string topology = fmt::format(
      "    <Topology TopologyType=\"Polyline\" NumberOfElements=\"{}\" NodesPerElement=\"2\">{}</Topology>\n",
      ends.rows, data_item(bonds, ends, file));
  const std::string content = topology + geometry(elements, file) + attributes(bonds, "ends", "Cell", file);
  return {bonds.name, uniform(time, bonds.name, content)};
}

}  // namespace

std::vector<XdmfPart> xdmf_parts(const XdmfFrame& frame, std::string_view file) {
  std::vector<XdmfPart> parts;
  if (array(frame.elements, "position").rows > 0) parts.push_back(points(frame.time, frame.elements, file));
  for (const XdmfGrid& family : frame.bonds)
    if (array(family, "ends").rows > 0) parts.push_back(lines(frame.time, family, frame.elements, file));
  return parts;
}

std::string xdmf_document(const std::vector<const XdmfPart*>& parts) {
  std::vector<std::string> grids;
  for (const XdmfPart* part : parts)
    if (std::find(grids.begin(), grids.end(), part->grid) == grids.end()) grids.push_back(part->grid);
  std::string out = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<Xdmf Version=\"2.0\">\n <Domain>\n";
  for (const std::string& grid : grids) {
    out += fmt::format("  <Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Temporal\">\n", xml_escaped(grid));
    for (const XdmfPart* part : parts)
      if (part->grid == grid) out += part->text;
    out += "  </Grid>\n";
  }
  return out + " </Domain>\n</Xdmf>\n";
}

}  // namespace beadwork
