#pragma once
// What the verbs say. Everything goes through here, so that no deck, path or plugin can send a terminal what is no
// text.

#include <fmt/format.h>

#include <string_view>

namespace beadwork {

/// Writes safe_text to standard output, or to standard error.
void write_out(std::string_view text);
void write_error(std::string_view text);

template <class... Args>
void say(fmt::format_string<Args...> format, Args&&... args) {
  write_out(fmt::format(format, std::forward<Args>(args)...));
}

template <class... Args>
void say_error(fmt::format_string<Args...> format, Args&&... args) {
  write_error(fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace beadwork
