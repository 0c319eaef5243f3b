#pragma once
// A plugin is its parameters, the fields that it touches, and the one or two functions of its kind (kinds.hpp).

#include <memory>
#include <string>
#include <vector>

#include "core/plugin/param.hpp"
#include "core/plugin/use.hpp"

namespace beadwork {

enum class Kind { fill, bond, load, move, fail, derive, watch };
inline constexpr Kind all_kinds[] = {Kind::fill, Kind::bond,   Kind::load, Kind::move,
                                     Kind::fail, Kind::derive, Kind::watch};
const char* kind_name(Kind kind);  ///< the section of the deck and the folder of the sources

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
  /// Name under which a use's field stands in its table.
  std::string column_name(const FieldUse& use) const;

  /// Relations between parameters, e.g. u_p > u_e.
  virtual void check(Complaints&) const {}
  /// Drops the uses that the deck's choices make needless.
  virtual void choose() {}
  /// The family on whose table the fields "on bonds" live.
  virtual std::string family() const { return ""; }
  /// Adds what the plugin knows of the energy balance.
  virtual void energy(EnergySink&) const {}

 protected:
  Plugin() = default;

 private:
  void check_groups(Complaints& complaints) const;
  friend class ParamBase;
  friend class FieldUse;
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

template <class P>
PluginEntry entry(const char* tag) {
  return {P::kind, tag, P::about, []() -> std::unique_ptr<Plugin> { return std::make_unique<P>(); }};
}

}  // namespace beadwork
