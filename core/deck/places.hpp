#pragma once
// Where tags and attributes stand in an XML text. TinyXML2, which makes the tree, knows lines but no columns;
// this short pass over the same text supplies them, and points at what is not well-formed.

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/complaints.hpp"

namespace beadwork {

struct AttributePlace {
  Location name, value;
};

struct TagPlace {
  Location name;
  std::vector<AttributePlace> attributes;
};

struct Markup {
  std::vector<TagPlace> tags;  ///< the opening tags, in document order
  std::string text;  ///< for TinyXML2, byte for byte as long: without <? ?>, and every blank beyond ASCII is spaces
};

/// Stops at the first thing that is no XML, with an error.
Markup markup_of(const std::shared_ptr<const Source>& source, Complaints& complaints);

/// The length of the entity that text begins with ("&lt;": 4), 0 if it is none that XML defines; `decoded`
/// gets its length in UTF-8.
std::size_t entity_length(std::string_view text, std::size_t* decoded = nullptr);

}  // namespace beadwork
