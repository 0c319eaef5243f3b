#pragma once
// The texts that a run leaves for programs: summary.json, and what each curve is.

#include <string>

#include "core/loop/run.hpp"

namespace beadwork {

std::string summary_json(const Scene& scene, const RunFigures& figures, const FreeMotions& free, const Moment& moment, int threads, const Sight& sight);
std::string curve_json(const CurvePlan& plan);

/// A run goes on only with the deck that began it. Lines that say when to end, how often to look, or that only name the
/// scene may differ; else DeckFailure with the lines that differ.
void refuse_other_deck(const std::string& saved, const std::string& now);

}  // namespace beadwork
