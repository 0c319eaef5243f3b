#include "core/loop/json_text.hpp"

#include "workbench/describe.hpp"

namespace beadwork {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const ParamBase& param) {
  const ParamInfo& info = param.info();
  Json json{{"name", info.name},
            {"type", param.type()},
            {"unit", info.unit},
            {"required", param.needed()},
            {"doc", info.doc}};
  if (const std::string range = range_words(param); !range.empty()) json["range"] = range;
  if (info.fallback) json["default"] = *info.fallback;
  if (!info.choices.empty()) json["choices"] = info.choices;
  if (!info.one_of.empty()) json["one_of"] = info.one_of;
  for (const Variable& variable : info.variables)
    json["variables"].push_back({{"name", variable.name}, {"unit", variable.dimension.name()}});
  return json;
}

Json json_of(Kind kind, const FieldUse& use) {
  const Field& field = use.field();
  return {{"verb", use_word(kind, use.verb())}, {"name", field.name}, {"on", place_name(field.on)},
          {"type", type_name(field.type)},      {"unit", field.unit}, {"doc", field.doc}};
}

}  // namespace

std::string as_json(const Manual& manual) {
  Json json = Json::array();
  for (const Described& each : manual) {
    Json plugin{{"section", kind_name(each.kind)}, {"tag", each.tag}, {"doc", each.about}};
    plugin["parameters"] = Json::array();
    for (const ParamBase* param : each.plugin->params()) plugin["parameters"].push_back(json_of(*param));
    plugin["fields"] = Json::array();
    for (const FieldUse* use : each.touched()) plugin["fields"].push_back(json_of(each.kind, *use));
    json.push_back(std::move(plugin));
  }
  return json_text(json, 2) + "\n";
}

}  // namespace beadwork
