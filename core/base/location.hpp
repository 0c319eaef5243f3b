#pragma once
// Where something stands in a text: what every complaint about a deck points at.

#include <cstddef>
#include <memory>
#include <string>

namespace beadwork {

/// A text and the name it is known by: a file, or an option of the command line.
struct Source {
  std::string path, text;
};

/// A character of a source. Lines and columns count from 1, a column is one code point; 0 means unknown.
struct Location {
  std::shared_ptr<const Source> source;
  int line = 0, column = 0;
  std::size_t offset = 0;  ///< of the character in the text, in bytes

  /// "path:line:column", as far as known.
  std::string where() const;
};

}  // namespace beadwork
