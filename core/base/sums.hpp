#pragma once
// Sums in a fixed order: blocks of a fixed length, then the blocks in order. The bits do not depend on the threads.

#include <algorithm>
#include <vector>

#include "core/base/parallel.hpp"
#include "core/base/types.hpp"

namespace beadwork {

/// Sum of block(0) ... block(blocks - 1), in this order, whichever thread finds each.
template <class Block>
Real sum_of_blocks(Index blocks, const Block& block) {
  if (blocks == 1) return Real(0) + block(0);  // as the sum of one part: never -0
  std::vector<Real> part(static_cast<std::size_t>(blocks), 0);
  each_shared(blocks, [&](Index b) { part[static_cast<std::size_t>(b)] = block(b); });
  Real total = 0;
  for (const Real p : part) total += p;
  return total;
}

/// Sum of f(0) ... f(count - 1).
template <class F>
Real fixed_sum(Index count, const F& f) {
  constexpr Index length = 1024;
  return sum_of_blocks((count + length - 1) / length, [&](Index b) {
    Real total = 0;
    const Index end = std::min<Index>(count, (b + 1) * length);
    for (Index k = b * length; k < end; ++k) total += f(k);
    return total;
  });
}

}  // namespace beadwork
