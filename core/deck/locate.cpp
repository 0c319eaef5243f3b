#include <charconv>

#include "core/deck/deck.hpp"
#include "core/deck/places.hpp"

namespace beadwork {

namespace {

std::size_t utf8_length(unsigned code) { return code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4; }

bool starts_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }

}  // namespace

std::size_t entity_length(std::string_view text, std::size_t* decoded) {
  if (decoded) *decoded = 1;
  for (const std::string_view known : {"&lt;", "&gt;", "&amp;", "&quot;", "&apos;"})
    if (text.starts_with(known)) return known.size();
  const bool is_hex = text.starts_with("&#x");
  if (!is_hex && !text.starts_with("&#")) return 0;
  const char* const begin = text.data() + (is_hex ? 3 : 2);
  unsigned code = 0;
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), code, is_hex ? 16 : 10);
  const bool is_closed = end != text.data() + text.size() && *end == ';';
  const bool is_surrogate = code >= 0xD800 && code < 0xE000;
  if (error != std::errc() || !is_closed || code == 0 || code > 0x10FFFF || is_surrogate) return 0;
  if (decoded) *decoded = utf8_length(code);
  return static_cast<std::size_t>(end - text.data()) + 1;
}

Location locate(const Location& start, std::size_t offset) {
  Location at = start;
  if (!at.source) return at;
  const std::string_view text = at.source->text;
  for (std::size_t passed = 0; passed < offset && at.offset < text.size();) {
    std::size_t raw = 1, decoded = 1;
    const std::string_view rest = text.substr(at.offset);
    if (rest[0] == '&') raw = std::max<std::size_t>(1, entity_length(rest, &decoded));
    if (rest.starts_with("\r\n")) raw = 2;
    if (passed + decoded > offset) break;  // inside a character that an entity stands for
    if (rest[0] == '\n' || rest[0] == '\r') {
      ++at.line;
      at.column = 1;
    } else if (raw > 1) {
      at.column += static_cast<int>(raw);  // entities are ASCII
    } else if (at.offset + 1 >= text.size() || starts_character(text[at.offset + 1])) {
      ++at.column;
    }
    at.offset += raw;
    passed += decoded;
  }
  return at;
}

}  // namespace beadwork
