#pragma once
// Plugins, domain and schedule of one deck, checked against one another and ready to run.

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/deck/deck.hpp"
#include "core/deck/write.hpp"
#include "core/domain/domain.hpp"
#include "core/loop/until.hpp"
#include "core/plugin/catalogue.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork {

/// What holds during one stage of a run. A deck without stages has one.
struct Stage {
  std::string name;
  Location at;
  std::vector<BondLaw*> laws;
  std::vector<ContactLaw*> contacts;
  std::vector<Load*> loads;
  std::vector<const Filler*> fillers;  ///< of the scene: some hold what they make
  std::vector<Mover*> movers;          ///< exactly one, once checked
  std::vector<Failure*> failures;
  std::vector<Watcher*> watchers;
  std::vector<std::vector<Mark>> marks;  ///< moments at which each watcher looks beside its cadence
  std::optional<Until> until;

  Mover& mover() const { return *movers.front(); }
  /// Of all its loads, in the deck's order, and of what holds itself where these do not.
  std::vector<Constraint> constraints() const;
  bool watched_by(const Watcher& watcher) const;
  /// Which of its watchers tells a number under this name.
  std::optional<std::size_t> gauge_named(const std::string& curve) const;
  /// All its plugins, laws first.
  std::vector<const Plugin*> plugins() const;
};

class Scene {
 public:
  /// Makes the plugins of the deck and checks them. What is wrong with the deck goes to `complaints`; nothing is
  /// returned if there are errors.
  static std::unique_ptr<Scene> assemble(const Deck& deck, const Catalogue& catalogue, Complaints& complaints);

  std::string name;
  std::uint64_t seed = 0;
  std::string deck_path, deck_text, deck_sha256;
  std::vector<Override> overrides;
  /// The deck with every value in SI, every fallback written out, and paths absolute: it stands for itself, and each
  /// node and attribute of the tree knows its place in the deck.
  std::string resolved;
  PlainNode resolved_tree;

  std::vector<std::unique_ptr<Plugin>> plugins;
  std::vector<Filler*> fillers;
  std::vector<Derived*> derived;
  std::vector<Study*> studies;  ///< with these there is nothing else: no stages, nothing to run
  std::vector<Stage> stages;
  std::set<std::string> libraries;          ///< of the plugins in use, those that a deck has to name
  std::vector<std::string> families;        ///< names, in the order of their tables
  std::unique_ptr<Domain> domain;           ///< with every column that the plugins ask for, and no rows yet
  std::set<const PairLaw*> summing;         ///< laws whose forces count in the sums that somebody reads
  std::set<const Plugin*> section_readers;  ///< plugins that read what bond laws offer of each bond
  std::map<const Derived*, std::set<const Plugin*>> derived_for;  ///< who reads a derived field, through others too

  /// Points the views of all plugins at the columns of the domain: whenever these may have moved.
  void bind() const;
  bool has_contacts() const;
  /// The number of the stage in which a plugin first stands.
  std::size_t first_stage(const Plugin& plugin) const;
  /// Paths of the files on which a run depends beside the deck: of data, and plugin libraries that are not the
  /// program's own.
  std::vector<std::string> files() const;
  const std::set<const Plugin*>& readers_of(const Derived& provider) const { return derived_for.at(&provider); }
};

}  // namespace beadwork
