#pragma once
// Sums in a fixed order: blocks of a fixed length, then the blocks in order. The bits do not depend on the threads.

#include <algorithm>
#include <vector>

#include "core/base/types.hpp"

namespace beadwork {

/// Sum of block(0) ... block(blocks - 1), in this order, whichever thread finds each.
template <class Block>
Real sum_of_blocks(Index blocks, const Block& block) {
  std::vector<Real> part(static_cast<std::size_t>(blocks), 0);
#pragma omp parallel for schedule(static) if (blocks > 1)
  for (Index b = 0; b < blocks; ++b) part[static_cast<std::size_t>(b)] = block(b);
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
