#pragma once
// How walls are shown in frames: by lines where they stand.

#include <array>
#include <vector>

#include "core/domain/domain.hpp"

namespace beadwork {

using Line = std::array<Vec3, 2>;

/// Lines along rims, edges and equators of all walls, in the world [m]; a plane, which has no end, by a square about where
/// the elements are.
std::vector<Line> wall_outlines(const Domain& domain);

}  // namespace beadwork
