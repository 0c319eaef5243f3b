#pragma once
// Which elements are near each other. Elements are sorted into cells of about their own size, one grid for
// each doubling of the radius, so that a fibre of large elements among small ones does not make the cells
// large.

#include <span>
#include <vector>

#include "core/base/pause.hpp"
#include "core/base/types.hpp"

namespace beadwork {

struct Pair {
  Index i;  ///< always smaller than j
  Index j;
  friend bool operator==(const Pair&, const Pair&) = default;
};

/// All pairs with |x_j - x_i| <= (1 + tolerance) (R_i + R_j) + gap, sorted by (i, j); the same list for any
/// number of threads. Throws std::invalid_argument that names the first element whose position or radius is
/// not finite, or whose radius is negative; or if there are too many pairs to be held (`most_pairs`), before they are
/// looked for.
std::vector<Pair> find_pairs(std::span<const Vec3> position, std::span<const Real> radius, Real tolerance = 0,
                             Real gap = 0, const Pause& pause = never_paused);

/// Elements that share cells in so many pairs have at least about as many that are near: gigabytes of them.
inline constexpr Real most_pairs = 5e8;

/// The same, without the pairs of two elements that both stand at `moving` or behind: obstacles, which may
/// overlap.
std::vector<Pair> find_pairs_around(std::span<const Vec3> position, std::span<const Real> radius, std::size_t moving,
                                    Real tolerance = 0, Real gap = 0, const Pause& pause = never_paused);

/// The neighbours of each element, both ways: those of element i are other[first[i]] ... other[first[i + 1] -
/// 1], in rising order.
struct NeighbourList {
  std::vector<std::size_t> first;
  std::vector<Index> other;

  std::span<const Index> of(std::size_t i) const { return {other.data() + first[i], first[i + 1] - first[i]}; }
};
NeighbourList neighbours_of(std::span<const Pair> pairs, std::size_t elements);

}  // namespace beadwork
