#include <fmt/format.h>

#include <algorithm>

#include "core/base/text.hpp"
#include "core/domain/vocabulary.hpp"
#include "core/loop/assembly.hpp"
#include "core/plugin/blame.hpp"

namespace beadwork {

namespace {

bool is_of(const Plugin& plugin, const std::string& family) {
  const auto families = plugin.families();
  return std::find(families.begin(), families.end(), family) != families.end();
}

bool is_offered(const FieldUse& use) { return use.verb() == Verb::writes || use.verb() == Verb::sums; }

}  // namespace

void Assembly::lay_out_fields() {
  choose_rotations();
  add_families();
  begin_lines();
  add_provided();
  meet_readers();
  note_sums();
  warn_of_idle();
}

// Rotations are integrated only if somebody reads orientations or adds torques.
void Assembly::choose_rotations() {
  bool wanted = false;
  for (const auto& plugin : scene_.plugins) {
    if (plugin->kind() == Kind::move || plugin->kind() == Kind::derive) continue;
    for (const FieldUse* use : plugin->uses())
      wanted |= use->wanted() && use->field().on == On::elements &&
                (use->field().name == "orientation" || use->field().name == "torque" || use->field().name == "spin");
  }
  for (const auto& plugin : scene_.plugins)
    if (auto* mover = as_kind<Mover>(*plugin))
      blaming(*mover, "choose_rotations", [&] { mover->choose_rotations(wanted); });
}

void Assembly::add_families() {
  for (const auto& plugin : scene_.plugins) {
    const auto* bonds = as_kind<BondLaw>(*plugin);
    const auto* contacts = as_kind<ContactLaw>(*plugin);
    if (bonds) scene_.domain->add_family(bonds->family());
    if (contacts) {
      BondTable& table = scene_.domain->add_contacts(contacts->family());
      if (contacts->faces_walls()) table.let_pairs_be_with_walls();
    }
    if (bonds || contacts) scene_.families.push_back(plugin->families().front());
  }
  if (!scene_.has_contacts()) return;
  for (const auto& family : scene_.domain->families())  // where a pair touches after a break depends on it
    if (!family->is_of_contacts()) family->rows().add(field::broke_at).keep();
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

// What is kept or added to exists for sure. What may be derived waits for a reader.
void Assembly::add_provided() {
  for (const auto& plugin : scene_.plugins) {
    if (plugin->kind() == Kind::derive) continue;
    for (const FieldUse* use : plugin->uses()) {
      const bool there = use->verb() == Verb::keeps || use->verb() == Verb::adds || use->is_always_there();
      if (use->wanted() && there) add_columns(*plugin, *use);
    }
  }
}

void Assembly::add_columns(const Plugin& plugin, const FieldUse& use) {
  Field field = use.field();
  field.name = plugin.column_name(use);
  for (Table* table : plugin.tables(*scene_.domain, field.on)) {
    Column& column = table->add(field);
    if (use.verb() == Verb::keeps) column.keep();
  }
}

void Assembly::meet_readers() {
  // By index: a reader may bring in a plugin that derives a field.
  for (std::size_t p = 0; p < scene_.plugins.size(); ++p)
    if (scene_.plugins[p]->kind() != Kind::derive) meet_uses(*scene_.plugins[p]);
}

void Assembly::meet_uses(const Plugin& reader) {
  const auto families = reader.families();
  for (const On on : {On::elements, On::bonds, On::scene})
    for (std::size_t f = 0; f < (on == On::bonds ? families.size() : 1); ++f) {
      std::vector<std::string> missing;
      for (const FieldUse* use : reader.uses())
        if (use->wanted() && use->verb() == Verb::reads && use->field().on == on && !meet(reader, *use, f))
          missing.push_back(use->field().name);
      if (!missing.empty()) complain_of_missing(reader, on, on == On::bonds ? families[f] : "", missing);
    }
  for (const ParamBase* param : reader.params())
    if (param->info().role == Role::fields && param->given()) meet_names(reader, *param);
}

// Of a field on bonds: in the family of this number among the reader's.
bool Assembly::meet(const Plugin& reader, const FieldUse& use, std::size_t family) {
  const On on = use.field().on;
  const std::string of = on == On::bonds ? reader.families()[family] : "";
  if (on == On::bonds) {
    const BondTable* table = scene_.domain->find_family(of);
    if (!table) return true;  // that there is no such family has been said
    if (!provide(on, use.field().name, of)) return table->rows().find(reader.column_name(use));
    scene_.section_readers.insert(&reader);
    return true;
  }
  if (on == On::elements && derive(use.field().name, reader)) return true;
  const Table* table = reader.tables(*scene_.domain, on).front();
  return table->find(reader.column_name(use)) || provide(on, use.field().name, of);
}

void Assembly::complain_of_missing(const Plugin& reader, On on, const std::string& family,
                                   const std::vector<std::string>& names) {
  const std::string holder = on == On::bonds ? fmt::format("bond family '{}'", family) : "the elements";
  std::string listed;
  for (std::size_t k = 0; k < names.size(); ++k)
    listed += fmt::format("{}'{}'", k == 0 ? "" : k + 1 == names.size() ? " and " : ", ", names[k]);
  complaints_.error(reader.at(),
                    fmt::format("<{}> reads {} of {}, which nothing in this deck provides{}", reader.tag(), listed,
                                holder, did_you_mean(names.size() == 1 ? names.front() : "", providable(on, family))));
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
  for (const auto& plugin : scene_.plugins) {
    if (plugin->kind() == Kind::derive || (on == On::bonds && !is_of(*plugin, family))) continue;
    for (const FieldUse* use : plugin->uses()) {
      if (!use->wanted() || !is_offered(*use) || use->field().on != on || use->field().name != name) continue;
      Table& table =
          on == On::bonds ? scene_.domain->find_family(family)->rows() : *plugin->tables(*scene_.domain, on).front();
      Column& column = table.add(use->field());
      if (use->verb() == Verb::sums) column.sum();
      if (plugin->kind() == Kind::fill) column.keep();
      found = true;
    }
  }
  return found;
}

// Brings in the plugin that derives a field, named like it, unless it is there already; notes who reads it.
bool Assembly::derive(const std::string& name, const Plugin& reader) {
  if (!catalogue_.find(Kind::derive, name)) return false;
  std::set<const Plugin*> readers{&reader};
  if (const auto* through = as_kind<Derived>(reader)) readers = scene_.readers_of(*through);
  Derived& derived = made_to_derive(name, reader);
  auto& known = scene_.derived_for[&derived];
  const bool fresh = known.empty();
  if (std::includes(known.begin(), known.end(), readers.begin(), readers.end())) return true;
  known.insert(readers.begin(), readers.end());
  if (fresh)
    for (const FieldUse* use : derived.uses())
      if (use->verb() != Verb::reads) add_columns(derived, *use);
  meet_uses(derived);                             // whoever reads it reads what it is found from
  if (fresh) scene_.derived.push_back(&derived);  // behind those
  return true;
}

// The one that the deck sets parameters of, or a new one with none.
Derived& Assembly::made_to_derive(const std::string& name, const Plugin& reader) {
  for (const auto& plugin : scene_.plugins)
    if (plugin->kind() == Kind::derive && plugin->tag() == name) return static_cast<Derived&>(*plugin);
  std::unique_ptr<Plugin> plugin = make(Kind::derive, name, reader.at());
  Node silent;
  silent.tag = name;
  silent.at = deck_.root->at;
  plugin->configure(silent, "derive." + name, deck_.scope, complaints_);
  return static_cast<Derived&>(*scene_.plugins.emplace_back(std::move(plugin)));
}

bool Assembly::reads_sums(const Derived& derived) const {
  return std::any_of(derived.uses().begin(), derived.uses().end(), [&](const FieldUse* use) {
    if (use->verb() != Verb::reads || use->field().on != On::elements) return false;
    const Column* column = scene_.domain->elements().find(use->field().name);
    return column && column->summed();
  });
}

// Which laws count in the sums that derived fields are found from: one choice for a scene.
void Assembly::note_sums() {
  const auto laws_that = [&](const auto& count) {
    std::set<const PairLaw*> all;
    for (const auto& plugin : scene_.plugins) {
      const PairLaw* law = as_kind<BondLaw>(std::as_const(*plugin));
      if (!law) law = as_kind<ContactLaw>(std::as_const(*plugin));
      if (law && count(*law)) all.insert(law);
    }
    return all;
  };
  const Derived* first = nullptr;
  for (const Derived* derived : scene_.derived) {
    if (!reads_sums(*derived)) continue;
    const auto& readers = scene_.readers_of(*derived);
    scene_.section_readers.insert(readers.begin(), readers.end());
    const auto counting = laws_that([&](const PairLaw& law) { return derived->sums_over(law); });
    for (const PairLaw* law : counting)
      if (law->faces_walls())
        complaints_.error(derived->at(),
                          fmt::format("<{}> cannot sum over the contacts '{}' with walls: their forces act "
                                      "at the surface, not between two centres",
                                      derived->tag(), law->family()));
    if (first && counting != scene_.summing)
      complaints_.error(derived->at(),
                        fmt::format("<{}> sums over other families than <{}>: one choice holds for a scene",
                                    derived->tag(), first->tag()));
    first = derived;
    scene_.summing = counting;
  }
}

void Assembly::warn_of_idle() {
  for (const auto& plugin : scene_.plugins)
    if (const auto* derived = as_kind<Derived>(std::as_const(*plugin));
        derived && !scene_.derived_for.contains(derived))
      complaints_.warning(derived->at(), fmt::format("nothing reads '{}', so it is not found", derived->tag()));
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
      if (use->wanted() && is_offered(*use) && plugin->kind() != Kind::derive && use->field().on == on &&
          (on != On::bonds || is_of(*plugin, family)))
        names.insert(use->field().name);
  if (on == On::elements)
    for (const std::string& tag : catalogue_.tags(Kind::derive)) names.insert(tag);
  return {names.begin(), names.end()};
}

}  // namespace beadwork
