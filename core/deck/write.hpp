#pragma once
// Writes a tree of plain tags and attributes as canonical XML: the resolved deck, in SI, that goes into every
// result.

#include <optional>
#include <string>
#include <vector>

#include "core/base/location.hpp"

namespace beadwork {

struct PlainAttribute {
  std::string name, value;
  Location at = {};  ///< what in the deck it comes of
};

struct PlainNode {
  std::string tag;
  std::vector<PlainAttribute> attributes;  ///< written in this order
  std::vector<PlainNode> children;
  Location at = {};

  const PlainAttribute* find(const std::string& name) const;  ///< the attribute, or null
};

/// Two blanks per level, one tag a line, double quotes, everything escaped that must be: equal trees give
/// equal bytes.
std::string resolved_xml(const PlainNode& root);
/// The tree that such a text holds; nothing if it is none.
std::optional<PlainNode> read_resolved_xml(const std::string& xml);

}  // namespace beadwork
