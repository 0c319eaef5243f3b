#pragma once
// Which elements hang together by bonds.

#include <cstdint>
#include <span>
#include <vector>

#include "core/domain/domain.hpp"

namespace beadwork {

/// For each element the lowest row of the body that it belongs to: itself where no bond holds it. Bonds of `tables`
/// count, as they stood after step `when` (the break log tells which have broken since).
std::vector<Index> bodies(const Domain& domain, std::span<const BondTable* const> tables, std::int64_t when);

/// The members of a set that are no debris: single elements, and bodies of less than a hundredth of the elements of the
/// largest body that the set touches. The whole set if no bond holds any of them.
Set without_debris(const Set& set, const std::vector<Index>& body);

}  // namespace beadwork
