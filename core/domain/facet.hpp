#pragma once
// Parts of rigid walls.

#include <array>

#include "core/domain/view.hpp"

namespace beadwork {

enum class FacetKind : Index {
  plane,     ///< through v0, normal v1
  disc,      ///< thin, about v0, normal v1, of radius `size`
  box,       ///< full, about v0, half edges v1
  cylinder,  ///< full, from v0 along v1, of radius `size` and of `length`
  barrel,    ///< the hollow side of such a cylinder, seen from within
  ball,      ///< full, about v0, of radius `size`
  bowl,      ///< a hollow ball seen from within
  face,      ///< a triangle v0 v1 v2; v3 v4 v5 point out of its edges v0 v1, v1 v2, v2 v0 in its plane; normal v6; `size` sides
  edge,      ///< from v0 to v1, the lesser first, along v4; v2 and v3 point out of the faces at it, 0 where one is there
  corner,    ///< v0; v1 points to its front, 0 where both sides count; `size` edges leave along v2 ... v6, and on behind
  more,      ///< what a corner has no room for
};

/// In the frame of its wall.
struct Facet {
  FacetKind kind;
  std::array<Vec3, 7> v;
  Real size = 0, length = 0;  ///< [m]
};

/// Facets as columns.
struct FacetViews {
  View<const Index> kind;
  std::array<View<const Vec3>, 7> v;
  View<const Real> size, length;
};

}  // namespace beadwork
