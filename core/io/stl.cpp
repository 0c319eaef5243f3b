#include "core/io/stl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"

namespace beadwork {

namespace {

constexpr std::size_t header = 84, record = 50;  // 80 bytes of anything and a count; a normal, three corners, two bytes

std::uint32_t count_in(const std::string& bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, sizeof count);
  return count;
}

// A binary file may begin with "solid" too: its length decides.
bool is_binary(const std::string& bytes) {
  return bytes.size() >= header && bytes.size() == header + record * std::size_t{count_in(bytes)};
}

std::vector<Triangle> parse_binary(const std::string& bytes) {
  std::vector<Triangle> triangles(count_in(bytes));
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      float place[3];
      std::memcpy(place, bytes.data() + header + t * record + 12 * (c + 1), sizeof place);
      triangles[t][c] = Vec3(place[0], place[1], place[2]);
    }
  return triangles;
}

/// The words of a text, each with its place.
class Words {
 public:
  Words(const std::string& text, const std::string& name) : text_(text), name_(name) {}

  bool at_end() {
    skip();
    return next_ >= text_.size();
  }
  std::string word() {
    skip();
    begin_ = next_;
    while (next_ < text_.size() && !is_blank(text_[next_])) ++next_;
    return text_.substr(begin_, next_ - begin_);
  }
  void rest_of_line() {
    while (next_ < text_.size() && text_[next_] != '\n') ++next_;
  }
  void expect(const std::string& wanted) {
    if (const std::string got = word(); got != wanted)
      refuse(fmt::format("'{}' is wanted, got {}", wanted, got.empty() ? "the end of the file" : '"' + got + '"'));
  }
  Real number() {
    const std::string text = word();
    const auto value = parse_number(text);
    if (!value)
      refuse(fmt::format("a number is wanted, got {}", text.empty() ? "the end of the file" : '"' + text + '"'));
    return *value;
  }
  [[noreturn]] void refuse(const std::string& why) const {
    std::size_t line = 1, column = 1;
    for (std::size_t i = 0; i < begin_ && i < text_.size(); ++i) {
      ++column;
      if (text_[i] == '\n') ++line, column = 1;
    }
    throw DeckFailure(fmt::format("{}:{}:{}: error: {}", name_, line, column, why));
  }

 private:
  void skip() {
    while (next_ < text_.size() && is_blank(text_[next_])) ++next_;
  }
  const std::string &text_, &name_;
  std::size_t next_ = 0, begin_ = 0;
};

std::vector<Triangle> parse_text(const std::string& text, const std::string& name) {
  Words words(text, name);
  std::vector<Triangle> triangles;
  while (!words.at_end()) {  // several solids may follow one another
    words.expect("solid");
    words.rest_of_line();
    for (std::string word = words.word(); word != "endsolid"; word = words.word()) {
      if (word != "facet") words.refuse(fmt::format("'facet' or 'endsolid' is wanted, got \"{}\"", word));
      words.expect("normal");
      for (int c = 0; c < 3; ++c) words.word();
      words.expect("outer");
      words.expect("loop");
      Triangle& triangle = triangles.emplace_back();
      for (Vec3& corner : triangle) {
        words.expect("vertex");
        for (int c = 0; c < 3; ++c) corner[c] = words.number();
      }
      words.expect("endloop");
      words.expect("endfacet");
    }
    words.rest_of_line();
  }
  return triangles;
}

// Without a byte order mark; keywords may be in capitals.
std::string plain_text(const std::string& bytes) {
  std::string text = bytes.starts_with(byte_order_mark) ? bytes.substr(byte_order_mark.size()) : bytes;
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return text;
}

}  // namespace

std::vector<Triangle> parse_stl(const std::string& bytes, const std::string& name) {
  if (is_binary(bytes)) return parse_binary(bytes);
  if (const std::string text = plain_text(bytes); text.starts_with("solid")) return parse_text(text, name);
  if (bytes.size() >= header)
    throw DeckFailure(
        fmt::format("{}: error: neither a text that begins with 'solid' nor a binary STL: its head tells of {} "
                    "triangles, which are "
                    "{} bytes, and the file has {}",
                    name, count_in(bytes), header + record * std::size_t{count_in(bytes)}, bytes.size()));
  throw DeckFailure(
      fmt::format("{}: error: no STL: it begins neither with 'solid' nor has it the {} bytes of a head", name, header));
}

std::vector<Triangle> read_stl(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  const auto size = in.tellg();
  if (size < 0) throw DeckFailure(fmt::format("cannot read \"{}\"", file.string()));
  std::string bytes(static_cast<std::size_t>(size), '\0');
  in.seekg(0).read(bytes.data(), size);
  if (!in) throw DeckFailure(fmt::format("cannot read \"{}\"", file.string()));
  return parse_stl(bytes, file.string());
}

}  // namespace beadwork
