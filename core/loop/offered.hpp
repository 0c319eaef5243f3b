#pragma once
// What bond laws and criteria offer of each bond: axial force, moments, opening, utilisation. It is found for the steps
// in which somebody reads it, and is then that of the present state. A bond that is broken has nothing, nor has one
// whose law or criterion does not stand in the stage.

#include <map>
#include <set>
#include <vector>

#include "core/loop/scene.hpp"
#include "core/loop/verdict.hpp"

namespace beadwork {

class Offered {
 public:
  explicit Offered(const Scene& scene);

  bool is_read_by(const Plugin& reader) const { return scene_.section_readers.contains(&reader); }
  bool is_read() const { return !scene_.section_readers.empty(); }

  /// A stage begins, perhaps with other laws and criteria.
  void begin_stage();
  /// The state has changed: nothing is told of the new one.
  void begin_step();
  /// The laws have told what they offer, with the forces or without them.
  void note_told() { told_ = true; }
  bool is_told() const { return told_; }
  /// Has a criterion judge. Where several of one scene judge the same bonds, those who read see the largest utilisation.
  Verdict judge(Failure& failure, Domain& domain);
  bool is_judged(const Failure& failure) const { return judged_.contains(&failure); }
  /// A bond has broken.
  void clear(const BondTable& table, Index row) const;
  /// Bonds have broken: sums that are read have to be found without them.
  void note_broken();

 private:
  void clear(Column& column, Index begin, Index end) const;
  const std::vector<char>& held_for(const Failure& failure, const Domain& domain);

  const Scene& scene_;
  std::map<const BondTable*, std::vector<Column*>> columns_;
  bool told_ = false;
  /// By criterion that judges elements: whether a bond that may break holds the element.
  std::map<const Failure*, std::vector<char>> held_;
  std::set<const Failure*> judged_;
  std::set<const Column*> with_utilisation_;  ///< of which a criterion has told at this step
};

/// Keeps the sums of forces and torques as they are while this lives, whoever adds to them or clears them.
class LoadsAside {
 public:
  explicit LoadsAside(Domain& domain);
  LoadsAside(const LoadsAside&) = delete;
  LoadsAside& operator=(const LoadsAside&) = delete;
  ~LoadsAside();

 private:
  struct Kept {
    View<Vec3> view;
    std::vector<Vec3> sums;
  };
  std::vector<Kept> kept_;
};

}  // namespace beadwork
