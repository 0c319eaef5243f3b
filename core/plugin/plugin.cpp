#include "core/plugin/plugin.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/base/text.hpp"

namespace beadwork {

const char* verb_name(Verb verb) {
  switch (verb) {
    case Verb::reads: return "reads";
    case Verb::adds: return "adds";
    case Verb::writes: return "writes";
    case Verb::keeps: return "keeps";
    case Verb::sums: return "sums up";
  }
  return "";
}

FieldUse::FieldUse(Plugin* owner, Field field, Verb verb) : field_(std::move(field)), verb_(verb) {
  owner->uses_.push_back(this);
}

const ParamBase* Plugin::param(const std::string& name) const {
  for (const ParamBase* p : params_)
    if (p->info().name == name) return p;
  return nullptr;
}

void Plugin::configure(const Node& node, const std::string& id, const Scope& scope, Complaints& complaints) {
  tag_ = node.tag;
  id_ = id;
  at_ = node.at;
  std::vector<std::string> known;
  for (const ParamBase* p : params_) known.push_back(p->info().name);
  std::set<std::string> misspelt;  // what is wanted, where an unknown attribute is that
  for (const Attribute& attribute : node.attributes)
    if (!param(attribute.name)) misspelt.insert(closest(attribute.name, known));
  for (ParamBase* p : params_) {
    if (const Attribute* attribute = node.find(p->info().name)) {
      p->read(*attribute, scope, complaints);
    } else if (p->info().instead.empty() || !node.find(p->info().instead)) {
      p->read_fallback(node.at, scope, complaints);
      if (p->needed() && !misspelt.contains(p->info().name))
        complaints.error(node.at, fmt::format("<{}> needs '{}': {}", tag_, p->info().name, p->info().doc));
    }
  }
  for (const Attribute& attribute : node.attributes)
    if (!param(attribute.name))
      complaints.error(attribute.name_at, fmt::format("<{}> has no attribute '{}'{}", tag_, attribute.name,
                                                      did_you_mean(attribute.name, known)));
  for (const auto& child : node.children)
    complaints.error(child->at, fmt::format("<{}> takes no <{}> inside it", tag_, child->tag));
  const bool group_is_misspelt = std::any_of(params_.begin(), params_.end(), [&](const ParamBase* p) {
    return !p->info().one_of.empty() && misspelt.contains(p->info().name);
  });
  if (!group_is_misspelt) check_groups(complaints);
}

std::string Plugin::column_name(const FieldUse& use) const {
  return use.field().on == On::scene || use.is_own() ? id_ + "." + use.field().name : use.field().name;
}

void Plugin::bind(Domain& domain) {
  for (FieldUse* use : uses_) {
    // A column to keep may have been made later than the plugin could tell, when its bonds were made.
    if (!use->wanted() && use->verb() != Verb::keeps) continue;
    std::vector<Column*> columns;
    for (Table* table : tables(domain, use->field().on)) columns.push_back(table->find(column_name(*use)));
    use->bind(columns);
  }
}

std::vector<Table*> Plugin::tables(Domain& domain, On on) const {
  if (on == On::elements) return {&domain.elements()};
  if (on == On::scene) return {&domain.scene()};
  std::vector<Table*> mine;
  for (const std::string& family : families())
    if (BondTable* table = domain.find_family(family)) mine.push_back(&table->rows());
  return mine;
}

void Plugin::turn_to(std::size_t family) {
  for (FieldUse* use : uses_)
    if (use->field().on == On::bonds) use->turn_to(family);
}

std::vector<const ParamBase*> Plugin::one_of(const std::string& group) const {
  std::vector<const ParamBase*> members;
  for (const ParamBase* p : params_)
    if (p->info().one_of == group) members.push_back(p);
  return members;
}

// Told once for each group, at its first member.
void Plugin::check_groups(Complaints& complaints) const {
  for (const ParamBase* p : params_) {
    if (p->info().one_of.empty()) continue;
    const auto members = one_of(p->info().one_of);
    if (members.front() != p) continue;
    std::vector<std::string> all, there;
    for (const ParamBase* member : members) {
      all.push_back("'" + member->info().name + "'");
      if (member->in_deck()) there.push_back(all.back());
    }
    if (there.size() == 1) continue;
    complaints.error(at_, fmt::format("exactly one of {} is wanted, {}", join(all),
                                      there.empty() ? "none is given" : "got " + join(there, " and ")));
  }
}

}  // namespace beadwork
