#include "core/base/utf8.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace beadwork {

namespace {

constexpr const char* no_text = "a byte that is no text in UTF-8";

bool continues(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

/// Of a character that is complete.
char32_t code_point(std::string_view character) {
  const auto first = static_cast<unsigned char>(character[0]);
  if (character.size() == 1) return first;
  char32_t code = first & (0x7FU >> character.size());
  for (const char c : character.substr(1)) code = code << 6 | (static_cast<unsigned char>(c) & 0x3FU);
  return code;
}

std::string name_of(char32_t code) { return fmt::format("U+{:04X}", static_cast<unsigned>(code)); }

bool is_blank_beyond_ascii(char32_t c) {
  return c == 0x85 || c == 0xA0 || c == 0x1680 || (c >= 0x2000 && c <= 0x200A) || c == 0x2028 || c == 0x2029 ||
         c == 0x202F || c == 0x205F || c == 0x3000;
}

bool is_control(char32_t c) {
  return (c < 0x20 && c != '\t' && c != '\n' && c != '\r') || (c >= 0x7F && c < 0xA0 && c != 0x85);
}

bool turns_the_direction(char32_t c) {
  return c == 0x061C || c == 0x200E || c == 0x200F || (c >= 0x202A && c <= 0x202E) || (c >= 0x2066 && c <= 0x2069);
}

/// What Unicode lists as Default_Ignorable_Code_Point (DerivedCoreProperties, version 15): shown as nothing where it is
/// not known. Also the blank pattern of Braille, which is a character like any other and shows nothing.
bool is_shown_as_nothing(char32_t c) {
  constexpr struct {
    char32_t first, last;
  } ranges[] = {{0xAD, 0xAD},       {0x034F, 0x034F},   {0x061C, 0x061C},  {0x115F, 0x1160}, {0x17B4, 0x17B5},
                {0x180B, 0x180F},   {0x200B, 0x200F},   {0x202A, 0x202E},  {0x2060, 0x206F}, {0x2800, 0x2800},
                {0x3164, 0x3164},   {0xFE00, 0xFE0F},   {0xFEFF, 0xFEFF},  {0xFFA0, 0xFFA0}, {0xFFF0, 0xFFF8},
                {0x1BCA0, 0x1BCA3}, {0x1D173, 0x1D17A}, {0xE0000, 0xE0FFF}};
  return std::any_of(std::begin(ranges), std::end(ranges),
                     [&](const auto& range) { return c >= range.first && c <= range.last; });
}

/// What an invisible character is, or null.
const char* invisible(char32_t c) {
  if (is_control(c)) return "a control character";
  if (turns_the_direction(c)) return "a mark that turns the direction of writing";
  if (c == 0xAD) return "a soft hyphen";
  if (c == 0x200B) return "a zero-width space";
  if (c == 0x200C || c == 0x200D) return "a zero-width joiner";
  if (c == 0x2060) return "a word joiner";
  if (c == 0xFEFF) return "a byte order mark, which may stand only at the beginning";
  if (is_shown_as_nothing(c)) return "an invisible character";
  return nullptr;
}

struct Lookalike {
  char32_t code;
  const char* sign;
};

constexpr Lookalike lookalikes[] = {
    {0x2010, "-"},  {0x2011, "-"},  {0x2012, "-"},  {0x2013, "-"},  {0x2014, "-"},      {0x2015, "-"},  {0x2212, "-"},
    {0xFE63, "-"},  {0xFF0D, "-"},  {0xD7, "*"},    {0x2217, "*"},  {0x2715, "*"},      {0xF7, "/"},    {0x2044, "/"},
    {0x2215, "/"},  {0xFF0F, "/"},  {0xFF0B, "+"},  {0x2264, "<="}, {0x2265, ">="},     {0x2260, "!="}, {0xFF1C, "<"},
    {0xFF1E, ">"},  {0xFF1D, "="},  {0x2018, "'"},  {0x2019, "'"},  {0x201A, "'"},      {0x2032, "'"},  {0x201C, "\""},
    {0x201D, "\""}, {0x201E, "\""}, {0x2033, "\""}, {0xAB, "\""},   {0xBB, "\""},       {0xFF02, "\""}, {0x2026, "..."},
    {0xFF0C, ","},  {0xFF0E, "."},  {0xFF08, "("},  {0xFF09, ")"},  {0x221A, "sqrt()"}, {0x03C0, "pi"},
};

const char* sign_that_is_meant(char32_t c) {
  const auto found =
      std::find_if(std::begin(lookalikes), std::end(lookalikes), [&](const Lookalike& l) { return l.code == c; });
  return found == std::end(lookalikes) ? nullptr : found->sign;
}

/// Calls visit(offset, length, code) for each character; bytes that are none have length 0. Stops when it returns true.
template <class Visit>
void each_character(std::string_view text, const Visit& visit) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = character_length(text.substr(at));
    if (visit(at, length, length == 0 ? char32_t{0} : code_point(text.substr(at, length)))) return;
    at += std::max<std::size_t>(length, 1);
  }
}

}  // namespace

