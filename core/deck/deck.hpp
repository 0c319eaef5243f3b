#pragma once
// The deck: the XML, read once, every node knowing its line and column.

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/complaints.hpp"
#include "core/base/location.hpp"
#include "core/deck/scope.hpp"

namespace beadwork {

/// Where the character text[offset] stands, for a text read from `start` on: entities and line ends are one
/// character.
Location locate(const Location& start, std::size_t offset);

/// A path that a file names stands beside that file: `at` is where it is named.
std::string path_beside(const Location& at, const std::string& path);

struct Attribute {
  std::string name, value;     ///< value with its entities decoded
  Location name_at, value_at;  ///< value_at: its first character, behind the quote

  /// Where the character value[offset] stands in the file.
  Location place(std::size_t offset) const { return locate(value_at, offset); }
};

struct Node {
  std::string tag;
  Location at;  ///< of the tag's name
  std::vector<Attribute> attributes;
  std::vector<std::unique_ptr<Node>> children;

  const Attribute* find(std::string_view name) const;  ///< the attribute, or null
};

/// `--set name=value` of the command line.
struct Override {
  std::string name, value;
};

struct Deck {
  std::unique_ptr<Node> root;  ///< <scene>; includes are spliced in, <include> and <parameter> are gone
  Scope scope;
  std::vector<std::shared_ptr<const Source>> sources;  ///< the deck, then its includes as they were met
  std::vector<Override> overrides;
  std::string sha256;  ///< over the texts of all sources and the overrides
  std::string path;
};

/// Reads a deck and what it includes. Complains about everything that can be said without knowing any plugin;
/// null, with an error, if no tree could be made at all or if a parameter or an include is missing from it.
std::unique_ptr<Deck> read_deck(const std::string& path, const std::vector<Override>& overrides,
                                Complaints& complaints);

}  // namespace beadwork
