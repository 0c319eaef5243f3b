#pragma once
// Parts of rigid walls.

#include <array>

#include "core/domain/view.hpp"

namespace beadwork {

enum class FacetKind : Index {
  plane,            ///< through v0, normal v1
  disc,             ///< thin, about v0, normal v1, of radius `size`
  box,              ///< full, about v0, half edges v1
  cylinder,         ///< full, from v0 along v1, of radius `size` and of `length`
  hollow_cylinder,  ///< a hollow without end about such an axis
  pipe,             ///< the thin mantle of such a cylinder
  sphere,           ///< full, about v0, of radius `size`
  hollow_sphere,    ///< a hollow
  /// Triangle v0 v1 v2 of `size` sides; v3 v4 v5 point out of its edges v0 v1, v1 v2, v2 v0 in its plane; normal v6. Where
  /// an edge is hardly bent v7 v8 v9 point out of it as well, across the plane that halves the angle.
  face,
  edge,    ///< from v0 to v1, the lesser first, along v4; v2 and v3 point out of the faces at it, 0 where one is there
  corner,  ///< v0; v1 points to its front, 0 where both sides count; `size` edges leave along v2 ... v6, and on behind
  more,    ///< what a corner has no room for
};

/// In the frame of its wall.
struct Facet {
  FacetKind kind;
  std::array<Vec3, 10> v;
  Real size = 0, length = 0;  ///< [m]

  static Facet of(FacetKind kind, const Vec3& v0, const Vec3& v1 = Vec3::Zero(), Real size = 0, Real length = 0) {
    Facet one{kind, {}, size, length};
    one.v.fill(Vec3::Zero());
    one.v[0] = v0;
    one.v[1] = v1;
    return one;
  }
};

/// Facets as columns; places [m] and directions in the frame of their wall.
struct FacetViews {
  View<const Index> kind;
  std::array<View<const Vec3>, 10> v;
  View<const Real> size, length;
};

}  // namespace beadwork
