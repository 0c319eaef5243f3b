#pragma once
// Makes a scene of a deck: first the plugins, then the names that they give one another, then the columns.

#include <map>
#include <set>

#include "core/deck/write.hpp"
#include "core/loop/scene.hpp"

namespace beadwork {

class Assembly {
 public:
  Assembly(const Deck& deck, const Catalogue& catalogue, Complaints& complaints, Scene& scene)
      : deck_(deck), catalogue_(catalogue), complaints_(complaints), scene_(scene) {}
  void run();

 private:
  // plugins of the deck (assembly.cpp)
  void read_root();
  void read_sections(const Node& parent, Stage& stage, bool inside_stage);
  void read_section(Kind kind, const Node& section, Stage& stage);
  std::unique_ptr<Plugin> make(Kind kind, const std::string& tag, const Location& at);
  void complain_of_tag(Kind kind, const Node& node);
  void note_unread(const Node& node);
  bool is_read(Kind kind) const;
  void enlist(Plugin& plugin, Stage& stage);
  void check_study();
  void merge_common_into_stages();
  void check_stage(Stage& stage);
  void check_watchers();
  std::vector<Constraint> constraints_seen_by(const Watcher& watcher) const;
  void compile_until(Stage& stage);
  std::string why_untold(const Stage& stage, const std::string& name) const;
  void check_awaited();
  void compile_marks(Stage& stage);
  void note_prospect(const std::string& attribute, const Location& at, const std::string& why_never);
  void complain_of_hopeless();

  // walls (assembly_walls.cpp)
  void note_walls();
  std::map<std::string, const Filler*> makers_of_sets();
  void warn_of_idle_loads(const std::map<std::string, const Filler*>& makers);
  bool may_turn(const std::string& set, const Filler& maker) const;

  // the deck as it was understood (assembly_resolved.cpp)
  void resolve();
  void resolve_sections(const Node& parent, PlainNode& plain, std::size_t& plugins, std::size_t& stages);
  PlainNode resolved(const Plugin& plugin);
  std::string resolved(const Plugin& plugin, const ParamBase& param);

  // names (assembly_names.cpp)
  void check_names();
  void check_order_of_regions();
  void check_curve_names();
  void check_derived();
  void check_judged();
  void check_flawed();
  void check_neighbours();
  void check_name(const ParamBase& param, const std::string& name);
  std::vector<const Watcher*> watchers() const;
  void check_files();
  void check_uses_of(Role role, const std::string& what, const std::set<std::string>& known);
  std::set<std::string> made_names(Role role, const std::string& what);

  // columns (assembly_fields.cpp)
  void lay_out_fields();
  void choose_rotations();
  void add_families();
  void begin_lines();
  void add_provided();
  void meet_readers();
  void add_columns(const Plugin& plugin, const FieldUse& use);
  void meet_uses(const Plugin& reader);
  bool meet(const Plugin& reader, const FieldUse& use, std::size_t family);
  void complain_of_missing(const Plugin& reader, On on, const std::string& family,
                           const std::vector<std::string>& names);
  void meet_names(const Plugin& reader, const ParamBase& fields);
  void provide_all(const Plugin& reader);
  bool can_derive(const std::string& name) const;
  bool provide(On on, const std::string& name, const std::string& family);
  bool derive(const std::string& name, const Plugin& reader);
  Derived& made_to_derive(const std::string& name, const Plugin& reader);
  bool reads_sums(const Derived& derived) const;
  void note_sums();
  void warn_of_idle();
  std::vector<std::string> providable(On on, const std::string& family) const;

  const Deck& deck_;
  const Catalogue& catalogue_;
  Complaints& complaints_;
  Scene& scene_;
  Stage common_;
  std::map<std::string, const Node*> until_nodes_;
  struct Hope {
    Location at;
    std::string why_never;
    bool comes = false;  ///< in one of the stages in which it stands
  };
  std::map<std::string, Hope> hopes_;     ///< what 'until' and 'at' wait for, by place
  std::vector<Until::Prospect> endless_;  ///< of stages that would never end
  std::map<std::string, int> counts_;
  // One mistake, one message: what follows only from a tag, an attribute or a value that could not be read is not told
  // too.
  std::set<Kind> unread_kinds_;         ///< sections in which something could not be read
  std::set<std::string> unread_names_;  ///< words of what could not be read: may name sets and families
};

}  // namespace beadwork
