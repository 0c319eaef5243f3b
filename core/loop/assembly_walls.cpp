#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/loop/assembly.hpp"
#include "core/plugin/blame.hpp"

namespace beadwork {

namespace {

constexpr unsigned turns = 0b111000;  // degrees of freedom, bit by bit

unsigned held_by(const std::vector<Constraint>& all) {
  unsigned bits = 0;
  for (const Constraint& c : all) bits |= c.prescribes();
  return bits;
}

bool is_wall(const std::vector<const Filler*>& fillers, const std::string& set) {
  return std::any_of(fillers.begin(), fillers.end(), [&](const Filler* filler) {
    const ParamBase* name = filler->makes_walls() ? filler->param("set") : nullptr;
    return name && name->given() && name->text() == set;
  });
}

}  // namespace

std::vector<Constraint> Stage::constraints() const {
  std::vector<Constraint> all;
  for (const Load* load : loads)
    for (Constraint& c : blaming(*load, "constraints", [&] { return load->constraints(); })) {
      c.place = load->at().where();
      if (is_wall(fillers, c.set)) c.grip = Grip::each;  // it is one body, and its mean itself
      all.push_back(std::move(c));
    }
  for (const Filler* filler : fillers)
    for (Constraint& c : blaming(*filler, "constraints", [&] { return filler->constraints(); })) {
      if (std::any_of(all.begin(), all.end(),
                      [&](const Constraint& o) { return o.set == c.set && (o.prescribes() & c.prescribes()); }))
        continue;
      c.place = filler->at().where();
      all.push_back(std::move(c));
    }
  return all;
}

// A set is of walls or of elements. Contacts are told that they face walls; bonds hold none.
void Assembly::note_walls() {
  const std::map<std::string, const Filler*> makers = makers_of_sets();
  const auto is_of_walls = [&](const std::string& set) {
    const auto found = makers.find(set);
    return found != makers.end() && found->second->makes_walls();
  };
  warn_of_idle_loads(makers);
  for (const auto& plugin : scene_.plugins) {
    if (const auto* bonds = as_kind<BondLaw>(std::as_const(*plugin)); bonds && bonds->between.given())
      for (const std::string& set : *bonds->between)
        if (is_of_walls(set))
          complaints_.error(bonds->between.at(set),
                            fmt::format("\"{}\" is a wall, which no bond holds: elements touch it by contacts", set));
    auto* contacts = as_kind<ContactLaw>(*plugin);
    if (!contacts || !contacts->between.given()) continue;
    const auto walls = std::find_if(contacts->between->begin(), contacts->between->end(), is_of_walls);
    const auto count = std::count_if(contacts->between->begin(), contacts->between->end(), is_of_walls);
    if (count == 1) contacts->face_walls(may_turn(*walls, *makers.at(*walls)));
    if (count == 2)
      complaints_.error(contacts->between.at(), "'between' names walls only: walls pass through one another");
  }
}

// What pushes a wall that only moves as loads prescribe does nothing.
void Assembly::warn_of_idle_loads(const std::map<std::string, const Filler*>& makers) {
  for (const auto& plugin : scene_.plugins) {
    const auto* load = as_kind<Load>(std::as_const(*plugin));
    const ParamBase* set = load ? load->param("set") : nullptr;
    if (!set || !set->given()) continue;
    const auto maker = makers.find(set->text());
    if (maker == makers.end() || !maker->second->makes_walls()) continue;
    if (!blaming(*load, "constraints", [&] { return load->constraints(); }).empty()) continue;
    constexpr unsigned all = 0b111111;
    if (held_by(maker->second->constraints()) == all)
      complaints_.warning(set->at(),
                          fmt::format("wall '{}' has no 'mass', so that <{}> does not move it: it stands still "
                                      "where no load prescribes its motion",
                                      set->text(), load->tag()));
  }
}

// The first that makes each; others add to it, if they are of its kind.
std::map<std::string, const Filler*> Assembly::makers_of_sets() {
  std::map<std::string, const Filler*> makers;
  for (const Filler* filler : scene_.fillers)
    for (const ParamBase* p : filler->params()) {
      if (p->info().role != Role::makes_set) continue;
      for (const std::string& name : p->names()) {
        const auto [there, fresh] = makers.try_emplace(name, filler);
        if (fresh) continue;
        if (there->second->makes_walls() != filler->makes_walls())
          complaints_.error(p->at(),
                            fmt::format("set '{}' cannot be of elements and of walls: give one another name", name));
        else if (held_by(there->second->constraints()) != held_by(filler->constraints()))
          complaints_.error(p->at(), fmt::format("walls of one set, here '{}', move alike: give all of them 'mass' and "
                                                 "'inertia', or none, or give this one another name",
                                                 name));
      }
    }
  return makers;
}

// Where nothing turns it, nothing has to know how it is turned.
bool Assembly::may_turn(const std::string& set, const Filler& maker) const {
  if ((held_by(maker.constraints()) & turns) != turns) return true;
  return std::any_of(scene_.plugins.begin(), scene_.plugins.end(), [&](const auto& plugin) {
    const auto* load = as_kind<Load>(std::as_const(*plugin));
    if (!load) return false;
    const auto all = blaming(*load, "constraints", [&] { return load->constraints(); });
    return std::any_of(all.begin(), all.end(),
                       [&](const Constraint& c) { return c.set == set && c.driven && (c.prescribes() & turns) != 0; });
  });
}

}  // namespace beadwork
