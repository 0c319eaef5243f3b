#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "core/base/text.hpp"
#include "workbench/describe.hpp"
#include "workbench/plan.hpp"

namespace beadwork {

namespace {

// A plugin and what it works on: "pull right", "cohesive-beam resin".
std::string label(const Plugin& plugin) {
  std::string text = plugin.tag();
  for (const ParamBase* param : plugin.params())
    if (param->info().role == Role::makes_set || param->info().role == Role::makes_family ||
        param->info().role == Role::family || (param->info().role == Role::set && plugin.families().empty()))
      for (const std::string& name : param->names()) text += " " + name;
  return text;
}

template <class List>
std::string labels(const List& list) {
  std::vector<std::string> all;
  for (const auto* plugin : list) all.push_back(label(*plugin));
  return join(all);
}

// "snapshot (every 100 steps, at 0.3 mm, 1 ms)"
std::string with_cadence(const Plugin& plugin) {
  std::vector<std::string> when;
  const ParamBase* every = plugin.param("every");
  if (every && every->given() && every->text() != "1") when.push_back(fmt::format("every {} steps", every->text()));
  if (const auto* watcher = as_kind<Watcher>(plugin); watcher && watcher->moments.given())
    when.push_back("at " + *watcher->moments);
  return when.empty() ? label(plugin) : fmt::format("{} ({})", label(plugin), join(when));
}

template <class List>
std::string with_cadences(const List& list) {
  std::vector<std::string> all;
  for (const auto* plugin : list) all.push_back(with_cadence(*plugin));
  return join(all);
}

void line(std::string& text, const char* when, const char* what, const std::string& who) {
  if (!who.empty()) text += fmt::format("  {:16} {:8} {}\n", when, what, who);
}

std::string filling(const Scene& scene) {
  std::vector<const Filler*> before, after;
  for (const Filler* filler : scene.fillers) (filler->after_filling() ? after : before).push_back(filler);
  std::string text = "Before the first step\n";
  line(text, "once", "fill", labels(before));
  line(text, "then", "fill", labels(after));
  return text;
}

// Fields that somebody of the stage reads.
std::vector<const Derived*> derived_in(const Scene& scene, const Stage& stage) {
  const auto there = stage.plugins();
  std::vector<const Derived*> all;
  for (const Derived* derived : scene.derived) {
    const auto& readers = scene.readers_of(*derived);
    if (std::any_of(there.begin(), there.end(), [&](const Plugin* plugin) { return readers.contains(plugin); }))
      all.push_back(derived);
  }
  return all;
}

std::string phases(const Scene& scene, std::size_t number) {
  const Stage& stage = scene.stages[number];
  std::vector<const BondLaw*> fresh;
  for (const BondLaw* law : stage.laws)
    if (scene.first_stage(*law) == number) fresh.push_back(law);
  std::string text = fmt::format("\nStage '{}', until {}\n", stage.name, stage.until->text());
  line(text, "at its start", "bond", labels(fresh));
  line(text, "each step", "load", labels(stage.loads));
  line(text, "", "move", labels(stage.movers));
  line(text, "", "bond", labels(stage.laws));
  line(text, "", "contact", labels(stage.contacts));
  line(text, "", "fail", with_cadences(stage.failures));
  line(text, "when it is read", "derive", labels(derived_in(scene, stage)));
  line(text, "now and then", "watch", with_cadences(stage.watchers));
  return text;
}

// Who does what with a column: "keeps: verlet; adds: cohesive-beam".
std::string users(const Scene& scene, const std::string& column, On on, const std::string& family) {
  std::map<std::string, std::vector<std::string>> by_word;
  const auto note = [&](const std::string& word, const std::string& tag) {
    auto& tags = by_word[word];
    if (std::find(tags.begin(), tags.end(), tag) == tags.end()) tags.push_back(tag);
  };
  for (const auto& plugin : scene.plugins) {
    const auto families = plugin->families();
    const bool here = on != On::bonds || std::find(families.begin(), families.end(), family) != families.end();
    for (const FieldUse* use : plugin->uses())
      if (here && use->wanted() && use->field().on == on && plugin->column_name(*use) == column)
        note(use_word(plugin->kind(), use->verb()), plugin->tag());
    for (const ParamBase* param : plugin->params())
      if (param->info().role == Role::fields)
        for (const std::string& name : param->names())
          if (name == column) note("reads", plugin->tag());
  }
  std::vector<std::string> pieces;
  for (const auto& [word, tags] : by_word) pieces.push_back(word + ": " + join(tags));
  return pieces.empty() ? "core" : join(pieces, "; ");
}

std::string columns_of(const Scene& scene, const Table& table, On on, const std::string& family) {
  std::string text;
  for (const Column* column : table.columns()) {
    const Field& field = column->field();
    text += fmt::format("  {:28} {:>3} bytes  {:8} {:7} {}\n", field.name, bytes(field.type),
                        field.unit == "1" ? "" : field.unit, column->kept() ? "saved" : "",
                        users(scene, field.name, on, family));
  }
  return text;
}

// The unit of a column is left out where only the run can tell it.
std::string columns_of(const Curve& curve) {
  std::vector<std::string> all;
  for (const auto& [name, unit] : curve.plan.columns) all.push_back(unit.empty() ? name : name + " [" + unit + "]");
  return join(all);
}

std::string curves(const Scene& scene) {
  std::string text;
  for (const auto& plugin : scene.plugins)
    if (const auto* watcher = as_kind<Watcher>(std::as_const(*plugin)))
      for (const Curve* curve : watcher->curves())
        text +=
            fmt::format("  {:28} {}: {}\n", "curves/" + *curve->name() + ".csv", label(*watcher), columns_of(*curve));
  return text.empty() ? "" : "\nCurves, and what they have beside step and time\n" + text;
}

std::string fields(const Scene& scene) {
  const Domain& domain = *scene.domain;
  std::string text =
      fmt::format("\nColumns on elements: {} bytes per element\n", row_bytes(domain.elements(), On::elements));
  text += columns_of(scene, domain.elements(), On::elements, "");
  std::vector<std::pair<std::string, std::string>> alike;  // columns, and the families that have just these
  for (const auto& family : domain.families()) {
    const std::string columns = fmt::format("{} bytes per bond\n{}", row_bytes(family->rows(), On::bonds),
                                            columns_of(scene, family->rows(), On::bonds, family->name()));
    const auto there =
        std::find_if(alike.begin(), alike.end(), [&](const auto& each) { return each.first == columns; });
    if (there == alike.end())
      alike.emplace_back(columns, family->name());
    else
      there->second += ", " + family->name();
  }
  for (const auto& [columns, families] : alike) text += fmt::format("\nColumns on bonds of {}: {}", families, columns);
  if (!domain.scene().columns().empty())
    text += "\nNumbers of the scene\n" + columns_of(scene, domain.scene(), On::scene, "");
  return text;
}

// What is offered and nobody reads: such columns do not exist.
std::vector<std::string> declined(const Scene& scene) {
  std::vector<std::string> all;
  for (const auto& plugin : scene.plugins) {
    std::vector<std::string> names;
    for (const FieldUse* use : plugin->uses()) {
      if (use->verb() != Verb::writes || use->field().on != On::bonds) continue;
      const auto tables = plugin->tables(*scene.domain, On::bonds);
      if (std::none_of(tables.begin(), tables.end(),
                       [&](const Table* table) { return table->find(use->field().name); }))
        names.push_back(use->field().name);
    }
    if (!names.empty())
      all.push_back(fmt::format("columns that {} offers and nobody reads: {}", label(*plugin), join(names)));
  }
  return all;
}

std::string not_needed(const Scene& scene) {
  std::string text = "\nNot needed\n";
  const auto say = [&](bool absent, const std::string& what) {
    if (absent) text += "  " + what + "\n";
  };
  bool fails = false;
  for (const Stage& stage : scene.stages)
    for (const Failure* failure : stage.failures) fails |= failure->judges();
  say(!scene.domain->elements().find("orientation"), "rotations: nobody reads orientations or adds torques");
  say(!scene.has_contacts(), "search for neighbours: no law acts between elements that are not bonded");
  say(scene.section_readers.empty(), "forces and moments of single bonds: nobody reads them");
  say(scene.derived.empty(), "derived fields: nobody reads one");
  say(!fails, "judging bonds: no criterion of failure");
  for (const std::string& offer : declined(scene)) say(true, offer);
  return text;
}

}  // namespace

std::size_t row_bytes(const Table& table, On on) {
  std::size_t sum = 0;
  std::map<std::string, std::size_t> rows;  // what lies in one line has one stride
  for (const Column* column : table.columns()) {
    sum += bytes(column->field().type);
    rows[column->field().line] = column->stride();
  }
  if (on == On::bonds) return sum;  // each component apart: nothing is lost
  sum = 0;
  for (const auto& [name, stride] : rows) sum += stride;
  return sum;
}

std::string plan_text(const Scene& scene) {
  std::string text = filling(scene);
  for (std::size_t s = 0; s < scene.stages.size(); ++s) text += phases(scene, s);
  return text + curves(scene) + fields(scene) + not_needed(scene);
}

}  // namespace beadwork
