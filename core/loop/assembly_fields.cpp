#include <fmt/format.h>

#include <algorithm>

#include "core/base/text.hpp"
#include "core/domain/vocabulary.hpp"
#include "core/loop/assembly.hpp"

namespace beadwork {

void Assembly::lay_out_fields() {
  choose_rotations();
  add_families();
  begin_lines();
  add_provided();
  meet_readers();
}

// Rotations are integrated only if somebody reads orientations or adds torques.
void Assembly::choose_rotations() {
  bool wanted = false;
  for (const auto& plugin : scene_.plugins) {
    if (dynamic_cast<const Mover*>(plugin.get())) continue;
    for (const FieldUse* use : plugin->uses())
      wanted |= use->wanted() && use->field().on == On::elements &&
                (use->field().name == "orientation" || use->field().name == "torque" || use->field().name == "spin");
  }
  for (const auto& plugin : scene_.plugins)
    if (auto* mover = dynamic_cast<Mover*>(plugin.get()))
      blaming(*mover, "choose_rotations", [&] { mover->choose_rotations(wanted); });
}

void Assembly::add_families() {
  for (const auto& plugin : scene_.plugins)
    if (const auto* law = dynamic_cast<const BondLaw*>(plugin.get())) {
      scene_.families.push_back(law->family());
      scene_.domain->add_family(law->family());
    }
}

Table* Assembly::table_of(const Plugin& plugin, On on) const {
  if (on == On::elements) return &scene_.domain->elements();
  if (on == On::scene) return &scene_.domain->scene();
  BondTable* family = scene_.domain->find_family(plugin.family());
  return family ? &family->rows() : nullptr;
}

// The loops find the members of an element's line side by side in this order, whichever plugin asks first.
void Assembly::begin_lines() {
  for (const Field* field :
       {&field::position, &field::orientation, &field::velocity, &field::spin, &field::force, &field::torque}) {
    const auto asks = [&](const auto& plugin) {
      return std::any_of(plugin->uses().begin(), plugin->uses().end(), [&](const FieldUse* use) {
        return use->wanted() && use->field().on == On::elements && use->field().name == field->name &&
               (use->verb() == Verb::keeps || use->verb() == Verb::adds);
      });
    };
    if (std::any_of(scene_.plugins.begin(), scene_.plugins.end(), asks)) scene_.domain->elements().add(*field);
  }
}

// What is kept or added to exists for sure.
void Assembly::add_provided() {
  for (const auto& plugin : scene_.plugins) {
    for (const FieldUse* use : plugin->uses()) {
      if (!use->wanted() || use->verb() == Verb::reads || use->verb() == Verb::writes) continue;
      Table* table = table_of(*plugin, use->field().on);
      if (!table) continue;
      Field field = use->field();
      field.name = plugin->column_name(*use);
      Column& column = table->add(field);
      if (use->verb() == Verb::keeps) column.keep();
    }
  }
}

void Assembly::meet_readers() {
  // By index: a reader may bring in a plugin that derives a field, which then reads itself.
  for (std::size_t p = 0; p < scene_.plugins.size(); ++p) {
    const Plugin& plugin = *scene_.plugins[p];
    std::map<On, std::vector<std::string>> missing;
    for (const FieldUse* use : plugin.uses())
      if (use->wanted() && use->verb() == Verb::reads && !meet(plugin, *use))
        missing[use->field().on].push_back(use->field().name);
    for (const auto& [on, names] : missing) complain_of_missing(plugin, on, names);
    for (const ParamBase* param : plugin.params())
      if (param->info().role == Role::fields && param->given()) meet_names(plugin, *param);
  }
}

bool Assembly::meet(const Plugin& reader, const FieldUse& use) {
  const On on = use.field().on;
  Table* table = table_of(reader, on);
  if (!table) return true;  // that there is no such family has been said
  if (on == On::bonds && provide(on, use.field().name, reader.family())) {
    scene_.section_readers.insert(&reader);
    return true;
  }
  if (on == On::elements && derive(use.field().name, reader)) return true;
  return table->find(reader.column_name(use)) || provide(on, use.field().name, reader.family());
}

void Assembly::complain_of_missing(const Plugin& reader, On on, const std::vector<std::string>& names) {
  const std::string holder = on == On::bonds ? fmt::format("bond family '{}'", reader.family()) : "the elements";
  std::string listed;
  for (std::size_t k = 0; k < names.size(); ++k)
    listed += fmt::format("{}'{}'", k == 0 ? "" : k + 1 == names.size() ? " and " : ", ", names[k]);
  complaints_.error(
      reader.at(),
      fmt::format("<{}> reads {} of {}, which nothing in this deck provides{}", reader.tag(), listed, holder,
                  did_you_mean(names.size() == 1 ? names.front() : "", providable(on, reader.family()))));
}

// Fields asked for by name, wherever they are: on the elements, on every family that has them.
void Assembly::meet_names(const Plugin& reader, const ParamBase& fields) {
  for (const std::string& name : fields.names()) {
    if (name == every_field) {
      provide_all(reader);
      continue;
    }
    bool found = derive(name, reader) || scene_.domain->elements().find(name) || provide(On::elements, name, "");
    for (const std::string& family : scene_.families) {
      const bool offered = provide(On::bonds, name, family);
      if (offered) scene_.section_readers.insert(&reader);
      found |= offered || scene_.domain->find_family(family)->rows().find(name);
    }
    if (found) continue;
    std::vector<std::string> known = providable(On::elements, "");
    for (const std::string& family : scene_.families)
      for (const std::string& more : providable(On::bonds, family)) known.push_back(more);
    complaints_.error(fields.at(name), fmt::format("'{}' names field \"{}\", which nothing in this deck provides{}",
                                                   fields.info().name, name, did_you_mean(name, known)));
  }
}

// Whatever somebody offers, and what can be derived of it.
void Assembly::provide_all(const Plugin& reader) {
  for (const std::string& name : providable(On::elements, "")) {
    if (!catalogue_.find(Kind::derive, name))
      provide(On::elements, name, "");
    else if (can_derive(name))
      derive(name, reader);
  }
  for (const std::string& family : scene_.families)
    for (const std::string& name : providable(On::bonds, family))
      if (provide(On::bonds, name, family)) scene_.section_readers.insert(&reader);
}

// Whether what a derived field is found from is there or offered.
bool Assembly::can_derive(const std::string& name) const {
  const std::unique_ptr<Plugin> plugin = catalogue_.make(Kind::derive, name);
  const auto known = providable(On::elements, "");
  return std::all_of(plugin->uses().begin(), plugin->uses().end(), [&](const FieldUse* use) {
    return use->verb() != Verb::reads ||
           (use->field().on == On::elements && std::find(known.begin(), known.end(), use->field().name) != known.end());
  });
}

// Takes up an offer: makes the column of a field that some plugin writes only if it is read. What a filling plugin
// writes is written once, so it is kept.
bool Assembly::provide(On on, const std::string& name, const std::string& family) {
  bool found = false;
  for (const auto& plugin : scene_.plugins)
    for (const FieldUse* use : plugin->uses())
      if (use->wanted() && use->verb() == Verb::writes && use->field().on == on && use->field().name == name &&
          (on != On::bonds || plugin->family() == family)) {
        Column& column = table_of(*plugin, on)->add(use->field());
        if (dynamic_cast<const Filler*>(plugin.get())) column.keep();
        found = true;
      }
  return found;
}

// Brings in the plugin that derives a field, named like it, unless it is there already; notes who reads it.
bool Assembly::derive(const std::string& name, const Plugin& reader) {
  if (!catalogue_.find(Kind::derive, name)) return false;
  std::set<const Plugin*> readers{&reader};
  if (const auto* through = dynamic_cast<const Derived*>(&reader)) readers = scene_.readers_of(*through);
  for (const Derived* there : scene_.derived)
    if (there->tag() == name) {
      scene_.derived_for[there].insert(readers.begin(), readers.end());
      return true;
    }
  std::unique_ptr<Plugin> plugin = make(Kind::derive, name, reader.at());
  Node silent;
  silent.tag = name;
  silent.at = deck_.root->at;
  plugin->configure(silent, "derive." + name, deck_.scope, complaints_);
  for (const FieldUse* use : plugin->uses())
    if (use->verb() != Verb::reads) {
      Field field = use->field();
      field.name = plugin->column_name(*use);
      Column& column = table_of(*plugin, field.on)->add(field);
      if (use->verb() == Verb::keeps) column.keep();
    }
  scene_.derived.push_back(static_cast<Derived*>(plugin.get()));
  scene_.derived_for[scene_.derived.back()] = readers;
  scene_.plugins.push_back(std::move(plugin));
  return true;
}

std::vector<std::string> Assembly::providable(On on, const std::string& family) const {
  std::set<std::string> names;
  const Table* table = nullptr;
  if (on == On::elements) table = &scene_.domain->elements();
  if (on == On::bonds)
    if (const BondTable* there = scene_.domain->find_family(family)) table = &there->rows();
  if (table)
    for (const Column* column : table->columns()) names.insert(column->field().name);
  for (const char* own : {"id", "first", "second", "target"}) names.erase(own);  // what the core keeps for itself
  for (const auto& plugin : scene_.plugins)
    for (const FieldUse* use : plugin->uses())
      if (use->wanted() && use->verb() == Verb::writes && use->field().on == on &&
          (on != On::bonds || plugin->family() == family))
        names.insert(use->field().name);
  if (on == On::elements)
    for (const std::string& tag : catalogue_.tags(Kind::derive)) names.insert(tag);
  return {names.begin(), names.end()};
}

}  // namespace beadwork
