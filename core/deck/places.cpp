#include "core/deck/places.hpp"

#include <algorithm>

#include "core/base/text.hpp"
#include "core/base/utf8.hpp"

namespace beadwork {

namespace {

constexpr std::size_t deepest = 90;                                // TinyXML2 gives up at 100
constexpr std::size_t most_tags = 100000, most_attributes = 1000;  // a scene has some hundreds

bool starts_name(char c) {
  return static_cast<unsigned char>(c) >= 128 || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
         c == ':';
}
bool inside_name(char c) { return starts_name(c) || (c >= '0' && c <= '9') || c == '.' || c == '-'; }

/// Turns offsets into lines and columns. Offsets mostly grow, so it goes on from the last one.
class Counter {
 public:
  explicit Counter(const std::shared_ptr<const Source>& source) : last_{source, 1, 1, 0} {}

  Location at(std::size_t offset) {
    if (offset < last_.offset) last_ = {last_.source, 1, 1, 0};
    const std::string_view text = last_.source->text;
    for (; last_.offset < offset && last_.offset < text.size(); ++last_.offset) {
      const char c = text[last_.offset];
      const bool ends_line =
          c == '\n' || (c == '\r' && (last_.offset + 1 == text.size() || text[last_.offset + 1] != '\n'));
      const bool ends_character =
          last_.offset + 1 == text.size() || (static_cast<unsigned char>(text[last_.offset + 1]) & 0xC0) != 0x80;
      if (ends_line) {
        ++last_.line;
        last_.column = 1;
      } else if (ends_character) {
        ++last_.column;
      }
    }
    return last_;
  }

 private:
  Location last_;
};

class Scanner {
 public:
  Scanner(const std::shared_ptr<const Source>& source, Complaints& complaints)
      : plain_(with_plain_blanks(source->text)), text_(plain_), counter_(source), complaints_(complaints) {}

  Markup run() {
    while (!failed_ && at_ < text_.size()) {
      if (is_blank(here()))
        ++at_;
      else if (here() != '<')
        stray_text();
      else
        markup();
    }
    if (!failed_ && !open_.empty()) fail(open_.back().offset, "<" + open_.back().name + "> is not closed");
    if (!failed_ && tags_.empty()) fail(0, "there is no tag in this file; a deck begins with <scene>");
    return {std::move(tags_), std::move(plain_)};
  }

 private:
  struct Open {
    std::string name;
    std::size_t offset;
    int line;
  };

  char peek(std::size_t ahead) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
  char here() const { return peek(0); }
  bool next_is(std::string_view what) const { return text_.substr(at_).starts_with(what); }
  void skip_blanks() {
    while (at_ < text_.size() && is_blank(here())) ++at_;
  }

  void fail(std::size_t offset, std::string message) {
    complaints_.error(counter_.at(offset), std::move(message));
    failed_ = true;
  }

  /// Where something invisible stands between `begin` and here, that is what is wrong.
  bool is_visible(std::size_t begin) {
    const auto invisible = first_invisible(text_.substr(begin, at_ - begin));
    if (invisible) fail(begin + invisible->at, invisible->words + ", stands here: delete it");
    return !invisible;
  }

  std::string name() {
    const std::size_t begin = at_;
    if (starts_name(here()))
      while (at_ < text_.size() && inside_name(here())) ++at_;
    is_visible(begin);
    return std::string(text_.substr(begin, at_ - begin));
  }

  void stray_text() {
    const char* const message = "text between tags means nothing here; values are attributes: name=\"value\"";
    const auto invisible =
        first_invisible(text_.substr(at_, std::max<std::size_t>(1, character_length(text_.substr(at_)))));
    if (invisible) return fail(at_, invisible->words + ", stands here: delete it");
    if (open_.empty() && tags_.empty()) return fail(at_, "this is no XML: it begins with text, not with a tag");
    complaints_.error(counter_.at(at_), message);
    at_ = std::min(text_.find('<', at_), text_.size());
  }

  void markup() {
    if (next_is("<!--"))
      skip_past("<!--", "-->", "this comment is not closed by -->");
    else if (next_is("<![CDATA["))
      stray_data();
    else if (next_is("<?"))
      instruction();
    else if (next_is("<!"))
      fail(at_, "document types and entities of your own are not supported; use <parameter> and <include>");
    else if (next_is("</"))
      closing_tag();
    else
      opening_tag();
  }

  void skip_past(std::string_view begin, std::string_view end, const char* message) {
    const std::size_t found = text_.find(end, at_ + begin.size());
    if (found == std::string_view::npos) return fail(at_, message);
    at_ = found + end.size();
  }

  /// <?xml ... ?>, <?xml-stylesheet ... ?>: for other programs. TinyXML2 takes them only at the top.
  void instruction() {
    const std::size_t begin = at_;
    skip_past("<?", "?>", "this is not closed by ?>");
    if (failed_) return;
    const auto first = plain_.begin() + static_cast<std::ptrdiff_t>(begin),
               last = plain_.begin() + static_cast<std::ptrdiff_t>(at_);
    std::replace_if(
        first, last, [](char c) { return !is_blank(c); }, ' ');
  }

