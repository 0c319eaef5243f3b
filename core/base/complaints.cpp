#include "core/base/complaints.hpp"

#include <algorithm>
#include <string_view>
#include <tuple>

#include "core/base/failure.hpp"
#include "core/base/utf8.hpp"

namespace beadwork {

namespace {

constexpr std::size_t most_shown = 50;         // a deck of another program complains about every line
constexpr std::size_t longest_message = 2000;  // bytes; what is longer quotes some value of megabytes
constexpr std::size_t widest_line = 160;       // columns; of longer lines the part around the caret is shown

std::string_view line_of(std::string_view text, int line) {
  std::size_t begin = 0;
  for (int n = 1; n < line; ++n) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string_view::npos) return {};
    begin = end + 1;
  }
  std::string_view found = text.substr(begin, text.find('\n', begin) - begin);
  if (found.ends_with('\r')) found.remove_suffix(1);
  return found;
}

bool starts_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }

// What a terminal shows of a character: bytes that are no text are spelt out.
std::string visible(std::string_view text, std::size_t length) {
  const auto byte = static_cast<unsigned char>(text[0]);
  if (length > 1 || (byte >= 0x20 && byte < 0x7F) || byte == '\t') return std::string(text.substr(0, length));
  constexpr char digits[] = "0123456789ABCDEF";
  return {'\\', 'x', digits[byte / 16], digits[byte % 16]};
}

// The source line and a caret below the column. Tabs are repeated in the line of the caret, so that it stands
// right.
std::string excerpt(const Location& at) {
  if (!at.source || at.line <= 0 || at.column <= 0) return {};
  const std::string_view line = line_of(at.source->text, at.line);
  const int first =
      at.column > static_cast<int>(widest_line) * 3 / 4 ? at.column - static_cast<int>(widest_line) / 2 : 1;
  std::string shown, padding;
  int column = 0;
  for (std::size_t k = 0; k < line.size();) {
    const std::string_view rest = line.substr(k);
    const std::size_t length = character_length(rest);
    if (starts_character(line[k])) ++column;
    k += std::max<std::size_t>(length, 1);
    if (column < first) continue;
    if (column >= first + static_cast<int>(widest_line)) break;
    const std::string piece = visible(rest, length);
    shown += piece;
    if (column < at.column) padding += piece == "\t" ? "\t" : std::string(length > 1 ? 1 : piece.size(), ' ');
  }
  if (column + 1 < at.column) padding.append(static_cast<std::size_t>(at.column - column - 1), ' ');  // behind its end
  return shown + "\n" + padding + "^\n";
}

// Its beginning says what is wrong, its end mostly why.
std::string without_middle(const std::string& message) {
  std::size_t head = longest_message / 2, tail = message.size() - longest_message / 4;
  while (head > 0 && !starts_character(message[head])) --head;
  while (tail < message.size() && !starts_character(message[tail])) ++tail;
  return message.substr(0, head) + " ... " + message.substr(tail);
}

std::string counted(int number, const std::string& what) {
  return std::to_string(number) + " " + what + (number == 1 ? "" : "s");
}

}  // namespace

void Complaints::add(const Location& at, bool is_error, std::string message) {
  if (message.size() > longest_message) message = without_middle(message);
  if (!seen_.insert(at.where() + (is_error ? ": error: " : ": warning: ") + message).second) return;
  ++(is_error ? errors_ : warnings_);
  list_.push_back({at, is_error, std::move(message)});
}

std::vector<Complaints::Complaint> Complaints::in_order() const {
  std::vector<std::string> files;
  const auto file = [&](const Complaint& complaint) {
    if (!complaint.at.source) return list_.size();
    const std::string& path = complaint.at.source->path;
    const auto known = std::find(files.begin(), files.end(), path);
    if (known != files.end()) return static_cast<std::size_t>(known - files.begin());
    files.push_back(path);
    return files.size() - 1;
  };
  using Key = std::tuple<std::size_t, int, int>;
  std::vector<std::pair<Key, Complaint>> keyed;
  for (const Complaint& each : list_) keyed.push_back({{file(each), each.at.line, each.at.column}, each});
  std::stable_sort(keyed.begin(), keyed.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Complaint> sorted;
  for (auto& each : keyed) sorted.push_back(std::move(each.second));
  return sorted;
}

std::vector<std::string> Complaints::each() const {
  std::vector<std::string> all;
  for (const Complaint& each : in_order()) {
    const std::string place = each.at.source ? each.at.where() + ": " : "";
    all.push_back(place + (each.is_error ? "error: " : "warning: ") + each.message + "\n" + excerpt(each.at));
  }
  return all;
}

std::string Complaints::text() const {
  std::string text;
  const std::vector<std::string> all = each();
  const std::size_t shown = std::min(all.size(), most_shown);
  for (std::size_t i = 0; i < shown; ++i) text += all[i];
  if (shown < all.size()) text += "... and " + std::to_string(all.size() - shown) + " more\n";
  if (errors_ > 0) text += counted(errors_, "error");
  if (errors_ > 0 && warnings_ > 0) text += ", ";
  if (warnings_ > 0) text += counted(warnings_, "warning");
  return text;
}

void Complaints::throw_if_any() const {
  if (errors_ > 0) throw DeckFailure(text());
}

void refuse(const Location& at, std::string message) {
  Complaints one;
  one.error(at, std::move(message));
  throw DeckFailure(one.text());
}

}  // namespace beadwork
