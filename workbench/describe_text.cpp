#include <fmt/format.h>

#include <algorithm>

#include "core/base/text.hpp"
#include "workbench/describe.hpp"

namespace beadwork {

namespace {

// The words of `text` in lines of at most `width` characters, each behind `indent`.
std::string wrapped(const std::string& text, std::size_t indent, std::size_t width) {
  std::string out, line;
  const auto end_line = [&] {
    if (!line.empty()) out += std::string(indent, ' ') + line + "\n";
    line.clear();
  };
  for (const std::string& word : split_words(text)) {
    if (!line.empty() && indent + line.size() + 1 + word.size() > width) end_line();
    line += (line.empty() ? "" : " ") + word;
  }
  end_line();
  return out;
}

std::string entry_of(const Plugin& plugin, const ParamBase& param, std::size_t width) {
  const ParamInfo& info = param.info();
  std::string head = type_words(param);
  if (const std::string range = range_words(param); !range.empty()) head += ", " + range;
  if (info.fallback)
    head +=
        fmt::format("; default {}{}", *info.fallback, info.instead.empty() ? "" : " where there is no " + info.instead);
  else
    head += "; " + presence_words(plugin, param);
  return fmt::format("  {}\n", info.name) + wrapped(head, 6, width) + wrapped(meaning(param) + ".", 6, width);
}

std::string entry_of(Kind kind, const FieldUse& use, std::size_t width) {
  const Field& field = use.field();
  const std::string unit = field.unit == "1" ? "" : " in " + field.unit;
  return wrapped(
      fmt::format("{} {} ({}{}): {}", use_word(kind, use.verb()), field.name, place_name(field.on), unit, field.doc), 2,
      width);
}

}  // namespace

std::string as_list(const Manual& manual, std::size_t width) {
  constexpr std::size_t indent = 23;
  std::string text;
  const char* section = nullptr;
  for (const Described& each : manual) {
    if (section != kind_name(each.kind)) text += fmt::format("{}{}\n", section ? "\n" : "", kind_name(each.kind));
    section = kind_name(each.kind);
    text += fmt::format("  {:20} ", each.tag) + wrapped(each.about, indent, width).substr(indent);
  }
  return text;
}

std::string as_text(const Manual& manual, std::size_t width) {
  std::string text;
  for (const Described& each : manual) {
    if (!text.empty()) text += "\n";
    text +=
        fmt::format("<{}>  in section <{}>\n", each.tag, kind_name(each.kind)) + wrapped(each.about + ".", 2, width);
    if (!each.plugin->params().empty()) text += "\nAttributes\n";
    for (const ParamBase* param : each.plugin->params()) text += entry_of(*each.plugin, *param, width);
    if (!each.touched().empty()) text += "\nFields\n";
    for (const FieldUse* use : each.touched()) text += entry_of(each.kind, *use, width);
  }
  return text;
}

}  // namespace beadwork
