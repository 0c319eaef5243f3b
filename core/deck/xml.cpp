#include "core/deck/xml.hpp"

#include <tinyxml2.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/base/readable.hpp"
#include "core/base/text.hpp"
#include "core/base/utf8.hpp"
#include "core/deck/places.hpp"

namespace beadwork {

namespace {

constexpr std::uintmax_t largest_file = 16u << 20;

/// Why a file cannot be a deck before it is opened, or "".
std::string why_no_deck(const std::string& path) {
  if (std::string why = why_unreadable(path); !why.empty()) return why;
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error) return error.message();
  if (size > largest_file)
    return "it has " + std::to_string(size >> 20) + " MiB, more than the " + std::to_string(largest_file >> 20) +
           " MiB of any deck; data belong into a packing file (<read-packing>)";
  return {};
}

/// The offset of the first byte that is no UTF-8 or no text (a zero byte); npos if there is none.
std::size_t first_bad_byte(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = character_length(text.substr(i));
    if (length == 0 || text[i] == '\0') return i;
    i += length;
  }
  return std::string_view::npos;
}

Location place_of_byte(const std::shared_ptr<const Source>& source, std::size_t offset) {
  Location at{source, 1, 1, offset};
  for (std::size_t i = 0; i < offset; ++i) {
    if (source->text[i] == '\n') ++at.line, at.column = 0;
    if ((static_cast<unsigned char>(source->text[i]) & 0xC0) != 0x80) ++at.column;
  }
  return at;
}

}  // namespace

std::shared_ptr<const Source> read_source(const std::string& path, const Location& asked_at, Complaints& complaints) {
  std::string why = why_no_deck(path), text;
  if (why.empty()) {
    std::ifstream file(path, std::ios::binary);
    text.assign(std::istreambuf_iterator<char>(file), {});
    if (!file.is_open() || file.bad()) why = "it may not be read";
  }
  if (!why.empty()) {
    complaints.error(asked_at, "cannot read \"" + path + "\": " + why);
    return nullptr;
  }
  if (text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
  const auto source = std::make_shared<const Source>(Source{path, std::move(text)});
  if (const std::size_t bad = first_bad_byte(source->text); bad != std::string_view::npos) {
    complaints.error(place_of_byte(source, bad), "this is no text in UTF-8");
    return nullptr;
  }
  return source;
}

namespace {

/// What editors and other tools add to any tag, such as xsi:noNamespaceSchemaLocation; it says nothing about the scene.
bool is_for_tools(std::string_view name) {
  return name == "xmlns" || name.starts_with("xmlns:") || name.starts_with("xsi:") || name.starts_with("xml:");
}

/// Pairs the elements of TinyXML2, in document order, with the places of the tags.
class TreeBuilder {
 public:
  TreeBuilder(const std::shared_ptr<const Source>& source, const std::vector<TagPlace>& places, Complaints& complaints)
      : source_(source), places_(places), complaints_(complaints) {}

  std::unique_ptr<Node> build(const tinyxml2::XMLElement& element) {
    auto node = std::make_unique<Node>();
    node->tag = element.Name();
    const TagPlace place = next_ < places_.size() ? places_[next_] : TagPlace{};
    ++next_;
    node->at = place.name;
    std::size_t count = 0;
    for (const auto* each = element.FirstAttribute(); each; each = each->Next(), ++count) {
      const AttributePlace at = count < place.attributes.size() ? place.attributes[count] : AttributePlace{};
      if (!is_for_tools(each->Name())) add({each->Name(), with_plain_blanks(each->Value()), at.name, at.value}, *node);
    }
    in_step_ = in_step_ && count == place.attributes.size() &&
               source_->text.compare(place.name.offset, node->tag.size(), node->tag) == 0;
    for (const auto* child = element.FirstChildElement(); child && in_step_; child = child->NextSiblingElement())
      node->children.push_back(build(*child));
    return node;
  }

  /// Did both passes see the same tags?
  bool in_step() const { return in_step_ && next_ == places_.size(); }

 private:
  void add(Attribute attribute, Node& node) {
    if (const auto invisible = first_invisible(attribute.value))
      complaints_.error(attribute.place(invisible->at),
                        invisible->words + ", stands here in '" + attribute.name + "': delete it");
    node.attributes.push_back(std::move(attribute));
  }

  const std::shared_ptr<const Source>& source_;
  const std::vector<TagPlace>& places_;
  Complaints& complaints_;
  std::size_t next_ = 0;
  bool in_step_ = true;
};

}  // namespace

std::unique_ptr<Node> parse_xml(const std::shared_ptr<const Source>& source, Complaints& complaints) {
  const int errors_before = complaints.errors();
  const Markup markup = markup_of(source, complaints);
  tinyxml2::XMLDocument document;
  if (complaints.errors() > errors_before) return nullptr;
  if (document.Parse(markup.text.data(), markup.text.size()) != tinyxml2::XML_SUCCESS || !document.RootElement()) {
    complaints.error({source, document.ErrorLineNum(), 1},
                     std::string("this is not well-formed XML (") + document.ErrorName() + ")");
    return nullptr;
  }
  TreeBuilder builder(source, markup.tags, complaints);
  auto root = builder.build(*document.RootElement());
  if (complaints.errors() > errors_before) return nullptr;
  if (builder.in_step()) return root;
  complaints.error({source, 1, 1}, "the tags of this file cannot be told apart; write its XML more plainly");
  return nullptr;
}

}  // namespace beadwork
