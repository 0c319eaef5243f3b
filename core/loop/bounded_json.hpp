#pragma once
// Reads JSON that anybody may have written: how deep it may be nested is bounded, since what walks over it afterwards
// calls itself.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/io/file.hpp"

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

/// The object in a file of a run; an empty one where there is no regular file of bearable length, or where it holds
/// something else.
template <class Json = nlohmann::ordered_json>
Json bounded_object(const std::filesystem::path& file) {
  constexpr std::uintmax_t longest = std::uintmax_t{1} << 26;
  try {
    Json json = bounded_json<Json>(read_text(file, longest));
    return json.is_object() ? json : Json::object();
  } catch (const MachineFailure&) {
    return Json::object();
  }
}

}  // namespace beadwork
