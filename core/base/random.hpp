#pragma once
// Random numbers whose bits are the same on every machine: the distributions of the standard library are not.

#include <cstdint>
#include <random>
#include <string_view>

namespace beadwork {

/// Mersenne twister (std::mt19937_64, fixed by the standard) started from a seed and a stream; streams of one
/// seed are independent, so that each user of randomness takes one of its own and none disturbs another.
class Random {
 public:
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0);

  std::uint64_t bits() { return engine_(); }
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }  ///< in [0, 1), 53 bits
  double uniform(double from, double to) { return from + (to - from) * uniform(); }
  double normal();  ///< mean 0, deviation 1 (Marsaglia's polar method)

 private:
  std::mt19937_64 engine_;
  double spare_ = 0;
  bool has_spare_ = false;
};

/// A stream of its own for each name (Fowler, Noll and Vo).
std::uint64_t stream_of(std::string_view name);

}  // namespace beadwork
