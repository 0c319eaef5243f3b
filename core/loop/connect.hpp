#pragma once
// Which elements a family bonds.

#include <functional>
#include <string>

#include "core/base/pause.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork {

/// Whether any pair of elements between the law's two sets is near enough to be bonded.
bool has_pairs(const BondLaw& law, const Domain& domain, const Pause& pause);

/// Pairs of elements between the law's two sets whose surfaces are within its gap, without those the law refuses; where
/// it bonds the next only, without those that reach over a third element, which are warned of elsewhere. Throws
/// DeckFailure if there is none, or more than can be held.
std::vector<std::pair<Index, Index>> pairs_to_bond(const BondLaw& law, const Domain& domain, const Pause& pause,
                                                   const Log& log);

/// Pairs of elements between the law's two sets, or of elements and facets of walls, whose surfaces are within `skin` [m],
/// sorted.
std::vector<Near> pairs_in_reach(const ContactLaw& law, const Domain& domain, Real skin);

}  // namespace beadwork
