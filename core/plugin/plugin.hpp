#pragma once
// A plugin is its parameters, the fields that it touches, and the one or two functions of its kind (kinds.hpp).

#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "core/plugin/param.hpp"
#include "core/plugin/use.hpp"

namespace beadwork {

enum class Kind { fill, bond, contact, load, move, fail, derive, watch, study };

struct KindRow {
  Kind kind;
  const char* name;  ///< the section of the deck and the folder of the sources
  bool in_stages;    ///< its section may stand in a stage
  const char* doc;
};
/// All kinds, in the order of the manual.
inline constexpr KindRow all_kinds[] = {
    {Kind::fill, "fill", false,
     "Adds elements and names sets of them. Runs once, before all else, in the deck's order."},
    {Kind::bond, "bond", true,
     "Bonds elements, one family for each law. Made at the start of the stage in which the law first stands; acts at "
     "every evaluation of the forces."},
    {Kind::contact, "contact", true,
     "Acts between elements that touch and are not bonded. Pairs come and go with the motion."},
    {Kind::load, "load", true, "Moves or holds sets of elements, pushes them, or gives them a velocity to start with."},
    {Kind::move, "move", true, "Advances the scene by one step. A stage has exactly one."},
    {Kind::fail, "fail", true,
     "Judges, after the forces, which bonds or elements fail: a bond breaks, an element loses its bonds."},
    {Kind::derive, "derive", false,
     "Provides a field that somebody reads, and runs only in the steps in which it is read. It is added by itself; a "
     "deck names it only to set its parameters."},
    {Kind::watch, "watch", true, "Looks at the scene every few steps and records. Changes nothing."},
    {Kind::study, "study", false,
     "Runs whole scenes and learns from what comes of them. A deck with a study has no scene of its own."},
};
constexpr const KindRow& row_of(Kind kind) { return all_kinds[static_cast<std::size_t>(kind)]; }
/// Of what another library hands over.
constexpr bool is_kind(Kind kind) { return static_cast<std::size_t>(kind) < std::size(all_kinds); }
constexpr const char* kind_name(Kind kind) { return row_of(kind).name; }

/// Where an energy stands in the balance  work = stored + kinetic + dissipated.
class EnergySink {
 public:
  virtual ~EnergySink() = default;
  virtual void work(const std::string& by, Real joule) = 0;
  virtual void stored(const std::string& in, Real joule) = 0;
  virtual void kinetic(Real joule) = 0;
  virtual void dissipated(const std::string& by, Real joule) = 0;
};

/// The balance by kinds of energy alone.
struct EnergySums final : EnergySink {
  void work(const std::string&, Real joule) override { worked += joule; }
  void stored(const std::string&, Real joule) override { in_bonds += joule; }
  void kinetic(Real joule) override { in_motion += joule; }
  void dissipated(const std::string&, Real joule) override { taken += joule; }
  /// What is there, or was and is booked, beyond the work done.
  Real beyond_work() const { return in_bonds + in_motion + taken - worked; }
  Real worked = 0, in_bonds = 0, in_motion = 0, taken = 0;
};

class Plugin {
 public:
  virtual ~Plugin() = default;
  Plugin(const Plugin&) = delete;
  Plugin& operator=(const Plugin&) = delete;

  Kind kind() const { return kind_; }
  const std::string& tag() const { return tag_; }
  /// Unique in its scene, e.g. "watch.force-curve.2": names the plugin's own scene fields and files.
  const std::string& id() const { return id_; }
  const Location& at() const { return at_; }
  const std::vector<ParamBase*>& params() const { return params_; }
  const std::vector<FieldUse*>& uses() const { return uses_; }
  const ParamBase* param(const std::string& name) const;
  /// The parameters that name this group as their `one_of`.
  std::vector<const ParamBase*> one_of(const std::string& group) const;

  /// Reads the node's attributes into the parameters; complains of what is unknown, missing or out of range.
  void configure(const Node& node, const std::string& id, const Scope& scope, Complaints& complaints);
  /// Points the views of all uses at the columns of this domain.
  void bind(Domain& domain);
  /// The tables on which its fields on elements, bonds (one for each of its families) or the scene live.
  std::vector<Table*> tables(Domain& domain, On on) const;
  /// Name under which a use's field stands in its table.
  std::string column_name(const FieldUse& use) const;

  /// Relations between parameters, e.g. u_p > u_e.
  virtual void check(Complaints&) const {}
  /// Drops the uses that the deck's choices make needless.
  virtual void choose() {}
  /// The families on whose tables the fields "on bonds" live.
  virtual std::vector<std::string> families() const { return {}; }
  /// Adds what the plugin knows of the energy balance.
  virtual void energy(EnergySink&) const {}

 protected:
  explicit Plugin(Kind kind) : kind_(kind) {}

  /// f(table) for each of its families: meanwhile the fields "on bonds" are those of this one.
  template <class F>
  void each_family(const Domain& domain, const F& f) {
    const std::vector<std::string> names = families();
    for (std::size_t k = 0; k < names.size(); ++k) {
      turn_to(k);
      f(*domain.find_family(names[k]));
    }
    if (names.size() > 1) turn_to(0);
  }

 private:
  void turn_to(std::size_t family);
  void check_groups(Complaints& complaints) const;
  friend class ParamBase;
  friend class FieldUse;
  Kind kind_;
  std::vector<ParamBase*> params_;
  std::vector<FieldUse*> uses_;
  std::string tag_;
  std::string id_;
  Location at_;
};

/// What a library hands over of one plugin.
struct PluginEntry {
  Kind kind;
  std::string tag;
  std::string about;  ///< one line
  std::unique_ptr<Plugin> (*make)();
};

/// The plugin as one of kind K; nullptr if it is of another. Classes have no identity across libraries, kinds have.
template <class K>
K* as_kind(Plugin& plugin) {
  return plugin.kind() == K::its_kind ? static_cast<K*>(&plugin) : nullptr;
}
template <class K>
const K* as_kind(const Plugin& plugin) {
  return plugin.kind() == K::its_kind ? static_cast<const K*>(&plugin) : nullptr;
}

template <class P>
PluginEntry entry(const char* tag) {
  return {P::its_kind, tag, P::about, []() -> std::unique_ptr<Plugin> { return std::make_unique<P>(); }};
}

}  // namespace beadwork
