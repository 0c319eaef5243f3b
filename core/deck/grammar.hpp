#pragma once
// The grammar of expressions: muParser's, with our operators and functions. The only place that knows
// muParser.

#include <vector>

#include "core/deck/recorder.hpp"

namespace beadwork {

/// Parses the tokens and records the steps. `handles` holds, for each token that is a value, its step in the
/// recorder, else -1. Returns the step of the result. Throws ExpressionMistake.
int record(const std::vector<Token>& tokens, const std::vector<int>& handles, std::size_t text_length,
           StepRecorder& recorder);

}  // namespace beadwork
