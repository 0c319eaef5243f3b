// What one and two threads of this processor can do at best, for docs/performance.md: multiplications and additions
// that wait for nothing, and streams through memory and through the cache.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

#include "core/base/pack.hpp"
#include "core/base/parallel.hpp"

namespace beadwork::speed {
namespace {

constexpr int W = pack_width;
constexpr int repetitions = 10;

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

// Eight chains of each kind hide the latency; the empty asm keeps the compiler from merging or dropping them.
void multiply_and_add(long times) {
  using N = Pack<W>::Native;
  N m[8], a[8];
  for (int k = 0; k < 8; ++k) m[k] = Pack<W>(1.0 + k).v, a[k] = Pack<W>(9.0 + k).v;
  const N by = Pack<W>(1.0000001).v;
  N m0 = m[0], m1 = m[1], m2 = m[2], m3 = m[3], m4 = m[4], m5 = m[5], m6 = m[6], m7 = m[7];
  N a0 = a[0], a1 = a[1], a2 = a[2], a3 = a[3], a4 = a[4], a5 = a[5], a6 = a[6], a7 = a[7];
  for (long n = 0; n < times; ++n) {
    m0 *= by, m1 *= by, m2 *= by, m3 *= by, m4 *= by, m5 *= by, m6 *= by, m7 *= by;
    a0 += by, a1 += by, a2 += by, a3 += by, a4 += by, a5 += by, a6 += by, a7 += by;
    asm volatile("" : "+v"(m0), "+v"(m1), "+v"(m2), "+v"(m3), "+v"(m4), "+v"(m5), "+v"(m6), "+v"(m7));
    asm volatile("" : "+v"(a0), "+v"(a1), "+v"(a2), "+v"(a3), "+v"(a4), "+v"(a5), "+v"(a6), "+v"(a7));
  }
}

double gigaflops(int threads) {
  constexpr long times = 5'000'000;
  double best = 0;
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    const double start = seconds();
    each_shared(16 * threads, [](int) { multiply_and_add(times / 16); });
    best = std::max(best, threads * 16. * W * times / (seconds() - start) / 1e9);
  }
  return best;
}

/// Bytes of a triad a = b + s c, the line of `a` being read before it is written.
double gigabytes(long megabytes) {
  const long count = megabytes * 1'000'000 / 24, rounds = 400 / megabytes;
  std::vector<double> a(static_cast<std::size_t>(count), 1), b(a), c(a);
  double *to = a.data(), *x = b.data(), *y = c.data();
  double best = 0;
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    const double start = seconds();
    for (long round = 0; round < rounds; ++round) {
      each_shared(count, [&](long n) { to[n] = x[n] + 0.5 * y[n]; });
    }
    best = std::max(best, 32. * static_cast<double>(rounds * count) / (seconds() - start) / 1e9);
  }
  return best;
}

}  // namespace
}  // namespace beadwork::speed

int main() {
  using namespace beadwork::speed;
  for (const int threads : {1, 2}) {
    use_threads(threads);
    std::printf("%d threads: %.1f Gflop/s; streams of 16 MB %.1f GB/s, of 400 MB %.1f GB/s\n", threads,
                gigaflops(threads), gigabytes(16), gigabytes(400));
  }
}
