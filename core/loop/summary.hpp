#pragma once
// The texts that a run leaves for programs: summary.json, and what each curve is.

#include <string>

#include "core/loop/run.hpp"
#include "core/loop/same_deck.hpp"

namespace beadwork {

std::string summary_json(const Scene& scene, const FileSums& files, const RunFigures& figures, const FreeMotions& free, const Moment& moment, int threads, const Sight& sight);
std::string curve_json(const CurvePlan& plan);

}  // namespace beadwork
