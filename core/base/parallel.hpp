#pragma once
// Loops that the threads share.

#include <omp.h>

#include "core/base/types.hpp"

namespace beadwork {

/// f(0) ... f(count - 1), each by some thread; by this one alone where there are less than `fewest`. Even a region of one
/// thread costs some hundred nanoseconds and a call of the kernel: as much as a whole step of a small scene.
template <class F>
void each_shared(Index count, const F& f, Index fewest = 2) {
  if (count < fewest || omp_get_max_threads() == 1) {
    for (Index k = 0; k < count; ++k) f(k);
    return;
  }
#pragma omp parallel for schedule(static)
  for (Index k = 0; k < count; ++k) f(k);
}

/// Whether f(k) holds for any k from 0 to count - 1.
template <class F>
bool any_shared(Index count, const F& f, Index fewest = 2) {
  bool found = false;
  each_shared(
      count,
      [&](Index k) {
        if (!f(k)) return;
#pragma omp atomic write
        found = true;
      },
      fewest);
  return found;
}

}  // namespace beadwork
