#pragma once
// Characters beyond ASCII: what counts as a blank, what cannot be seen, what only looks like a sign that is meant, and
// how text from anywhere is made fit to be shown.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace beadwork {

/// Bytes of the character in UTF-8 that the text begins with; 0 if it begins with none.
std::size_t character_length(std::string_view text);

/// The same bytes, with a space for each byte of a blank beyond ASCII (no-break space, ideographic space ...): offsets
/// stay.
std::string with_plain_blanks(std::string_view text);

/// A character that nobody can see, or that is no text: a zero-width space, a soft hyphen, a control character, a byte
/// that is no UTF-8.
struct Invisible {
  std::size_t at;     ///< its first byte
  std::string words;  ///< "U+200B, a zero-width space"
};
std::optional<Invisible> first_invisible(std::string_view text);

/// The character that the text begins with, for a message; where it only looks like a sign of ASCII, with that sign:
/// "\u2212" (U+2212); write -
std::string named_character(std::string_view text);

/// The first character of the text that only looks like a sign of ASCII (a minus sign, a curly quote): its first byte.
std::optional<std::size_t> first_lookalike(std::string_view text);

/// Text that may be shown and written anywhere (terminal, JSON, XML, HTML): what is no UTF-8, control characters other
/// than tab and line feed, and marks that turn the direction of writing become U+FFFD.
std::string safe_text(std::string_view text);

}  // namespace beadwork
