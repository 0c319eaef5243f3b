#include "core/domain/order.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

#include "core/base/parallel.hpp"

namespace beadwork {
namespace {

constexpr int bits_per_axis = 21;

/// Skilling's transform (AIP Conf. Proc. 707, 381, 2004): cell coordinates to the transposed Hilbert index,
/// in place.
void to_hilbert(std::array<std::uint32_t, 3>& x) {
  for (std::uint32_t q = 1u << (bits_per_axis - 1); q > 1; q >>= 1) {
    const std::uint32_t p = q - 1;
    for (int a = 0; a < 3; ++a) {
      if (x[a] & q) {
        x[0] ^= p;
      } else {
        const std::uint32_t t = (x[0] ^ x[a]) & p;
        x[0] ^= t;
        x[a] ^= t;
      }
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t t = 0;
  for (std::uint32_t q = 1u << (bits_per_axis - 1); q > 1; q >>= 1)
    if (x[2] & q) t ^= q - 1;
  for (auto& v : x) v ^= t;
}

std::uint64_t hilbert_index(std::array<std::uint32_t, 3> cell) {
  to_hilbert(cell);
  std::uint64_t index = 0;
  for (int bit = bits_per_axis - 1; bit >= 0; --bit)
    for (int a = 0; a < 3; ++a) index = index << 1 | (cell[a] >> bit & 1u);
  return index;
}

}  // namespace

std::vector<Index> hilbert_order(std::span<const Vec3> position) {
  std::vector<Index> order(position.size());
  std::iota(order.begin(), order.end(), Index{0});
  if (position.empty()) return order;
  Vec3 low = position[0], high = position[0];
  for (std::size_t i = 0; i < position.size(); ++i) {
    if (!position[i].allFinite())
      throw std::invalid_argument("the position of element " + std::to_string(i) + " is not finite");
    low = low.cwiseMin(position[i]);
    high = high.cwiseMax(position[i]);
  }
  // One scale for the three axes: cells are cubes also in a long specimen.
  const Real extent = (high - low).maxCoeff();
  const Real top = Real((1u << bits_per_axis) - 1);
  const Real scale = extent > top / std::numeric_limits<Real>::max() ? top / extent : 0;
  std::vector<std::uint64_t> key(position.size());
  each_shared(position.size(), [&](std::size_t i) {
    std::array<std::uint32_t, 3> cell;
    for (int a = 0; a < 3; ++a)
      cell[a] = static_cast<std::uint32_t>(std::clamp((position[i][a] - low[a]) * scale, Real(0), top));
    key[i] = hilbert_index(cell);
  });
  std::sort(order.begin(), order.end(), [&](Index a, Index b) { return key[a] != key[b] ? key[a] < key[b] : a < b; });
  return order;
}

}  // namespace beadwork
