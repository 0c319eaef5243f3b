#include <fmt/format.h>

#include "core/base/text.hpp"
#include "workbench/describe.hpp"

namespace beadwork {

namespace {

std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|' || c == '<') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string code(const std::string& text) { return text.empty() ? "" : "`" + text + "`"; }

std::string row_of(const ParamBase& param) {
  const ParamInfo& info = param.info();
  const std::string only = info.instead.empty() ? "" : fmt::format(" where there is no {}", code(info.instead));
  const std::string fallback = info.fallback ? code(*info.fallback) + only : param.needed() ? "**required**" : "optional";
  std::string doc = info.doc;
  if (!info.variables.empty()) {
    std::vector<std::string> names;
    for (const Variable& variable : info.variables) names.push_back(variable.name);
    doc += fmt::format(" (of {})", join(names));
  }
  return fmt::format("| `{}` | {} | {} | {} | {} |\n", info.name, cell(type_words(param)), cell(range_words(param)), fallback, cell(doc));
}

std::string row_of(Kind kind, const FieldUse& use) {
  const Field& field = use.field();
  return fmt::format("| {} | `{}` | {} | {} | {} |\n", use_word(kind, use.verb()), field.name, place_name(field.on),
                     field.unit == "1" ? "" : field.unit, cell(field.doc));
}

std::string chapter(const Described& each) {
  std::string text = fmt::format("### `{}`\n\n{}.\n", each.tag, each.about);
  if (!each.plugin->params().empty()) {
    text += "\n| attribute | type | range | default | meaning |\n|---|---|---|---|---|\n";
    for (const ParamBase* param : each.plugin->params()) text += row_of(*param);
  }
  if (!each.plugin->uses().empty()) {
    text += "\n| | field | on | unit | meaning |\n|---|---|---|---|---|\n";
    for (const FieldUse* use : each.plugin->uses()) text += row_of(each.kind, *use);
  }
  return text;
}

const char* const preface = R"(# Deck reference

Made by `beadwork describe --format md` from the declarations in the plugins; do not edit.

A deck is an XML file with the root `<scene>` (attributes `name`, `seed`, `plugins`). In it stand, in any order and any number of
times, the sections below, `<parameter name= value=>`, `<include file=>`, and `<stage name= until=>`, which wraps sections other
than `<fill>`. Any value may hold `${...}`: a parameter, or an expression on quantities.

What a plugin does with a field: it *reads* it; *adds* to it (a sum that is cleared at each evaluation); *offers* it (it exists
only if somebody reads it); *fills* it once; *keeps* it (state, saved in checkpoints).

Editors check and complete a deck whose root is `<scene xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
xsi:noNamespaceSchemaLocation="path/to/beadwork.xsd">`; so does `xmllint --noout --schema beadwork.xsd deck.xml`. An included file
is a `<scene>` too and is checked alike, unless it is included inside of a section. `beadwork check` finds what no schema can.
)";

}  // namespace

std::string as_markdown(const Manual& manual) {
  if (manual.size() == 1) return chapter(manual.front());
  std::string text = preface;
  const char* section = nullptr;
  for (const Described& each : manual) {
    if (section != kind_name(each.kind)) text += fmt::format("\n## `<{}>`\n\n{}\n", kind_name(each.kind), section_doc(each.kind));
    section = kind_name(each.kind);
    text += "\n" + chapter(each);
  }
  return text;
}

}  // namespace beadwork
