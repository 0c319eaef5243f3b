#pragma once
// The texts that a run leaves for programs: summary.json, and what each curve is.

#include <string>

#include "core/loop/record.hpp"

namespace beadwork {

std::string summary_json(const RunState& state, const Balance& balance, const FileSums& files,
                         const RunFigures& figures, int threads);
std::string curve_json(const CurvePlan& plan);

}  // namespace beadwork
