#pragma once
// Reads JSON that anybody may have written: how deep it may be nested is bounded, since what walks over it afterwards calls itself.

#include <nlohmann/json.hpp>
#include <string_view>

namespace beadwork {

inline constexpr int deepest_json = 64;

/// The JSON of a text; a discarded value where it is none, or nested deeper than any of ours.
template <class Json = nlohmann::ordered_json>
Json bounded_json(std::string_view text) {
  bool too_deep = false;
  const typename Json::parser_callback_t stop = [&](int depth, typename Json::parse_event_t, Json&) {
    too_deep |= depth > deepest_json;
    return !too_deep;  // what lies below is dropped while it is read
  };
  Json json = Json::parse(text, stop, false);
  return too_deep ? Json(Json::value_t::discarded) : json;
}

}  // namespace beadwork
