#pragma once
// JSON as text: the one place where it becomes bytes.

#include <nlohmann/json.hpp>
#include <string>

#include "core/base/utf8.hpp"

namespace beadwork {

/// Every string as safe_text makes it. Calls itself: for JSON of our own, or bounded_json.
template <class Json>
Json safe_json(const Json& json) {
  if (json.is_string()) return safe_text(json.template get_ref<const std::string&>());
  if (!json.is_structured()) return json;
  Json safe = json.is_object() ? Json::object() : Json::array();
  for (const auto& item : json.items()) {
    if (json.is_object())
      safe[safe_text(item.key())] = safe_json(item.value());
    else
      safe.push_back(safe_json(item.value()));
  }
  return safe;
}

/// Whatever the strings hold (a word of a plugin, a line of a file): what is no UTF-8 becomes U+FFFD, instead of an
/// exception that hides what was to be told.
template <class Json>
std::string json_text(const Json& json, int indent = -1) {
  return safe_json(json).dump(indent);
}

}  // namespace beadwork
