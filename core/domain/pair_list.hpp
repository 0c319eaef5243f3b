#pragma once
// Pairs of elements that a filling plugin lists as neighbours: along a fibre whose elements overlap, distance alone
// cannot tell.

#include <span>
#include <utility>
#include <vector>

#include "core/base/types.hpp"

namespace beadwork {

/// Rows of the element table, first < second, ascending.
using PairList = std::vector<std::pair<Index, Index>>;

/// The same pairs where what stood in row k has gone to row_of[k].
void rename_rows(PairList& pairs, std::span<const Index> row_of);

class Domain;

/// For each element the number of the chain that listed pairs join it to, -1 where it stands in no pair; empty where
/// there are no lists.
std::vector<Index> chains(const Domain& domain);

}  // namespace beadwork
