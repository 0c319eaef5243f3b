#include <fmt/format.h>

#include "core/base/text.hpp"
#include "core/loop/assembly.hpp"

namespace beadwork {

std::set<std::string> Assembly::made_names(Role role, const std::string& what) {
  std::map<std::string, Location> made;
  std::set<std::string> names;
  for (const auto& plugin : scene_.plugins)
    for (const ParamBase* p : plugin->params()) {
      if (p->info().role != role) continue;
      for (const std::string& name : p->names()) {
        names.insert(name);
        // Filling plugins that work on one set in turn all name it; a family has one law.
        const auto [there, fresh] = made.try_emplace(name, p->at());
        if (!fresh && role == Role::makes_family)
          complaints_.error(p->at(), fmt::format("{} '{}' exists already, made at {}", what, name, there->second.where()));
      }
    }
  return names;
}

void Assembly::check_uses_of(Role role, const std::string& what, const std::set<std::string>& known) {
  for (const auto& plugin : scene_.plugins)
    for (const ParamBase* p : plugin->params()) {
      if (p->info().role != role) continue;
      for (const std::string& name : p->names())
        if (!known.contains(name))
          complaints_.error(p->at(), fmt::format("'{}' names {} \"{}\"{}", p->info().name, what, name,
                                                 known.empty() ? ", but the deck makes none"
                                                               : did_you_mean(name, {known.begin(), known.end()})));
    }
}

void Assembly::check_names() {
  check_uses_of(Role::set, "set", made_names(Role::makes_set, "set"));
  check_uses_of(Role::family, "bond family", made_names(Role::makes_family, "bond family"));
}

}  // namespace beadwork
