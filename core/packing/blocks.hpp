#pragma once
// Sums over elements in fixed blocks, added in a fixed order: the same bits for any number of threads.

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/base/pause.hpp"

namespace beadwork::packing {

/// Below so many elements a second thread saves less than it costs to wait for it.
constexpr std::size_t worth_sharing = 20000;

/// Calls `body(k)` for each k.
template <class Body>
void for_each(std::size_t count, const Body& body) {
#pragma omp parallel for schedule(static) if (count > worth_sharing)
  for (std::size_t k = 0; k < count; ++k) body(k);
}

/// The same where each takes long: there is a pause every so many.
template <class Body>
void for_each(std::size_t count, const Body& body, const Pause& pause) {
  constexpr std::size_t stretch = 8192;
  for (std::size_t begin = 0; begin < count; begin += stretch) {
    pause();
    const std::size_t end = std::min(count, begin + stretch);
#pragma omp parallel for schedule(static) if (count > worth_sharing)
    for (std::size_t k = begin; k < end; ++k) body(k);
  }
}

/// Calls `part(begin, end, sum)` on each block of the range, each with its own sum, and adds the sums in
/// order.
template <class Sum, class Part>
Sum sum_in_blocks(std::size_t count, const Part& part) {
  constexpr std::size_t block = 512;
  const std::size_t blocks = (count + block - 1) / block;
  std::vector<Sum> sums(blocks);
#pragma omp parallel for schedule(static) if (count > worth_sharing)
  for (std::size_t b = 0; b < blocks; ++b) {
    Sum sum{};
    part(b * block, std::min(count, (b + 1) * block), sum);
    sums[b] = std::move(sum);
  }
  Sum total{};
  for (const Sum& sum : sums) total += sum;
  return total;
}

}  // namespace beadwork::packing
