#pragma once
// Small helpers on text: numbers without a locale, words, and the suggestion after a misspelt name.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace beadwork {

/// The candidate nearest to the word by Damerau-Levenshtein distance, or "" if none is near.
std::string closest(std::string_view word, const std::vector<std::string>& candidates);

/// What a complaint about an unknown name ends with: ". Did you mean <beam>?" or, where nothing is near and
/// the list is short, "; known: beam, spring". `open` and `close` stand around the suggestion.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates, std::string_view open = "'",
                         std::string_view close = "'");

/// What separates words. Blanks beyond ASCII become these where a text comes in (with_plain_blanks in utf8.hpp).
inline constexpr std::string_view blanks = " \t\r\n\f\v";
inline bool is_blank(char c) { return blanks.find(c) != std::string_view::npos; }

/// What some editors and tables put before a text in UTF-8; it is no part of the text.
inline constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// The whole text as a finite decimal number with a point; nothing for "0,3", "1 ", "nan", "inf", "0x1", "".
std::optional<double> parse_number(std::string_view text);

/// The shortest text that reads back to the same number.
std::string format_number(double value);

std::string_view trim(std::string_view text);
std::vector<std::string> split_words(std::string_view text);            ///< at white space; no empty words
std::vector<std::string> split(std::string_view text, char separator);  ///< keeps empty pieces
std::string join(const std::vector<std::string>& words, std::string_view separator = ", ");
std::string shell_quoted(
    std::string_view word);  ///< as one word of one line of bash; as it is where that needs no quotes
std::string xml_escaped(std::string_view text);  ///< for an attribute in double quotes; safe_text

/// Whether this can name a set, a family or a curve: names stand in lists, in files and their names.
bool is_plain_name(std::string_view name);
inline constexpr std::string_view plain_name = "a name without blanks, slashes and quotes, of at most 100 letters";

/// For a folder or a file: what a name should not have becomes '-'.
std::string as_file_name(std::string text);

/// A line that stands in one of two texts only.
struct OddLine {
  bool in_second;
  std::size_t number;  ///< in its text, from 0
};
/// The fewest lines by which two texts differ (what is left of a longest common subsequence), in their order.
std::vector<OddLine> odd_lines(const std::vector<std::string>& first, const std::vector<std::string>& second);

}  // namespace beadwork
