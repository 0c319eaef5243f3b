#include "workbench/trade/knobs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <map>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"
#include "core/deck/xml.hpp"

namespace beadwork::trade {

namespace {

struct RawParameter {
  std::string name, text;
};

/// As they stand in the files, or as --set gives them.
std::vector<RawParameter> raw_parameters(const Deck& deck) {
  std::vector<RawParameter> all;
  Complaints known;  // the deck has been read before
  for (const auto& source : deck.sources) {
    const auto root = parse_xml(source, known);
    if (!root) continue;
    for (const auto& child : root->children) {
      const Attribute *name = child->find("name"), *value = child->find("value");
      if (child->tag == "parameter" && name && value) all.push_back({name->value, value->value});
    }
  }
  for (const Override& each : deck.overrides)
    for (RawParameter& parameter : all)
      if (parameter.name == each.name) parameter.text = each.value;
  return all;
}

bool stands_in_names(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.'; }

/// Whether a text names the parameter within ${}; a '-' may be a minus or stand in a name.
bool mentions(const std::string& text, const std::string& name) {
  for (std::size_t open = text.find("${"); open != std::string::npos; open = text.find("${", open + 2)) {
    const std::size_t close = std::min(text.find('}', open), text.size());
    for (std::size_t at = text.find(name, open); at != std::string::npos && at < close; at = text.find(name, at + 1)) {
      const char before = text[at - 1], after = at + name.size() < text.size() ? text[at + name.size()] : '}';
      const bool joined_before = stands_in_names(before) || (before == '-' && stands_in_names(text[at - 2]));
      const bool joined_after = stands_in_names(after) || after == '-';
      if (!joined_before && !joined_after) return true;
    }
  }
  return false;
}

void each_node(const Node& node, const std::function<void(const Node&)>& look) {
  look(node);
  for (const auto& child : node.children) each_node(*child, look);
}

/// A declared knob, and its attribute as it stands in the deck; null where the deck does not give it.
struct Declared {
  const Plugin* plugin;
  const ParamBase* param;
  const Attribute* attribute;
  std::string name() const { return plugin->tag() + ": " + param->info().name; }
};

std::vector<Declared> declared_knobs(const Loaded& loaded) {
  std::map<std::pair<const Source*, std::size_t>, const Node*> nodes;
  each_node(*loaded.deck->root, [&](const Node& node) { nodes[{node.at.source.get(), node.at.offset}] = &node; });
  std::vector<Declared> all;
  for (const auto& plugin : loaded.scene->plugins)
    for (const ParamBase* param : plugin->params()) {
      if (param->info().knob == Knob::none) continue;
      const auto node = nodes.find({plugin->at().source.get(), plugin->at().offset});
      const Attribute* attribute =
          node == nodes.end() || !param->in_deck() ? nullptr : node->second->find(param->info().name);
      all.push_back({plugin.get(), param, attribute});
    }
  return all;
}

/// Whether the parameter is of the kind that the attribute takes: of a table one of its columns.
bool fits(const Dimension& dimension, const ParamInfo& info) {
  std::vector<std::string> units = info.columns;
  if (units.empty()) units = {info.unit};
  return std::any_of(units.begin(), units.end(), [&](const std::string& name) {
    const auto unit = find_unit(name);
    return unit && unit->dimension == dimension && !(unit->dimension == find_unit("s")->dimension && units.size() > 1);
  });
}

std::string times(const Amount& amount, double factor, bool whole) {
  const double value = amount.value * factor;
  return Amount{whole ? std::max(1., std::round(value)) : value, amount.unit_name, amount.unit}.text();
}

/// Halves, doubles and so on, as far as the attribute allows.
std::vector<std::string> steps(const Amount& amount, double factor, int count, const ParamBase& param) {
  const bool whole = param.type() == "integer";
  std::vector<std::string> values;
  for (int k = 1; k <= count; ++k) {
    const std::string value = times(amount, std::pow(factor, k), whole);
    const bool allowed =
        !param.info().columns.empty() || param.info().range.holds(parse_amount(value)->quantity().value);
    const bool is_new = value != times(amount, 1, whole) && (values.empty() || values.back() != value);
    if (allowed && is_new) values.push_back(value);
  }
  return values;
}

std::optional<DeckKnob> knob_for(const RawParameter& parameter, const Declared& declared, const Scope& scope) {
  const ParamInfo& info = declared.param->info();
  DeckKnob knob{parameter.name, declared.name(), std::string(trim(parameter.text)), {}, {}};
  if (info.knob == Knob::a_choice) {
    if (trim(declared.attribute->value) != "${" + parameter.name + "}") return std::nullopt;
    for (const std::string& choice : info.choices)
      if (choice != knob.now) knob.faster.push_back(choice);
    return knob;
  }
  const auto amount = parse_amount(parameter.text);
  Complaints unheard;
  const auto quantity = amount && amount->value != 0 ? scope.quantity(parameter.name, {}, unheard) : std::nullopt;
  if (!quantity || !fits(quantity->dimension, info)) return std::nullopt;
  const double faster = info.knob == Knob::larger_is_faster ? 2 : 0.5;
  knob.faster = steps(*amount, faster, 3, *declared.param);
  knob.slower = steps(*amount, 1 / faster, 2, *declared.param);
  return knob;
}

}  // namespace

std::vector<std::string> DeckKnob::values() const {
  std::vector<std::string> all = slower;
  all.insert(all.end(), faster.begin(), faster.end());
  return all;
}

std::vector<DeckKnob> knobs_of(const Loaded& loaded) {
  const std::vector<Declared> declared = declared_knobs(loaded);
  std::vector<DeckKnob> knobs;
  for (const RawParameter& parameter : raw_parameters(*loaded.deck))
    for (const Declared& each : declared) {
      if (!each.attribute || !mentions(each.attribute->value, parameter.name)) continue;
      if (const auto knob = knob_for(parameter, each, loaded.deck->scope)) {
        knobs.push_back(*knob);
        break;  // what it sets elsewhere follows
      }
    }
  return knobs;
}

std::vector<std::string> other_knobs(const Loaded& loaded) {
  const std::vector<RawParameter> parameters = raw_parameters(*loaded.deck);
  std::vector<std::string> names;
  for (const Declared& each : declared_knobs(loaded)) {
    const bool is_set = each.attribute && std::any_of(parameters.begin(), parameters.end(), [&](const auto& parameter) {
                          return mentions(each.attribute->value, parameter.name);
                        });
    if (!is_set && std::find(names.begin(), names.end(), each.name()) == names.end()) names.push_back(each.name());
  }
  return names;
}

DeckKnob knob_of(const std::string& text, const Loaded& loaded) {
  const std::size_t equals = text.find('=');
  DeckKnob knob;
  if (equals != std::string::npos) {
    knob.parameter = trim(text.substr(0, equals));
    for (const std::string& value : split(text.substr(equals + 1), ',')) knob.faster.emplace_back(trim(value));
  }
  if (knob.parameter.empty() || std::find(knob.faster.begin(), knob.faster.end(), "") != knob.faster.end())
    throw DeckFailure(fmt::format("error: --knob wants name=value,value,..., got \"{}\"", text));
  for (const RawParameter& parameter : raw_parameters(*loaded.deck))
    if (parameter.name == knob.parameter) {
      knob.of = "as asked for";
      knob.now = trim(parameter.text);
      std::erase(knob.faster, knob.now);
      return knob;
    }
  throw DeckFailure(fmt::format("error: --knob: the deck has no parameter '{}'{}", knob.parameter,
                                did_you_mean(knob.parameter, loaded.deck->scope.names())));
}

}  // namespace beadwork::trade
