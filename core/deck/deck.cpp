#include "core/deck/deck.hpp"

#include <algorithm>
#include <climits>
#include <filesystem>
#include <set>

#include "core/base/readable.hpp"
#include "core/base/sha256.hpp"
#include "core/base/text.hpp"
#include "core/deck/read.hpp"
#include "core/deck/tokens.hpp"
#include "core/deck/xml.hpp"

namespace beadwork {

namespace {

constexpr std::size_t deepest_include = 16, most_files = 256;

class DeckReader {
 public:
  DeckReader(Deck& deck, const std::vector<Override>& overrides, Complaints& complaints)
      : deck_(deck), overrides_(overrides), complaints_(complaints) {}

  /// False if a parameter or an include could not be read: what is said about a deck without it would mislead.
  bool is_whole() const { return is_whole_; }

  /// The tree of a file, with its includes spliced in and its parameters taken out. Null if there is none.
  std::unique_ptr<Node> read(const std::string& path, const Location& asked_at) {
    const auto source = read_source(path, asked_at, complaints_);
    if (!source) return nullptr;
    deck_.sources.push_back(source);
    auto root = parse_xml(source, complaints_);
    if (!root) return nullptr;
    if (root->tag != "scene") {
      complaints_.error(root->at, "the root must be <scene>, not <" + root->tag + ">");
      return nullptr;
    }
    chain_.push_back({path, canonical_path(path)});
    settle(*root, true);
    chain_.pop_back();
    return root;
  }

 private:
  struct File {
    std::string path, canonical;
  };

  /// Replaces the <include> and <parameter> among the children, at any depth.
  void settle(Node& node, bool is_scene) {
    auto children = std::move(node.children);
    node.children.clear();
    for (auto& child : children) {
      if (child->tag == "parameter")
        take_parameter(*child, is_scene);
      else if (child->tag == "include")
        splice(*child, node);
      else {
        settle(*child, false);
        node.children.push_back(std::move(child));
      }
    }
  }

  /// Complains about attributes other than the allowed, missing ones, and children.
  bool has_just(const Node& node, const std::vector<std::string>& allowed) {
    const int before = complaints_.errors();
    for (const Attribute& each : node.attributes)
      if (std::find(allowed.begin(), allowed.end(), each.name) == allowed.end())
        complaints_.error(each.name_at,
                          "no attribute '" + each.name + "' in <" + node.tag + ">" + did_you_mean(each.name, allowed));
    for (const std::string& name : allowed) {
      const Attribute* found = node.find(name);
      if (!found)
        complaints_.error(node.at, "<" + node.tag + "> needs '" + name + "'");
      else if (trim(found->value).empty())
        complaints_.error(found->value_at, "'" + name + "' is empty");
    }
    for (const auto& child : node.children) complaints_.error(child->at, "nothing may stand inside <" + node.tag + ">");
    return complaints_.errors() == before;
  }

  void take_parameter(const Node& node, bool is_in_scene) {
    if (!is_in_scene)
      complaints_.error(node.at, "parameters hold for the whole deck: <parameter> stands directly in <scene>");
    if (!has_just(node, {"name", "value"})) return miss();
    const Attribute &name = *node.find("name"), &value = *node.find("value");
    if (const std::string why = why_no_name(name.value); !why.empty()) {
      complaints_.error(name.value_at, "the name of a parameter " + why + ", got \"" + name.value + "\"");
      return miss();
    }
    deck_.scope.add({name.value, value.value, name.value_at, value.value_at, chain_.size() > 1}, complaints_);
    for (const Override& each : overrides_)  // an include further down may be called by it
      if (each.name == name.value) deck_.scope.set(each.name, each.value, complaints_);
  }

  void splice(const Node& include, Node& into) {
    if (!has_just(include, {"file"})) return miss();
    const Attribute& file = *include.find("file");
    const auto name = text_of(file.value, file.value_at, deck_.scope, complaints_);
    if (!name) return miss();
    const std::string path = path_beside(file.value_at, *name);
    if (!may_include(path, file.value_at)) return miss();
    const auto root = read(path, file.value_at);
    if (!root) return miss();
    for (const Attribute& each : root->attributes)
      complaints_.error(each.name_at, "the <scene> of an included file has no attributes: '" + each.name +
                                          "' belongs into the deck itself");
    for (auto& child : root->children) into.children.push_back(std::move(child));
  }

  bool may_include(const std::string& path, const Location& at) {
    const std::string canonical = canonical_path(path);
    std::string chain;
    for (const File& each : chain_) {
      if (!chain.empty() || each.canonical == canonical) chain += each.path + " -> ";
    }
    if (!chain.empty())
      complaints_.error(at, "this file includes itself: " + chain + path);
    else if (chain_.size() >= deepest_include)
      complaints_.error(at, "includes are nested more than " + std::to_string(deepest_include) + " deep");
    else if (deck_.sources.size() >= most_files)
      complaints_.error(at, "more than " + std::to_string(most_files) + " files are included");
    else
      return true;
    return false;
  }

  void miss() { is_whole_ = false; }

  Deck& deck_;
  const std::vector<Override>& overrides_;
  Complaints& complaints_;
  bool is_whole_ = true;
  std::vector<File> chain_;  // from the deck to the file that is being read
};

void apply(const std::vector<Override>& overrides, Deck& deck, Complaints& complaints) {
  std::set<std::string> seen;
  for (const Override& each : overrides) {
    if (!seen.insert(each.name).second) complaints.error({}, "--set " + each.name + " is given twice");
    deck.scope.set(each.name, each.value, complaints);
  }
}

// Lengths stand before texts, so that moving a line from one file to the next changes the hash.
std::string hash_of(const Deck& deck, const std::vector<Override>& overrides) {
  std::string all;
  const auto add = [&](const std::string& text) { all += std::to_string(text.size()) + ":" + text; };
  for (const auto& source : deck.sources) add(source->text);
  for (const Override& each : overrides) add(each.name), add(each.value);
  return sha256(all);
}

}  // namespace

std::string path_beside(const Location& at, const std::string& path) {
  if (path.size() > PATH_MAX) return path;  // no file has such a name, and to take it apart would take long
  const std::filesystem::path file = at.source ? at.source->path : "";
  return (file.parent_path() / path).lexically_normal().string();
}

const Attribute* Node::find(std::string_view name) const {
  for (const Attribute& each : attributes)
    if (each.name == name) return &each;
  return nullptr;
}

std::unique_ptr<Deck> read_deck(const std::string& path, const std::vector<Override>& overrides,
                                Complaints& complaints) {
  auto deck = std::make_unique<Deck>();
  deck->path = path;
  DeckReader reader(*deck, overrides, complaints);
  deck->root = reader.read(path, {});
  if (!deck->root) return nullptr;
  deck->overrides = overrides;
  apply(overrides, *deck, complaints);
  if (!reader.is_whole()) return nullptr;
  deck->sha256 = hash_of(*deck, overrides);
  return deck;
}

}  // namespace beadwork
