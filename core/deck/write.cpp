#include "core/deck/write.hpp"

#include "core/base/text.hpp"
#include "core/deck/deck.hpp"
#include "core/deck/xml.hpp"

namespace beadwork {

namespace {

void write(const PlainNode& node, std::size_t depth, std::string& xml) {
  const std::string indent(2 * depth, ' ');
  xml += indent + "<" + node.tag;
  for (const PlainAttribute& each : node.attributes) xml += " " + each.name + "=\"" + xml_escaped(each.value) + "\"";
  if (node.children.empty()) {
    xml += "/>\n";
    return;
  }
  xml += ">\n";
  for (const PlainNode& child : node.children) write(child, depth + 1, xml);
  xml += indent + "</" + node.tag + ">\n";
}

PlainNode plain(const Node& node) {
  PlainNode made{node.tag, {}, {}, node.at};
  for (const Attribute& each : node.attributes) made.attributes.push_back({each.name, each.value, each.value_at});
  for (const auto& child : node.children) made.children.push_back(plain(*child));
  return made;
}

}  // namespace

const PlainAttribute* PlainNode::find(const std::string& name) const {
  for (const PlainAttribute& each : attributes)
    if (each.name == name) return &each;
  return nullptr;
}

std::string resolved_xml(const PlainNode& root) {
  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  write(root, 0, xml);
  return xml;
}

std::optional<PlainNode> read_resolved_xml(const std::string& xml) {
  Complaints complaints;
  const auto root = parse_xml(std::make_shared<const Source>(Source{"resolved.xml", xml}), complaints);
  if (!root) return {};
  return plain(*root);
}

}  // namespace beadwork