  void stray_data() {
    complaints_.error(counter_.at(at_), "CDATA means nothing here; values are attributes: name=\"value\"");
    skip_past("<![CDATA[", "]]>", "this CDATA is not closed by ]]>");
  }

  void closing_tag() {
    const std::size_t begin = at_;
    at_ += 2;
    const std::string closed = name();
    if (failed_) return;
    skip_blanks();
    if (closed.empty() || here() != '>') return fail(begin, "a closing tag looks like </fill>");
    ++at_;
    if (open_.empty()) return fail(begin, "</" + closed + "> closes nothing");
    if (open_.back().name != closed)
      return fail(begin, "</" + closed + "> stands where <" + open_.back().name + "> of line " +
                             std::to_string(open_.back().line) + " must be closed first");
    open_.pop_back();
  }

  void opening_tag() {
    const std::size_t begin = ++at_;
    const std::string tag = name();
    if (failed_) return;
    if (tag.empty())
      return fail(begin - 1, "a tag needs a name right behind its <; a 'less than' inside a value is fine");
    if (open_.empty() && !tags_.empty())
      return fail(begin, "a second root <" + tag + ">: all belongs into one <scene>");
    if (tags_.size() == most_tags)
      return fail(begin, "this file has more than " + std::to_string(most_tags) +
                             " tags: data belong into a packing file (<read-packing>)");
    const Location at = counter_.at(begin);
    tags_.push_back({at, {}});
    attributes();
    if (failed_) return;
    if (next_is("/>")) {
      at_ += 2;
      return;
    }
    ++at_;
    open_.push_back({tag, begin, at.line});
    if (open_.size() > deepest) fail(begin, "tags are nested more than " + std::to_string(deepest) + " deep");
  }

  /// Up to the > or /> of the tag.
  void attributes() {
    std::vector<std::string> seen;
    std::size_t quote = std::string_view::npos;  // of the last value, if that runs over several lines
    while (!failed_) {
      skip_blanks();
      if (here() == '>' || next_is("/>")) return;
      const std::size_t begin = at_;
      const std::string attribute = name();
      if (failed_) return;
      skip_blanks();
      const bool has_equals = here() == '=';
      if (has_equals) ++at_;
      skip_blanks();
      const bool has_quote = here() == '"' || here() == '\'';
      if (quote != std::string_view::npos && !(has_equals && has_quote))
        return fail(quote, "this value runs over several lines: is its quote closed?");
      if (begin == text_.size()) return fail(tags_.back().name.offset, "this tag is not closed");
      if (attribute.empty()) return fail(begin, "an attribute such as name=\"value\" is wanted here");
      if (!has_equals || !has_quote)
        return fail(begin, "'" + attribute + "' needs a value in quotes: " + attribute + "=\"...\"" + wrong_quote());
      if (std::find(seen.begin(), seen.end(), attribute) != seen.end())
        return fail(begin, "'" + attribute + "' is given twice");
      if (seen.size() == most_attributes)
        return fail(begin, "this tag has more than " + std::to_string(most_attributes) + " attributes");
      seen.push_back(attribute);
      quote = value(begin);
    }
  }

  /// Where a quote stands that only looks like one, what it is.
  std::string wrong_quote() const {
    const std::size_t length = character_length(text_.substr(at_));
    return first_lookalike(text_.substr(at_, length)) ? "; here stands " + named_character(text_.substr(at_)) : "";
  }

  /// Returns where the value began, if it has several lines.
  std::size_t value(std::size_t name_offset) {
    const std::size_t quote = at_++, end = text_.find(text_[quote], at_);
    if (end == std::string_view::npos) {
      fail(quote, "the quote that opens this value is not closed");
      return std::string_view::npos;
    }
    const Location name_at = counter_.at(name_offset);
    tags_.back().attributes.push_back({name_at, counter_.at(at_)});
    const std::string_view inside = text_.substr(at_, end - at_);
    for (std::size_t i = inside.find('&'); i != std::string_view::npos && !failed_; i = inside.find('&', i + 1))
      if (entity_length(inside.substr(i)) == 0)
        fail(at_ + i, "& begins an entity such as &lt;; for the sign itself write &amp;");
    at_ = end + 1;
    return inside.find('\n') == std::string_view::npos ? std::string_view::npos : quote;
  }

  std::string plain_;
  std::string_view text_;
  Counter counter_;
  Complaints& complaints_;
  std::size_t at_ = 0;
  bool failed_ = false;
  std::vector<TagPlace> tags_;
  std::vector<Open> open_;
};

}  // namespace

Markup markup_of(const std::shared_ptr<const Source>& source, Complaints& complaints) {
  return Scanner(source, complaints).run();
}

}  // namespace beadwork
