#pragma once
// Neighbours in space become neighbours in memory.

#include <span>
#include <vector>

#include "core/base/types.hpp"

namespace beadwork {

/// The order of the points along a Hilbert curve through their bounding box: result[k] is the index of the
/// k-th point on the curve. Points in one cell of the curve keep their order. Throws std::invalid_argument on
/// a position that is not finite.
std::vector<Index> hilbert_order(std::span<const Vec3> position);

}  // namespace beadwork
