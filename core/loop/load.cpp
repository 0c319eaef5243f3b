#include "core/loop/load.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/failure.hpp"
#include "core/base/readable.hpp"
#include "core/deck/read.hpp"

namespace beadwork {

namespace {

// Those of the deck's 'plugins'.
std::vector<std::filesystem::path> named_libraries(const Deck& deck, bool none, Complaints& complaints) {
  const Attribute* named = deck.root->find("plugins");
  if (!named) return {};
  const auto paths = read_paths(*named, deck.scope, complaints);
  if (!paths) return {};
  if (none) {
    complaints.warning(named->value_at, "these libraries are not loaded (--no-plugins), so their plugins are unknown");
    return {};
  }
  std::vector<std::filesystem::path> libraries;
  for (const std::string& path : *paths) {
    const std::string why = why_unreachable(path);
    std::error_code error;
    if (std::filesystem::status(path, error).type() == std::filesystem::file_type::not_found)
      throw LibraryFailure(
          fmt::format("{}: error: no plugin library: there is no file {}", named->value_at.where(), path));
    if (!why.empty()) refuse(named->value_at, fmt::format("cannot read plugin library \"{}\": {}", path, why));
    libraries.emplace_back(path);
  }
  return libraries;
}

void give(Node& node, const GivenAttribute& given) {
  if (node.tag == given.tag) {
    const auto there = std::find_if(node.attributes.begin(), node.attributes.end(),
                                    [&](const Attribute& each) { return each.name == given.name; });
    if (there == node.attributes.end())
      node.attributes.push_back({given.name, given.value, node.at, node.at});
    else
      there->value = given.value;
  }
  for (const auto& child : node.children) give(*child, given);
}

}  // namespace

Loaded load_scene(const DeckRequest& request, Complaints& complaints) {
  Loaded loaded;
  loaded.deck = read_deck(request.path, request.overrides, complaints);
  if (!loaded.deck) return loaded;
  for (const GivenAttribute& given : request.attributes) give(*loaded.deck->root, given);
  std::vector<std::filesystem::path> extra = named_libraries(*loaded.deck, request.no_plugins, complaints);
  extra.insert(extra.end(), request.libraries.begin(), request.libraries.end());
  loaded.catalogue = Catalogue::open(extra);
  loaded.scene = Scene::assemble(*loaded.deck, loaded.catalogue, complaints);
  return loaded;
}

}  // namespace beadwork
