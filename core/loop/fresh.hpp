#pragma once
// Brings up to date what a reader is about to see: velocities at the end of the step, derived fields, and what laws and
// criteria offer of each bond. What nobody reads is not found.

#include <set>

#include "core/loop/forces.hpp"

namespace beadwork {

class Fresh {
 public:
  Fresh(RunState& state, Offered& offered, Forces& forces, Workings& workings);

  /// A stage begins, perhaps with other laws and criteria.
  void begin_stage() { offered_.begin_stage(); }
  /// The state changes: what was offered of each bond is of an older one.
  void begin_step() { offered_.begin_step(); }
  /// Derived fields that were found are of an older state.
  void outdate() { derived_.clear(); }

  /// Velocities and spins stand for the end of the step.
  void complete();
  /// For a load or a criterion: derived fields that it reads, and velocities where it reads these.
  void for_criterion(const Plugin& reader);
  void for_account(const Load& load) { complete_for(load); }
  /// For a watcher: all that it reads.
  void for_watcher(const Watcher& watcher);
  /// For whoever records all that there is.
  void everything();
  /// The derived fields where all begins.
  void derive_all();
  Verdict judge(Failure& failure);

 private:
  bool reads_rates(const Plugin& plugin) const;
  void complete_for(const Plugin& reader);
  void derive_for(const Plugin& reader);
  void offer();

  RunState& state_;
  Offered& offered_;
  Forces& forces_;
  Workings& workings_;
  std::set<const Plugin*>
      rate_readers_;  ///< loads and criteria that read velocities or spins, by themselves or in derived fields
  std::set<const Derived*> derived_;  ///< fields that stand for the present state
};

}  // namespace beadwork
