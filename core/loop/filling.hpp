#pragma once
// Before the first step: elements and sets are made, and what they alone tell of later stages is told now, not after
// hours.

#include "core/loop/run_options.hpp"
#include "core/loop/run_state.hpp"

namespace beadwork {

/// Throws Interrupted if the user wants to stop before the first step, when there is nothing to save yet.
void pause_before_first_step(const RunOptions& options);

/// Fills the domain; reports on packings, JSON objects, are added to `reports`. Throws DeckFailure where there are no
/// elements then, or two loads prescribe one motion.
void fill(RunState& state, const RunOptions& options, std::vector<std::string>& reports);

}  // namespace beadwork
