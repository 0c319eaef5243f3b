#pragma once
// What the parts of a scene tell without a run of it.

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/log.hpp"
#include "core/loop/load.hpp"
#include "core/loop/run_options.hpp"
#include "workbench/law/pair.hpp"

namespace beadwork::law {

/// The stiffness that the law states at rest for a motion: its own closed form, such as E A / L of a beam.
Real stated_stiffness(const DeckRequest& deck, const Family& family, const Mode& mode);

/// Mean radii over the two sets of each family: as the fillings of the deck have them, where all give the one radius, or of
/// the elements that they make, which is said to the log. DeckFailure where a set has none.
std::vector<Pair> pairs_of(const Loaded& loaded, const std::vector<Family>& families, const RunOptions& filling,
                           const Log& log);

}  // namespace beadwork::law
