#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/base/readable.hpp"
#include "core/base/text.hpp"
#include "core/loop/assembly.hpp"

namespace beadwork {

namespace {

bool names(const Failure& failure, const std::string& family) {
  const std::vector<std::string> families = failure.families();
  return std::find(families.begin(), families.end(), family) != families.end();
}

}  // namespace

std::set<std::string> Assembly::made_names(Role role, const std::string& what) {
  std::map<std::string, Location> made;
  std::set<std::string> names;
  for (const auto& plugin : scene_.plugins)
    for (const ParamBase* p : plugin->params()) {
      if (p->info().role != role) continue;
      for (const std::string& name : p->names()) {
        names.insert(name);
        check_name(*p, name);
        // Filling plugins that work on one set in turn all name it; a family has one law, a region its own set.
        const auto* filler = as_kind<Filler>(std::as_const(*plugin));
        const auto [there, fresh] = made.try_emplace(name, p->at());
        if (!fresh && (role == Role::makes_family || (filler && filler->after_filling())))
          complaints_.error(p->at(),
                            fmt::format("{} '{}' exists already, made at {}", what, name, there->second.where()));
      }
    }
  return names;
}

void Assembly::check_uses_of(Role role, const std::string& what, const std::set<std::string>& known) {
  const Role makes = role == Role::set ? Role::makes_set : Role::makes_family;
  for (const auto& plugin : scene_.plugins)
    for (const ParamBase* p : plugin->params())
      if (p->info().role == makes && p->in_deck() && !p->given()) return;  // it might make any name
  for (const auto& plugin : scene_.plugins)
    for (const ParamBase* p : plugin->params()) {
      if (p->info().role != role) continue;
      for (const std::string& name : p->names())
        if (!known.contains(name) && !unread_names_.contains(name))
          complaints_.error(p->at(name), fmt::format("'{}' names {} \"{}\"{}", p->info().name, what, name,
                                                     known.empty() ? ", but the deck makes none"
                                                                   : did_you_mean(name, {known.begin(), known.end()})));
    }
}

// A set by region is found once, in the deck's order: of another region only behind it.
void Assembly::check_order_of_regions() {
  std::map<std::string, const Filler*> later;
  for (const Filler* filler : scene_.fillers)
    if (filler->after_filling())
      for (const ParamBase* p : filler->params())
        if (p->info().role == Role::makes_set)
          for (const std::string& name : p->names()) later.emplace(name, filler);
  for (const Filler* filler : scene_.fillers) {
    for (const ParamBase* p : filler->params())
      for (const std::string& name : p->names())
        if (p->info().role == Role::set && later.contains(name))
          complaints_.error(p->at(), fmt::format("set '{}' is made only later, at {}: put that in front", name,
                                                 later.at(name)->at().where()));
    std::erase_if(later, [&](const auto& made) { return made.second == filler; });
  }
}

// Two curves of one name would write over one another, in whatever stages their watchers stand.
void Assembly::check_curve_names() {
  std::map<std::string, const Watcher*> taken;
  for (const Watcher* watcher : watchers())
    for (const Curve* curve : watcher->curves()) {
      const Param<std::string>& name = curve->name();
      if (!name.given()) continue;
      check_name(name, *name);
      const auto [there, fresh] = taken.try_emplace(*name, watcher);
      if (!fresh)
        complaints_.error(name.in_deck() ? name.at() : watcher->at(),
                          fmt::format("a curve '{}' exists already, made at {}: give this one another '{}'", *name,
                                      there->second->at().where(), name.info().name));
    }
}

std::vector<const Watcher*> Assembly::watchers() const {
  std::vector<const Watcher*> all;
  for (const auto& plugin : scene_.plugins)
    if (const auto* watcher = as_kind<Watcher>(std::as_const(*plugin))) all.push_back(watcher);
  return all;
}

void Assembly::check_name(const ParamBase& param, const std::string& name) {
  if (!is_plain_name(name))
    complaints_.error(param.at(), fmt::format("'{}' wants {}, got \"{}\"", param.info().name, plain_name, name));
}

// It is told now, not after the filling that stands in front.
void Assembly::check_files() {
  for (const auto& plugin : scene_.plugins)
    for (const ParamBase* p : plugin->params()) {
      if (p->info().role != Role::file) continue;
      for (const std::string& path : p->names()) {
        if (const std::string why = why_unreadable(path); !why.empty())
          complaints_.error(p->at(), fmt::format("cannot read \"{}\": {}", path, why));
      }
    }
}

// A field is derived in one way.
void Assembly::check_derived() {
  std::map<std::string, Location> named;
  for (const auto& plugin : scene_.plugins) {
    if (plugin->kind() != Kind::derive) continue;
    const auto [there, fresh] = named.try_emplace(plugin->tag(), plugin->at());
    if (!fresh)
      complaints_.error(plugin->at(),
                        fmt::format("<{}> stands in <derive> already, at {}", plugin->tag(), there->second.where()));
  }
}

// Contacts come and go by themselves.
void Assembly::check_judged() {
  std::set<std::string> contacts;
  for (const auto& plugin : scene_.plugins)
    if (plugin->kind() == Kind::contact)
      for (const std::string& family : plugin->families()) contacts.insert(family);
  for (const auto& plugin : scene_.plugins)
    if (const auto* failure = as_kind<Failure>(std::as_const(*plugin)))
      for (const std::string& family : failure->families())
        if (contacts.contains(family))
          complaints_.error(failure->of.at(family),
                            fmt::format("'of' names the contacts \"{}\": bonds break, contacts do not", family));
}

// What is broken from the start is so when its bonds are made, and does nothing more.
void Assembly::check_flawed() {
  for (const auto& plugin : scene_.plugins) {
    const auto* failure = as_kind<Failure>(std::as_const(*plugin));
    if (!failure || failure->judges()) continue;
    for (const auto& other : scene_.plugins) {
      const auto* law = as_kind<BondLaw>(std::as_const(*other));
      if (!law || !names(*failure, law->family())) continue;
      const Location& at = failure->of.at(law->family());
      const Stage& stage = scene_.stages[scene_.first_stage(*law)];
      if (std::find(stage.failures.begin(), stage.failures.end(), failure) == stage.failures.end())
        complaints_.error(at,
                          fmt::format("bonds '{}' are made in stage '{}', where <{}> does not stand: what is broken "
                                      "from the start has to stand where they are made",
                                      law->family(), stage.name, failure->tag()));
      if (law->acts_when_broken())
        complaints_.error(at, fmt::format("'{}' cannot be broken from the start, as these contacts still act when they "
                                          "are broken; leave some out with their 'where'",
                                          law->family()));
    }
  }
}

void Assembly::check_neighbours() {
  for (const auto& plugin : scene_.plugins) {
    const auto* law = as_kind<BondLaw>(std::as_const(*plugin));
    if (law && law->neighbours.given() && *law->neighbours == "nearest" && law->between.given() &&
        (*law->between)[0] == (*law->between)[1])
      complaints_.error(
          law->neighbours.at(),
          "neighbours=\"nearest\" is for two sets: of each element of the second the nearest of the first");
  }
}

void Assembly::check_names() {
  check_judged();
  check_flawed();
  check_neighbours();
  check_derived();
  check_uses_of(Role::set, "set", made_names(Role::makes_set, "set"));
  check_uses_of(Role::family, "bond family", made_names(Role::makes_family, "bond family"));
  check_order_of_regions();
  check_curve_names();
  check_files();
}

}  // namespace beadwork
