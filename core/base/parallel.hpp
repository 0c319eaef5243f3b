#pragma once
// Loops that the threads share. All threads of Beadwork work here and nowhere else, so what is decided here of how they
// wait for one another holds everywhere (docs/decisions/threads-that-wait.md).

#include <atomic>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/types.hpp"

namespace beadwork {

/// From now on loops are shared by so many threads, at least one. Not to be called from within a loop.
void use_threads(int count);
/// So many threads share a loop: what use_threads() was told, or else allowed_processors().
int threads_in_use();
/// True within a loop that is shared. A loop inside of it is left to the thread that meets it.
bool in_shared_loop();

namespace parallel {
/// `piece(loop, begin, end)` on pieces that together are 0 ... count - 1, each once, by some thread. Returns when all
/// are done. What a piece throws is thrown again, of several pieces what the first of them threw: as without threads.
void share(std::int64_t count, void (*piece)(const void* loop, std::int64_t begin, std::int64_t end), const void* loop);
}  // namespace parallel

/// f(0) ... f(count - 1), each by some thread; by this one alone where there are less than `fewest`. To share costs
/// some hundred nanoseconds: as much as a whole step of a small scene.
template <class Count, class F>
void each_shared(Count count, const F& f, std::type_identity_t<Count> fewest = 2) {
  if (count < fewest || threads_in_use() == 1) {
    for (Count k = 0; k < count; ++k) f(k);
    return;
  }
  parallel::share(
      static_cast<std::int64_t>(count),
      [](const void* loop, std::int64_t begin, std::int64_t end) {
        const F& each = *static_cast<const F*>(loop);
        const auto last = static_cast<Count>(end);
        for (auto k = static_cast<Count>(begin); k < last; ++k) each(k);
      },
      &f);
}

/// Whether f(k) holds for any k from 0 to count - 1.
template <class Count, class F>
bool any_shared(Count count, const F& f, std::type_identity_t<Count> fewest = 2) {
  std::atomic<bool> found{false};
  each_shared(
      count,
      [&](Count k) {
        if (f(k)) found.store(true, std::memory_order_relaxed);
      },
      fewest);
  return found;
}

/// `f(begin, end, sum)` on blocks of 0 ... count - 1, each block with a sum of its own, which are then added in their
/// order: the bits do not depend on the threads.
template <class Sum, class Count, class F>
Sum sum_shared(Count count, Count block, const F& f, std::type_identity_t<Count> fewest = 2) {
  const Count blocks = (count + block - 1) / block;
  std::vector<Sum> sums(static_cast<std::size_t>(blocks));
  each_shared(
      blocks,
      [&](Count b) {
        Sum sum{};
        f(b * block, (b + 1) * block < count ? (b + 1) * block : count, sum);
        sums[static_cast<std::size_t>(b)] = std::move(sum);
      },
      (fewest + block - 1) / block);
  Sum total{};
  for (const Sum& sum : sums) total += sum;
  return total;
}

}  // namespace beadwork
