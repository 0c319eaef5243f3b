#pragma once
// Pairs of elements that reach over a third one.

#include <span>
#include <vector>

#include "core/base/pause.hpp"
#include "core/base/types.hpp"
#include "core/domain/neighbours.hpp"

namespace beadwork {

/// For each pair (sorted by i, j) the element that lies between its two: paired with both, its centre nearer to the
/// line that joins them than half of its radius. -1 where none does. What is left without such pairs holds together
/// where all did: each of them leaves behind two that are shorter.
std::vector<Index> elements_between(std::span<const Vec3> position, std::span<const Real> radius,
                                    std::span<const Pair> pairs, const Pause& pause = never_paused);

}  // namespace beadwork
