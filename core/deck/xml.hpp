#pragma once
// From a file to a tree of nodes with places. The only part that knows TinyXML2.

#include <memory>
#include <string>

#include "core/deck/deck.hpp"

namespace beadwork {

/// The text of a file. Null, with an error at `asked_at`, if it cannot be read, is too large or is no text.
std::shared_ptr<const Source> read_source(const std::string& path, const Location& asked_at, Complaints& complaints);

/// The tree as it stands in the file, <include> and <parameter> too. Null, with an error, if it is not
/// well-formed.
std::unique_ptr<Node> parse_xml(const std::shared_ptr<const Source>& source, Complaints& complaints);

}  // namespace beadwork