std::size_t character_length(std::string_view text) {
  if (text.empty()) return 0;
  const auto first = static_cast<unsigned char>(text[0]);
  const std::size_t length = first < 0x80   ? 1
                             : first < 0xC2 ? 0
                             : first < 0xE0 ? 2
                             : first < 0xF0 ? 3
                             : first < 0xF5 ? 4
                                            : 0;
  if (length > text.size()) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if (!continues(text[k])) return 0;
  if (length < 3) return length;
  const char32_t code = code_point(text.substr(0, length));
  const bool is_overlong = code < (length == 3 ? 0x800U : 0x10000U), is_surrogate = code >= 0xD800 && code < 0xE000;
  return is_overlong || is_surrogate || code > 0x10FFFF ? 0 : length;
}

std::string with_plain_blanks(std::string_view text) {
  std::string plain(text);
  each_character(text, [&](std::size_t at, std::size_t length, char32_t code) {
    if (length > 1 && is_blank_beyond_ascii(code)) plain.replace(at, length, length, ' ');
    return false;
  });
  return plain;
}

std::optional<Invisible> first_invisible(std::string_view text) {
  std::optional<Invisible> found;
  each_character(text, [&](std::size_t at, std::size_t length, char32_t code) {
    if (length == 0)
      found = Invisible{at, no_text};
    else if (const char* const what = invisible(code))
      found = Invisible{at, name_of(code) + ", " + what};
    return found.has_value();
  });
  return found;
}

std::string named_character(std::string_view text) {
  const std::size_t length = character_length(text);
  if (length == 0) return no_text;
  const std::string_view character = text.substr(0, length);
  if (length == 1) return "'" + std::string(character) + "'";
  const char32_t code = code_point(character);
  const char* const sign = sign_that_is_meant(code);
  return "'" + std::string(character) + "' (" + name_of(code) + (sign ? std::string("; write ") + sign + ")" : ")");
}

std::optional<std::size_t> first_lookalike(std::string_view text) {
  std::optional<std::size_t> found;
  each_character(text, [&](std::size_t at, std::size_t length, char32_t code) {
    if (length > 1 && sign_that_is_meant(code)) found = at;
    return found.has_value();
  });
  return found;
}

std::string safe_text(std::string_view text) {
  std::string safe;
  safe.reserve(text.size());
  each_character(text, [&](std::size_t at, std::size_t length, char32_t code) {
    const bool is_odd = length == 0 || code == '\r' || code == 0x85 || is_control(code) || turns_the_direction(code) ||
                        (code & 0xFFFEU) == 0xFFFEU;
    safe += is_odd ? "\uFFFD" : text.substr(at, length);
    return false;
  });
  return safe;
}

}  // namespace beadwork
