#pragma once
// The parts of a surface of triangles that something can touch: its faces, edges and corners.

#include <array>
#include <span>
#include <vector>

#include "core/domain/facet.hpp"

namespace beadwork {

using Triangle = std::array<Vec3, 3>;

/// Sides on which something may stand. The front is where the corners of a triangle go round counterclockwise.
enum class Sides { both, front, back };

/// Corners of triangles are one where their coordinates are equal. Where two triangles lie in one plane there is no edge
/// between them, and triangles without an area are passed over. The facets stand in the order of the triangles, then
/// edges, then corners. With one side only, what stands behind a face does not touch it, however thin the body is. Throws
/// std::invalid_argument where three triangles share an edge, where two go round differently and their side counts, where
/// a coordinate is not finite, or where nothing is left.
std::vector<Facet> facets_of(std::span<const Triangle> triangles, Sides sides = Sides::both);

}  // namespace beadwork
