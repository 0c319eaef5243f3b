#pragma once
// Which elements a family bonds.

#include "core/plugin/kinds.hpp"

namespace beadwork {

/// Pairs of elements between the law's two sets whose surfaces are within its gap, without those the law refuses.
/// Throws DeckFailure if there is none.
std::vector<std::pair<Index, Index>> pairs_to_bond(const BondLaw& law, const Domain& domain);

}  // namespace beadwork
