#include "core/base/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <span>

#include "core/base/utf8.hpp"

namespace beadwork {

namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

// Edits (insert, delete, replace, swap neighbours) from a to b; optimal string alignment.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

std::size_t allowed_edits(std::size_t length) { return length < 2 ? 0 : length <= 4 ? 1 : length <= 8 ? 2 : 3; }

// Length of the longest common subsequence of a from i on and b from j on, at i * (b.size() + 1) + j.
std::vector<std::uint32_t> common_lines(std::span<const std::string> a, std::span<const std::string> b) {
  const std::size_t width = b.size() + 1;
  std::vector<std::uint32_t> common((a.size() + 1) * width, 0);
  for (std::size_t i = a.size(); i-- > 0;)
    for (std::size_t j = b.size(); j-- > 0;) {
      const std::size_t here = i * width + j;
      common[here] = a[i] == b[j] ? common[here + width + 1] + 1 : std::max(common[here + width], common[here + 1]);
    }
  return common;
}

}  // namespace

std::string closest(std::string_view word, const std::vector<std::string>& candidates) {
  constexpr std::size_t longest = 100;  // nobody misspells a novel, and the work grows with the square
  if (word.empty() || word.size() > longest) return {};
  const std::string folded = lower(word);
  const std::string* best = nullptr;
  std::pair<std::size_t, std::size_t> best_edits{allowed_edits(word.size()), longest};  // case folded, then exact
  for (const std::string& candidate : candidates) {
    if (candidate.size() > longest) continue;
    const std::pair edits{distance(folded, lower(candidate)), distance(word, candidate)};
    if (edits < best_edits || (!best && edits == best_edits)) {
      best = &candidate;
      best_edits = edits;
    }
  }
  if (best) return *best;
  constexpr std::size_t telling = 3;  // letters of a part that says which whole is meant
  if (word.size() < telling) return {};
  for (const std::string& candidate : candidates)
    if (lower(candidate).find(folded) != std::string::npos && (!best || candidate.size() < best->size()))
      best = &candidate;
  return best ? *best : std::string();
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates, std::string_view open,
                         std::string_view close) {
  constexpr std::size_t short_list = 12;
  if (const std::string near = closest(word, candidates); !near.empty())
    return ". Did you mean " + std::string(open) + near + std::string(close) + "?";
  if (candidates.empty() || candidates.size() > short_list) return {};
  return "; known: " + join(candidates);
}

std::optional<double> parse_number(std::string_view text) {
  if (text.starts_with('+')) {
    text.remove_prefix(1);
    if (text.starts_with('-')) return {};
  }
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

std::string format_number(double value) {
  char buffer[40];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

std::string_view trim(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::vector<std::string> split_words(std::string_view text) {
  std::vector<std::string> words;
  for (std::size_t begin = text.find_first_not_of(blanks); begin != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(blanks, begin), text.size());
    words.emplace_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(blanks, end);
  }
  return words;
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> pieces;
  for (std::size_t end; (end = text.find(separator)) != std::string_view::npos; text.remove_prefix(end + 1))
    pieces.emplace_back(text.substr(0, end));
  pieces.emplace_back(text);
  return pieces;
}

std::string join(const std::vector<std::string>& words, std::string_view separator) {
  std::string text;
  for (const std::string& word : words) {
    if (&word != &words.front()) text += separator;
    text += word;
  }
  return text;
}

bool is_plain_name(std::string_view name) {
  const auto plain = [](unsigned char c) { return c > ' ' && c != 127 && c != '/' && c != '\\' && c != '"'; };
  return name.size() <= 100 && name.find_first_not_of('.') != std::string_view::npos &&
         std::all_of(name.begin(), name.end(), plain);
}

std::string shell_quoted(std::string_view word) {
  const auto is_safe = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("_./:,+@%=-").find(c) != std::string_view::npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), is_safe)) return std::string(word);
  // A line break in a value must not begin a command.
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 127; };
  const bool any_control = std::any_of(word.begin(), word.end(), is_control);
  std::string text = any_control ? "$'" : "'";
  for (const char c : word) {
    if (is_control(c))
      text += fmt::format("\\{:03o}", static_cast<unsigned char>(c));
    else if (c == '\'')
      text += any_control ? "\\'" : "'\\''";
    else if (c == '\\' && any_control)
      text += "\\\\";
    else
      text += c;
  }
  return text + "'";
}

std::string xml_escaped(std::string_view text) {
  std::string result;
  const auto escape = [&](std::string_view line) {
    for (const char c : safe_text(line)) {
      if (c == '&')
        result += "&amp;";
      else if (c == '<')
        result += "&lt;";
      else if (c == '>')
        result += "&gt;";
      else if (c == '"')
        result += "&quot;";
      else if (c == '\n')
        result += "&#10;";
      else if (c == '\t')
        result += "&#9;";
      else
        result += c;
    }
  };
  for (std::size_t turn; (turn = text.find('\r')) != std::string_view::npos; text.remove_prefix(turn + 1)) {
    escape(text.substr(0, turn));
    result += "&#13;";
  }
  escape(text);
  return result;
}

std::string as_file_name(std::string text) {
  for (char& c : text)
    if (!std::isalnum(static_cast<unsigned char>(c)) && std::string_view(".,=+-_").find(c) == std::string_view::npos)
      c = '-';
  if (text.starts_with('.')) text.front() = '-';
  return text;
}

std::vector<OddLine> odd_lines(const std::vector<std::string>& first, const std::vector<std::string>& second) {
  const auto [head1, head2] = std::mismatch(first.begin(), first.end(), second.begin(), second.end());
  const auto [tail1, tail2] =
      std::mismatch(first.rbegin(), std::reverse_iterator(head1), second.rbegin(), std::reverse_iterator(head2));
  const std::span a(head1, tail1.base()), b(head2, tail2.base());
  const auto head = static_cast<std::size_t>(head1 - first.begin());
  std::vector<OddLine> odd;
  std::size_t i = 0, j = 0;
  const auto of_first = [&] { odd.push_back({false, head + i++}); };
  const auto of_second = [&] { odd.push_back({true, head + j++}); };
  const std::size_t width = b.size() + 1;
  constexpr std::size_t most = 10'000'000;  // what differs in more lines than this allows is another text altogether
  if (const std::size_t cells = (a.size() + 1) * width; cells <= most) {
    const auto common = common_lines(a, b);
    while (i < a.size() && j < b.size()) {
      const std::size_t here = i * width + j;
      if (a[i] == b[j])
        ++i, ++j;
      else if (common[here + width] >= common[here + 1])
        of_first();
      else
        of_second();
    }
  }
  while (i < a.size()) of_first();
  while (j < b.size()) of_second();
  return odd;
}

}  // namespace beadwork
