#pragma once
// Points spread evenly over the unit cube, for volumes by counting.

#include <cstdint>

#include "core/base/types.hpp"

namespace beadwork::packing {

/// The k-th number of van der Corput's sequence in a base: its digits mirrored at the point.
inline Real radical_inverse(std::uint64_t k, unsigned base) {
  Real value = 0;
  for (Real digit = 1.0 / base; k > 0; k /= base, digit /= base) value += Real(k % base) * digit;
  return value;
}

/// The k-th point of Halton's sequence.
inline Vec3 even_point(std::uint64_t k) {
  return {radical_inverse(k + 1, 2), radical_inverse(k + 1, 3), radical_inverse(k + 1, 5)};
}

}  // namespace beadwork::packing
