#pragma once
// JSON as text, the one place where it becomes bytes.

#include <nlohmann/json.hpp>
#include <string>

namespace beadwork {

/// Whatever the strings hold: control characters are escaped, and what is no UTF-8 (a word of a plugin, a line of a file) becomes
/// U+FFFD instead of an exception that hides what was to be told.
template <class Json>
std::string json_text(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace beadwork
