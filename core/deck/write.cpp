#include "core/deck/write.hpp"

#include "core/base/text.hpp"

namespace beadwork {

namespace {

void write(const PlainNode& node, std::size_t depth, std::string& xml) {
  const std::string indent(2 * depth, ' ');
  xml += indent + "<" + node.tag;
  for (const auto& [name, value] : node.attributes) xml += " " + name + "=\"" + xml_escaped(value) + "\"";
  if (node.children.empty()) {
    xml += "/>\n";
    return;
  }
  xml += ">\n";
  for (const PlainNode& child : node.children) write(child, depth + 1, xml);
  xml += indent + "</" + node.tag + ">\n";
}

}  // namespace

std::string resolved_xml(const PlainNode& root) {
  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  write(root, 0, xml);
  return xml;
}

}  // namespace beadwork
