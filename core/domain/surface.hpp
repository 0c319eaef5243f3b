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

/// Corners of triangles are one within a millionth of the extent of all. Where two triangles lie in one plane there is no edge
/// between them, and triangles without an area are passed over. The facets stand in the order of the triangles, then
/// edges, then corners. With one side only, what stands behind a face does not touch it, however thin the body is. In a
/// valley of less than 20 degrees a place belongs to the nearer face alone, so that round hollows have one contact.
///
/// Throws std::invalid_argument where three triangles share an edge, where a corner lies on the edge of a triangle that it is
/// no corner of, where a coordinate is not finite, where nothing is left; and, where one side counts, of a surface that is
/// not closed, whose triangles go round differently, or clockwise seen from outside.
std::vector<Facet> facets_of(std::span<const Triangle> triangles, Sides sides = Sides::both);

/// Whether each edge has two triangles.
bool is_closed(std::span<const Triangle> triangles);

}  // namespace beadwork
