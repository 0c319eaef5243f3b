#pragma once
// What happens where a stage begins: its families are bonded, its constraints count from now on, its loads start.

#include "core/loop/run_options.hpp"
#include "core/loop/run_state.hpp"

namespace beadwork {

/// Rows for the families that first stand in this stage. Throws DeckFailure for one that bonds nothing, or more than
/// can be numbered.
void create_families(RunState& state, const RunOptions& options);
/// The laws of the stage act from now on, with their bonds cut into chunks.
void let_laws_act(RunState& state);
/// The bonds just made find their rest state, and the loads of the stage start.
void connect(RunState& state, const Log& log);
/// Constraints of the stage count from its beginning; what stands outside of the stages goes on from one to the next.
void begin_constraints(RunState& state);

}  // namespace beadwork
