#pragma once
// Finds the forces of the laws that act and of the loads that push.

#include "core/loop/offered.hpp"
#include "core/loop/run_state.hpp"

namespace beadwork {

class Forces {
 public:
  Forces(RunState& state, Offered& offered) : state_(state), offered_(offered) {}

  /// Sums of all forces and torques on the elements; `settle`: the laws note what they keep; `offering`: they tell on
  /// the way what they offer of each bond.
  void evaluate(bool settle, bool offering);
  /// Has the laws tell what they offer of each bond in the present state; forces and what is kept stay as they are.
  void offer();

 private:
  void act(Evaluation how);

  RunState& state_;
  Offered& offered_;
};

}  // namespace beadwork
