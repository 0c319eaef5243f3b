#pragma once
// Writes a tree of plain tags and attributes as canonical XML: the resolved deck, in SI, that goes into every
// result.

#include <string>
#include <utility>
#include <vector>

namespace beadwork {

struct PlainNode {
  std::string tag;
  std::vector<std::pair<std::string, std::string>> attributes;  ///< written in this order
  std::vector<PlainNode> children;
};

/// Two blanks per level, one tag a line, double quotes, everything escaped that must be: equal trees give
/// equal bytes.
std::string resolved_xml(const PlainNode& root);

}  // namespace beadwork
