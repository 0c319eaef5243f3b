#include "core/loop/assembly.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/text.hpp"
#include "core/base/units.hpp"
#include "core/deck/read.hpp"
#include "core/plugin/blame.hpp"
#include "core/plugin/stamp.hpp"

namespace beadwork {

namespace {

/// How a stage holds the plugins of a kind.
struct InStage {
  Kind kind;
  void (*enlist)(Stage& stage, Plugin& plugin);
  void (*inherit)(Stage& stage, const Stage& common);
  void (*list)(const Stage& stage, std::vector<const Plugin*>& all);
};
template <class K, std::vector<K*> Stage::*list>
constexpr InStage in_stage{K::its_kind,
                           [](Stage& stage, Plugin& plugin) { (stage.*list).push_back(static_cast<K*>(&plugin)); },
                           [](Stage& stage, const Stage& common) {
                             (stage.*list).insert((stage.*list).begin(), (common.*list).begin(), (common.*list).end());
                           },
                           [](const Stage& stage, std::vector<const Plugin*>& all) {
                             all.insert(all.end(), (stage.*list).begin(), (stage.*list).end());
                           }};
constexpr InStage stage_kinds[] = {in_stage<BondLaw, &Stage::laws>,     in_stage<ContactLaw, &Stage::contacts>,
                                   in_stage<Load, &Stage::loads>,       in_stage<Mover, &Stage::movers>,
                                   in_stage<Failure, &Stage::failures>, in_stage<Watcher, &Stage::watchers>};

/// The kind whose section this is, where such a section may stand.
const KindRow* section(const std::string& tag, bool inside_stage) {
  for (const KindRow& row : all_kinds)
    if (tag == row.name && (row.in_stages || !inside_stage)) return &row;
  return nullptr;
}

/// The name of its curve, if it has one.
std::string curve_of(const Watcher& watcher) {
  const ParamBase* name = watcher.param("name");
  return name && name->given() ? name->text() : "";
}

bool holds(const std::vector<Mover*>& movers, const Mover* mover) {
  return std::find(movers.begin(), movers.end(), mover) != movers.end();
}

std::vector<std::string> section_names(bool inside_stage) {
  std::vector<std::string> names;
  for (const KindRow& row : all_kinds)
    if (row.in_stages || !inside_stage) names.push_back(row.name);
  if (!inside_stage) names.push_back("stage");
  return names;
}

}  // namespace

std::unique_ptr<Scene> Scene::assemble(const Deck& deck, const Catalogue& catalogue, Complaints& complaints) {
  auto scene = std::make_unique<Scene>();
  Assembly(deck, catalogue, complaints, *scene).run();
  if (complaints.errors() > 0) return nullptr;
  return scene;
}

bool Stage::watched_by(const Watcher& watcher) const {
  return std::find(watchers.begin(), watchers.end(), &watcher) != watchers.end();
}

std::optional<std::size_t> Stage::gauge_named(const std::string& curve) const {
  for (std::size_t w = 0; w < watchers.size(); ++w)
    if (watchers[w]->gauge() && curve_of(*watchers[w]) == curve) return w;
  return std::nullopt;
}

void Scene::bind() const {
  for (const auto& plugin : plugins) plugin->bind(*domain);
}

std::vector<const Plugin*> Stage::plugins() const {
  std::vector<const Plugin*> all;
  for (const InStage& kind : stage_kinds) kind.list(*this, all);
  return all;
}

bool Scene::has_contacts() const {
  return std::any_of(stages.begin(), stages.end(), [](const Stage& stage) { return !stage.contacts.empty(); });
}

std::size_t Scene::first_stage(const Plugin& plugin) const {
  for (std::size_t s = 0; s < stages.size(); ++s) {
    const auto there = stages[s].plugins();
    if (std::find(there.begin(), there.end(), &plugin) != there.end()) return s;
  }
  return stages.size();
}

std::vector<std::string> Scene::files() const {
  std::vector<std::string> all;
  for (const auto& plugin : plugins)
    for (const ParamBase* p : plugin->params())
      if (p->info().role == Role::file)
        for (const std::string& path : p->names()) all.push_back(path);
  all.insert(all.end(), libraries.begin(), libraries.end());
  return all;
}

void Assembly::run() {
  scene_.domain = std::make_unique<Domain>();
  read_root();
  if (complaints_.errors() == 0) {
    for (const auto& plugin : scene_.plugins) blaming(*plugin, "families", [&] { return plugin->families(); });
    for (const auto& plugin : scene_.plugins) blaming(*plugin, "check", [&] { plugin->check(complaints_); });
    note_walls();
    for (const auto& plugin : scene_.plugins) blaming(*plugin, "choose", [&] { plugin->choose(); });
  }
  if (!scene_.studies.empty()) return check_study();
  merge_common_into_stages();
  check_names();
  for (Stage& stage : scene_.stages) check_stage(stage);
  if (is_read(Kind::fill) &&
      std::none_of(scene_.fillers.begin(), scene_.fillers.end(), [](const Filler* f) { return !f->after_filling(); }))
    complaints_.error(deck_.root->at, "the scene has no elements: <fill> needs a plugin that makes some");
  if (is_read(Kind::load)) complain_of_hopeless();
  if (complaints_.errors() == 0) {  // else a law or a load may be missing that is only misspelt
    for (const Stage& stage : scene_.stages)
      blaming(stage.mover(), "check_stage", [&] {
        stage.mover().check_stage(stage.name, !stage.laws.empty() || !stage.contacts.empty(), complaints_);
      });
    check_watchers();
  }
  deck_.scope.complain_about_unused(*deck_.root, complaints_);
  if (complaints_.errors() == 0) lay_out_fields();
  if (complaints_.errors() == 0) check_awaited();
  if (complaints_.errors() == 0) resolve();
}

void Assembly::read_root() {
  const Node& root = *deck_.root;
  scene_.name = std::filesystem::path(deck_.path).stem().string();
  scene_.deck_path = deck_.path;
  scene_.deck_sha256 = deck_.sha256;
  scene_.overrides = deck_.overrides;
  if (!deck_.sources.empty()) scene_.deck_text = deck_.sources.front()->text;
  for (const Attribute& attribute : root.attributes) {
    if (attribute.name == "name") {
      if (const auto text = read_text(attribute, deck_.scope, complaints_)) scene_.name = *text;
    } else if (attribute.name == "seed") {
      const auto seed = read_integer(attribute, deck_.scope, complaints_);
      if (seed && *seed < 0)
        complaints_.error(attribute.value_at, fmt::format("'seed' must be >= 0, got \"{}\"", attribute.value));
      if (seed) scene_.seed = static_cast<std::uint64_t>(*seed);
    } else if (attribute.name != "plugins") {
      complaints_.error(attribute.name_at, fmt::format("<scene> has no attribute '{}'{}", attribute.name,
                                                       did_you_mean(attribute.name, {"name", "seed", "plugins"})));
    }
  }
  read_sections(root, common_, false);
}

void Assembly::read_sections(const Node& parent, Stage& stage, bool inside_stage) {
  for (const auto& child : parent.children) {
    if (const KindRow* kind = section(child->tag, inside_stage)) {
      for (const Attribute& attribute : child->attributes)
        complaints_.error(attribute.name_at, fmt::format("<{}> takes no attributes", child->tag));
      read_section(kind->kind, *child, stage);
    } else if (child->tag == "stage" && !inside_stage) {
      Stage& made = scene_.stages.emplace_back();
      made.at = child->at;
      made.name = fmt::format("stage-{}", scene_.stages.size());
      for (const Attribute& attribute : child->attributes) {
        if (attribute.name == "name") {
          if (const auto text = read_text(attribute, deck_.scope, complaints_)) made.name = *text;
        } else if (attribute.name != "until") {
          unread_kinds_.insert(Kind::move);
          complaints_.error(attribute.name_at, fmt::format("<stage> has no attribute '{}'{}", attribute.name,
                                                           did_you_mean(attribute.name, {"name", "until"})));
        }
      }
      const auto [there, fresh] = until_nodes_.try_emplace(made.name, child.get());
      if (!fresh)
        complaints_.error(child->at,
                          fmt::format("stage '{}' exists already, made at {}", made.name, there->second->at.where()));
      read_sections(*child, made, true);
    } else {
      const auto known = section_names(inside_stage);
      note_unread(*child);
      for (const KindRow& row : all_kinds) unread_kinds_.insert(row.kind);
      complaints_.error(child->at, fmt::format("no section <{}> in <{}>{}", child->tag, parent.tag,
                                               did_you_mean(child->tag, known, "<", ">")));
    }
  }
}

void Assembly::read_section(Kind kind, const Node& section, Stage& stage) {
  for (const auto& node : section.children) {
    std::unique_ptr<Plugin> plugin = make(kind, node->tag, node->at);
    if (!plugin) {
      complain_of_tag(kind, *node);
      note_unread(*node);
      unread_kinds_.insert(kind);
      continue;
    }
    const std::string base = fmt::format("{}.{}", kind_name(kind), node->tag);
    const int number = ++counts_[base];
    plugin->configure(*node, number == 1 ? base : fmt::format("{}.{}", base, number), deck_.scope, complaints_);
    for (const Attribute& attribute : node->attributes)
      if (!plugin->param(attribute.name)) {
        note_unread(*node);
        unread_kinds_.insert(kind);
      }
    for (const ParamBase* p : plugin->params())
      if (p->in_deck() && !p->given()) unread_kinds_.insert(kind);
    enlist(*plugin, stage);
    scene_.plugins.push_back(std::move(plugin));
  }
}

std::unique_ptr<Plugin> Assembly::make(Kind kind, const std::string& tag, const Location& at) {
  if (const std::string library = catalogue_.named_library(kind, tag); !library.empty())
    scene_.libraries.insert(library);
  return catalogue_.make(kind, tag, at.where());
}

void Assembly::complain_of_tag(Kind kind, const Node& node) {
  const auto elsewhere = catalogue_.kinds_of(node.tag);
  unread_kinds_.insert(elsewhere.begin(), elsewhere.end());
  if (!elsewhere.empty()) {
    complaints_.error(node.at, fmt::format("<{}> belongs in <{}>, not in <{}>", node.tag, kind_name(elsewhere.front()),
                                           kind_name(kind)));
    return;
  }
  complaints_.error(node.at, fmt::format("no <{}> in <{}>{}", node.tag, kind_name(kind),
                                         did_you_mean(node.tag, catalogue_.tags(kind), "<", ">")));
}

void Assembly::note_unread(const Node& node) {
  for (const Attribute& attribute : node.attributes)
    for (std::string& word : split_words(attribute.value)) unread_names_.insert(std::move(word));
  for (const auto& child : node.children) note_unread(*child);
}

bool Assembly::is_read(Kind kind) const { return !unread_kinds_.contains(kind); }

void Assembly::enlist(Plugin& plugin, Stage& stage) {
  if (auto* filler = as_kind<Filler>(plugin)) scene_.fillers.push_back(filler);
  if (auto* study = as_kind<Study>(plugin)) scene_.studies.push_back(study);
  for (const InStage& kind : stage_kinds)
    if (kind.kind == plugin.kind()) kind.enlist(stage, plugin);
}

// Its scenes stand in decks of their own.
void Assembly::check_study() {
  const Study& study = *scene_.studies.front();
  for (const auto& plugin : scene_.plugins)
    if (plugin->kind() != Kind::study)
      complaints_.error(plugin->at(), fmt::format("<{}> stands beside a study ({}): a deck with a study runs other "
                                                  "decks and has no scene of its own",
                                                  plugin->tag(), study.at().where()));
  const bool is_batch = std::all_of(scene_.studies.begin(), scene_.studies.end(),
                                    [&](const Study* each) { return each->is_of_batch(); });
  if (scene_.studies.size() > 1 && !is_batch)
    complaints_.error(scene_.studies[1]->at(), fmt::format("a deck has one study, or sweeps and what is expected of "
                                                           "them, and there is one at {} already",
                                                           study.at().where()));
  deck_.scope.complain_about_unused(*deck_.root, complaints_);
  if (complaints_.errors() == 0) resolve();
}

void Assembly::merge_common_into_stages() {
  if (scene_.stages.empty()) {
    common_.name = "run";
    common_.at = deck_.root->at;
    scene_.stages.push_back(common_);
  } else {
    for (Stage& stage : scene_.stages)
      for (const InStage& kind : stage_kinds) kind.inherit(stage, common_);
  }
  for (Stage& stage : scene_.stages) stage.fillers.assign(scene_.fillers.begin(), scene_.fillers.end());
}

void Assembly::check_stage(Stage& stage) {
  if (stage.movers.empty() && !is_read(Kind::move)) return;
  if (stage.movers.size() != 1) {
    const std::string where = stage.name == "run" ? "a deck" : fmt::format("stage '{}'", stage.name);
    complaints_.error(stage.movers.empty() ? stage.at : stage.movers[1]->at(),
                      fmt::format("{} wants exactly one mover in <move>, got {}", where, stage.movers.size()));
    return;
  }
  compile_until(stage);
  compile_marks(stage);
}

void Assembly::check_watchers() {
  for (const Watcher* watcher : watchers()) {
    const auto seen = constraints_seen_by(*watcher);
    blaming(*watcher, "check_stages", [&] { watcher->check_stages(seen, complaints_); });
  }
}

std::vector<Constraint> Assembly::constraints_seen_by(const Watcher& watcher) const {
  std::vector<Constraint> seen;
  for (const Stage& stage : scene_.stages)
    if (stage.watched_by(watcher))
      for (Constraint& c : stage.constraints()) seen.push_back(std::move(c));
  return seen;
}

void Assembly::compile_until(Stage& stage) {
  std::string text;
  Location at = stage.at;
  const auto node = until_nodes_.find(stage.name);
  const Attribute* own = node == until_nodes_.end() ? nullptr : node->second->find("until");
  if (own) {
    const ParamBase& second = stage.mover().until;
    if (second.in_deck() && !holds(common_.movers, &stage.mover()))
      complaints_.error(second.at(), fmt::format("'until' of stage '{}' is given twice, also at {}", stage.name,
                                                 own->value_at.where()));
    const auto read = read_text(*own, deck_.scope, complaints_);
    if (!read) return;
    text = *read;
    at = own->value_at;
  } else if (stage.mover().until.given()) {
    text = *stage.mover().until;
    at = stage.mover().until.at();
  } else if (stage.mover().until.in_deck()) {
    return;  // what is wrong with it has been said
  } else if (!is_read(Kind::move)) {
    return;  // it may be there, misspelt
  } else {
    complaints_.error(stage.mover().at(),
                      fmt::format("<{}> needs 'until': {}", stage.mover().tag(), stage.mover().until.info().doc));
    return;
  }
  stage.until = Until::compile(text, at, deck_.scope, complaints_);
  if (!stage.until) return;
  const auto prospects =
      stage.until->prospects(stage.constraints(), [&](const std::string& name) { return why_untold(stage, name); });
  const bool ends =
      std::any_of(prospects.begin(), prospects.end(), [](const Until::Prospect& p) { return p.why_never.empty(); });
  for (const Until::Prospect& p : prospects) {
    if (!ends) endless_.push_back(p);
    note_prospect("until", p.at, p.why_never);
  }
}

std::string Assembly::why_untold(const Stage& stage, const std::string& name) const {
  if (stage.gauge_named(name) || !is_read(Kind::watch)) return "";
  std::vector<std::string> known;
  for (const Watcher* watcher : watchers())
    if (watcher->gauge()) known.push_back(curve_of(*watcher));
  if (std::find(known.begin(), known.end(), name) != known.end())
    return fmt::format("waits for sensor '{}', which does not look in stage '{}'", name, stage.name);
  return fmt::format("waits for sensor \"{}\", {}", name,
                     known.empty() ? "but <watch> has none" : "which is not in <watch>" + did_you_mean(name, known));
}

// Only now do sensors know the units of what they look at.
void Assembly::check_awaited() {
  std::set<std::string> told;  // one 'until' may stand for several stages
  for (const Stage& stage : scene_.stages)
    for (const Until::Awaited& awaited : stage.until->awaited()) {
      const auto number = stage.gauge_named(awaited.name);
      if (!number) continue;  // it looks in another stage of the same 'until'
      const Watcher& watcher = *stage.watchers[*number];
      const std::string unit = blaming(watcher, "unit", [&] { return watcher.gauge()->unit(*scene_.domain); });
      if (awaited.is_zero || awaited.dimension == find_unit(unit)->dimension) continue;
      if (!told.insert(awaited.value_at.where()).second) continue;
      complaints_.error(
          awaited.value_at,
          fmt::format("'until' compares sensor '{}' with {}, got \"{}\" which is {}", awaited.name, wanted_by(unit),
                      awaited.value, awaited.dimension.is_plain() ? "a plain number" : awaited.dimension.name()));
    }
}

// What stands outside of the stages may come in one of them only.
void Assembly::note_prospect(const std::string& attribute, const Location& at, const std::string& why_never) {
  Hope& hope = hopes_[fmt::format("{} of '{}'", at.where(), attribute)];
  hope.comes |= why_never.empty();
  if (!why_never.empty()) hope = {at, fmt::format("'{}' {}", attribute, why_never), hope.comes};
}

void Assembly::complain_of_hopeless() {
  for (const Until::Prospect& p : endless_) complaints_.error(p.at, fmt::format("'until' {}", p.why_never));
  for (const auto& [place, hope] : hopes_)
    if (!hope.comes) complaints_.error(hope.at, hope.why_never);
}

// The moments of a watcher that stands outside of the stages count anew in each.
void Assembly::compile_marks(Stage& stage) {
  for (const Watcher* watcher : stage.watchers) {
    auto& marks = stage.marks.emplace_back();
    if (!watcher->moments.given()) continue;
    marks = Mark::list(*watcher->moments, "at", watcher->moments.at(), deck_.scope, complaints_);
    for (const Mark& mark : marks) note_prospect("at", mark.at, mark.why_never(stage.constraints()));
  }
}

}  // namespace beadwork
