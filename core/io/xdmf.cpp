#include "core/io/xdmf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace beadwork {

namespace {

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

const XdmfArray& array(const XdmfGrid& grid, std::string_view name) {
  const auto found = std::find_if(grid.arrays.begin(), grid.arrays.end(), [&](const auto& a) { return a.name == name; });
  if (found == grid.arrays.end()) throw std::logic_error(fmt::format("grid '{}' has no array '{}'", grid.name, name));
  return *found;
}

std::string data_item(const XdmfGrid& grid, const XdmfArray& array, std::string_view file) {
  const std::string extent = array.width > 1 ? fmt::format("{} {}", array.rows, array.width) : fmt::format("{}", array.rows);
  const char* type = !array.integer ? "Float" : array.bytes == 1 ? "UChar" : "Int";
  return fmt::format("<DataItem Dimensions=\"{}\" NumberType=\"{}\" Precision=\"{}\" Format=\"HDF\">{}:{}/{}</DataItem>", extent,
                     type, array.bytes, file, escaped(grid.group), escaped(array.name));
}

const char* attribute_type(std::size_t width) { return width == 1 ? "Scalar" : width == 3 ? "Vector" : "Matrix"; }

std::string attributes(const XdmfGrid& grid, std::string_view skip, const char* center, std::string_view file) {
  std::string out;
  for (const XdmfArray& a : grid.arrays)
    if (a.name != skip)
      out += fmt::format("     <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">{}</Attribute>\n", escaped(a.name),
                         attribute_type(a.width), center, data_item(grid, a, file));
  return out;
}

std::string geometry(const XdmfGrid& elements, std::string_view file) {
  return fmt::format("     <Geometry GeometryType=\"XYZ\">{}</Geometry>\n",
                     data_item(elements, array(elements, "position"), file));
}

std::string points(const XdmfGrid& elements, std::string_view file) {
  return fmt::format(
      "    <Grid Name=\"{}\" GridType=\"Uniform\">\n"
      "     <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\" NodesPerElement=\"1\"/>\n{}{}    </Grid>\n",
      escaped(elements.name), array(elements, "position").rows, geometry(elements, file),
      attributes(elements, "position", "Node", file));
}

// Lines name their ends by row, so they share the elements' centres.
std::string lines(const XdmfGrid& bonds, const XdmfGrid& elements, std::string_view file) {
  const XdmfArray& ends = array(bonds, "ends");
  return fmt::format(
      "    <Grid Name=\"{}\" GridType=\"Uniform\">\n"
      "     <Topology TopologyType=\"Polyline\" NumberOfElements=\"{}\" NodesPerElement=\"2\">{}</Topology>\n{}{}    </Grid>\n",
      escaped(bonds.name), ends.rows, data_item(bonds, ends, file), geometry(elements, file),
      attributes(bonds, "ends", "Cell", file));
}

}  // namespace

std::string xdmf_frame(const XdmfFrame& frame, std::string_view file) {
  std::string out = fmt::format("   <Grid Name=\"frame\" GridType=\"Collection\" CollectionType=\"Spatial\">\n"
                                "    <Time Value=\"{}\"/>\n",
                                frame.time);
  out += points(frame.elements, file);
  for (const XdmfGrid& family : frame.bonds)
    if (array(family, "ends").rows > 0) out += lines(family, frame.elements, file);
  return out + "   </Grid>\n";
}

std::string xdmf_document(std::string_view name, const std::vector<std::string_view>& frames) {
  std::string out = fmt::format(
      "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n"
      "<Xdmf Version=\"2.0\">\n <Domain>\n"
      "  <Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Temporal\">\n",
      escaped(name));
  for (const std::string_view frame : frames) out += frame;
  return out + "  </Grid>\n </Domain>\n</Xdmf>\n";
}

}  // namespace beadwork
