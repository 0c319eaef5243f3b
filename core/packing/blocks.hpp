#pragma once
// Sums over elements in fixed blocks, added in a fixed order: the same bits for any number of threads.

#include <algorithm>
#include <cstddef>

#include "core/base/parallel.hpp"
#include "core/base/pause.hpp"

namespace beadwork::packing {

/// Below so many elements a second thread saves less than it costs to wait for it.
constexpr std::size_t worth_sharing = 20000;

/// Calls `body(k)` for each k.
template <class Body>
void for_each(std::size_t count, const Body& body) {
  each_shared(count, body, worth_sharing + 1);
}

/// The same where each takes long: there is a pause every so many.
template <class Body>
void for_each(std::size_t count, const Body& body, const Pause& pause) {
  constexpr std::size_t stretch = 8192;
  for (std::size_t begin = 0; begin < count; begin += stretch) {
    pause();
    const std::size_t end = std::min(count, begin + stretch);
    each_shared(
        end - begin, [&](std::size_t k) { body(begin + k); }, count > worth_sharing ? 2 : stretch + 1);
  }
}

/// Calls `part(begin, end, sum)` on each block of the range, each with its own sum, and adds the sums in
/// order.
template <class Sum, class Part>
Sum sum_in_blocks(std::size_t count, const Part& part) {
  return sum_shared<Sum>(count, std::size_t{512}, part, worth_sharing + 1);
}

}  // namespace beadwork::packing
