#include <algorithm>

#include "core/base/text.hpp"
#include "core/deck/read.hpp"
#include "core/loop/assembly.hpp"

namespace beadwork {

void Assembly::resolve() {
  const Node& root = *deck_.root;
  const auto place = [&](const char* name) { return root.find(name) ? root.find(name)->value_at : root.at; };
  PlainNode plain{"scene",
                  {{"name", scene_.name, place("name")}, {"seed", std::to_string(scene_.seed), place("seed")}},
                  {},
                  root.at};
  if (!scene_.libraries.empty())
    plain.attributes.push_back(
        {"plugins", text_of_paths({scene_.libraries.begin(), scene_.libraries.end()}), place("plugins")});
  std::size_t plugins = 0, stages = 0;
  resolve_sections(root, plain, plugins, stages);
  scene_.resolved = resolved_xml(plain);
  scene_.resolved_tree = std::move(plain);
}

// Plugins and stages stand in the scene as in the deck: `plugins` and `stages` of them have been met.
void Assembly::resolve_sections(const Node& parent, PlainNode& plain, std::size_t& plugins, std::size_t& stages) {
  for (const auto& child : parent.children) {
    PlainNode& made = plain.children.emplace_back(PlainNode{child->tag, {}, {}, child->at});
    if (child->tag != "stage") {
      for (std::size_t k = 0; k < child->children.size(); ++k)
        made.children.push_back(resolved(*scene_.plugins[plugins++]));
      continue;
    }
    const Stage& stage = scene_.stages[stages++];
    const Attribute *name = child->find("name"), *until = child->find("until");
    made.attributes.push_back({"name", stage.name, name ? name->value_at : child->at});
    if (until) made.attributes.push_back({"until", stage.until->si(), until->value_at});
    resolve_sections(*child, made, plugins, stages);
  }
}

PlainNode Assembly::resolved(const Plugin& plugin) {
  PlainNode node{plugin.tag(), {}, {}, plugin.at()};
  for (const ParamBase* p : plugin.params())
    if (p->given()) node.attributes.push_back({p->info().name, resolved(plugin, *p), p->at()});
  return node;
}

// What only the loop understands is a text to the plugin.
std::string Assembly::resolved(const Plugin& plugin, const ParamBase& param) {
  if (const auto* mover = as_kind<Mover>(plugin); mover && &param == &mover->until) {
    const auto until = Until::compile(*mover->until, param.at(), deck_.scope, complaints_);
    return until ? until->si() : "";
  }
  if (const auto* watcher = as_kind<Watcher>(plugin); watcher && &param == &watcher->moments) {
    std::vector<std::string> marks;
    for (const Mark& mark : Mark::list(*watcher->moments, "at", param.at(), deck_.scope, complaints_))
      marks.push_back(mark.si());
    const auto words = split(*watcher->moments, ',');
    if (std::any_of(words.begin(), words.end(), [](const std::string& word) { return trim(word) == "end"; }))
      marks.push_back("end");
    return join(marks, ", ");
  }
  return param.text();
}

}  // namespace beadwork
