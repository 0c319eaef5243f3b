#include "workbench/law/family.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/base/text.hpp"

namespace beadwork::law {

namespace {

// Nodes of a section, in stages or outside of them.
void add_nodes(const PlainNode& parent, const std::string& section, std::vector<const PlainNode*>& nodes) {
  for (const PlainNode& child : parent.children) {
    if (child.tag == "stage") add_nodes(child, section, nodes);
    if (child.tag != section) continue;
    for (const PlainNode& plugin : child.children) nodes.push_back(&plugin);
  }
}

std::vector<const PlainNode*> nodes_of(const Scene& scene, Kind kind) {
  std::vector<const PlainNode*> nodes;
  add_nodes(scene.resolved_tree, kind_name(kind), nodes);
  return nodes;
}

std::string value_of(const PlainNode& node, const std::string& name) {
  const PlainAttribute* found = node.find(name);
  return found ? found->value : "";
}

void give(PlainNode& node, const std::string& name, const std::string& value) {
  for (PlainAttribute& each : node.attributes)
    if (each.name == name) {
      each.value = value;
      return;
    }
  node.attributes.push_back({name, value});
}

bool drop(PlainNode& node, const std::string& name) {
  return std::erase_if(node.attributes, [&](const PlainAttribute& each) { return each.name == name; }) > 0;
}

// Those that judge this family, or derive of its forces, and no other.
std::vector<PlainNode> about(const Scene& scene, Kind kind, const std::string& family) {
  std::vector<PlainNode> found;
  for (const PlainNode* node : nodes_of(scene, kind)) {
    const auto of = split_words(value_of(*node, "of"));
    if (std::find(of.begin(), of.end(), family) == of.end()) continue;
    give(found.emplace_back(*node), "of", family);
  }
  return found;
}

/// What a bond has of its neighbours one alone cannot have: which of many are meant, a share in an area, a normal that
/// follows from all. Here stands all that `law` knows of single laws.
void stand_alone(Family& family) {
  PlainNode& node = family.node;
  give(node, "between", "first second");
  drop(node, "where");
  if (value_of(node, "area") == "normalised") {
    give(node, "area", "literal");
    drop(node, "interface-area");
    family.remarks.emplace_back("area pi R^2, where the deck scales it to that of its interface");
  }
  const std::string normal = value_of(node, "normal");
  if (normal == "plane" || normal == "axis") {
    give(node, "normal", "plane");
    give(node, "plane-normal", "1 0 0");
    drop(node, "axis-point");
    drop(node, "axis-direction");
    family.remarks.emplace_back("its normal is the line of centres, and is carried by the elements as in the deck");
  }
  for (PlainNode& criterion : family.criteria)
    if (drop(criterion, "weibull"))
      family.remarks.push_back(fmt::format("{} at the mean strength, without scatter", criterion.tag));
}

Family family_of(const Scene& scene, const PairLaw& law, const std::vector<const PlainNode*>& nodes) {
  const auto node = std::find_if(nodes.begin(), nodes.end(),
                                 [&](const PlainNode* each) { return value_of(*each, "name") == law.family(); });
  Family family{.name = law.family(),
                .tag = law.tag(),
                .is_contact = law.kind() == Kind::contact,
                .turns = law.turns(),
                .between = {(*law.between)[0], (*law.between)[1]},
                .node = **node,
                .criteria = about(scene, Kind::fail, law.family()),
                .derived = about(scene, Kind::derive, law.family()),
                .remarks = {}};
  stand_alone(family);
  return family;
}

}  // namespace

std::vector<Family> families_of(const Scene& scene) {
  std::vector<Family> families;
  std::set<std::string> seen;
  const auto bonds = nodes_of(scene, Kind::bond), contacts = nodes_of(scene, Kind::contact);
  for (const Stage& stage : scene.stages)
    for (const BondLaw* law : stage.laws)
      if (seen.insert(law->family()).second) families.push_back(family_of(scene, *law, bonds));
  for (const Stage& stage : scene.stages)
    for (const ContactLaw* law : stage.contacts)
      if (!law->faces_walls() && seen.insert(law->family()).second)
        families.push_back(family_of(scene, *law, contacts));
  return families;
}

}  // namespace beadwork::law
