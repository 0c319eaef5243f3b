#pragma once
// Where a part of a wall is nearest to a place. docs/theory/contact.md
//
// Faces, edges and corners of a surface of triangles share out the space around it: a place belongs to those parts alone
// that are nearest to it in their own neighbourhood. What decides is the side of a plane through an edge or a corner, and
// all parts at that edge or corner ask with the same numbers. So a place belongs to exactly one of them, also where it
// stands just above an edge: there it is moved aside in thought, always the same way.

#include <algorithm>
#include <cmath>

#include "core/domain/facet.hpp"
#include "core/mechanics/lane.hpp"

namespace beadwork {

/// Seen from a place: T may carry slopes, but is one number.
template <class T>
struct Nearest {
  Vec<T> normal;      ///< from the facet to the place
  T distance;         ///< negative inside what is full [m]
  bool meets = true;  ///< the place lies in the region (of Voronoi) of this facet
};

namespace facets {

inline constexpr Index edges_in_a_corner = 5;  ///< of each of its facets

template <class T>
Vec<T> as(const Vec3& v) {
  return {T(v[0]), T(v[1]), T(v[2])};
}

/// A point of the facet is known, and the place lies `away` from it.
template <class T>
Nearest<T> from_point(const Vec<T>& away, const Vec3& otherwise) {
  const T distance = sqrt(dot(away, away));
  if (!(distance > T(0))) return {as<T>(otherwise), T(0)};
  return {(T(1) / distance) * away, distance};
}

inline Vec3 any_across(const Vec3& axis) { return axis.unitOrthogonal(); }

/// Of the two ends of an edge, the one from which all parts at the edge count.
inline bool is_lesser(const Vec3& a, const Vec3& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

/// On the far side of the plane through the point from which the place lies `away`; on the plane itself by a rule.
template <class T>
bool beyond(const Vec<T>& away, const Vec3& out) {
  const T side = dot(away, as<T>(out));
  if (side > T(0) || side < T(0)) return side > T(0);
  constexpr Real aside[] = {0.6180339887498949, 0.4142135623730951,
                            0.7320508075688772};  // along no edge that one draws
  return aside[0] * out[0] + aside[1] * out[1] + aside[2] * out[2] > 0;
}

/// Of a solid of revolution: how far the place is beyond its side and its ends, both negative inside.
template <class T>
Nearest<T> of_full_cylinder(const Vec<T>& p, const Vec3& from, const Vec3& along, Real radius, Real length) {
  const Vec<T> n = as<T>(along), q = p - as<T>(from);
  const T z = dot(q, n);
  const Vec<T> across = q - z * n;
  const Nearest<T> out = from_point<T>(across, any_across(along));
  const bool low = z < T(0.5 * length);
  const Vec<T> end = low ? Vec<T>(-n) : n;
  const T side = out.distance - T(radius), beyond_end = low ? -z : z - T(length);
  if (!(side > T(0)) || !(beyond_end > T(0)))
    return side > beyond_end ? Nearest<T>{out.normal, side} : Nearest<T>{end, beyond_end};
  return from_point<T>(side * out.normal + beyond_end * end, along);
}

/// Thin, touched on both sides and at its rims.
template <class T>
Nearest<T> of_pipe(const Vec<T>& p, const Vec3& from, const Vec3& along, Real radius, Real length) {
  const Vec<T> n = as<T>(along), q = p - as<T>(from);
  const T z = dot(q, n);
  const Nearest<T> out = from_point<T>(q - z * n, any_across(along));
  const T beyond = z < T(0) ? z : z > T(length) ? z - T(length) : T(0);
  return from_point<T>((out.distance - T(radius)) * out.normal + beyond * n, any_across(along));
}

template <class T>
Nearest<T> of_full_box(const Vec<T>& p, const Vec3& centre, const Vec3& half) {
  const Vec<T> q = p - as<T>(centre);
  Vec<T> away;
  bool outside = false;
  int nearest = 0;
  std::array<T, 3> beyond;
  for (int c = 0; c < 3; ++c) {
    beyond[static_cast<std::size_t>(c)] = (q[c] < T(0) ? -q[c] : q[c]) - T(half[c]);
    const T over = beyond[static_cast<std::size_t>(c)];
    outside |= over > T(0);
    away[c] = over > T(0) ? (q[c] < T(0) ? -over : over) : T(0);
    if (over > beyond[static_cast<std::size_t>(nearest)]) nearest = c;
  }
  if (outside) return from_point<T>(away, Vec3::UnitX());
  Vec<T> normal(T(0), T(0), T(0));
  normal[nearest] = q[nearest] < T(0) ? T(-1) : T(1);
  return {normal, beyond[static_cast<std::size_t>(nearest)]};
}

template <class T>
Nearest<T> of_disc(const Vec<T>& p, const Vec3& centre, const Vec3& normal, Real radius) {
  const Vec<T> n = as<T>(normal), q = p - as<T>(centre);
  const T height = dot(q, n);
  const Vec<T> across = q - height * n;
  const Nearest<T> out = from_point<T>(across, any_across(normal));
  if (out.distance > T(radius)) return from_point<T>(q - T(radius) * out.normal, normal);
  return height < T(0) ? Nearest<T>{Vec<T>(-n), -height} : Nearest<T>{n, height};
}

template <class T>
Nearest<T> of_face(const Vec<T>& p, const FacetViews& f, Index k) {
  const Vec3 normal = f.v[6][k];
  const T height = dot(p - as<T>(f.v[0][k]), as<T>(normal));
  Nearest<T> found{as<T>(height < T(0) ? Vec3(-normal) : normal), height < T(0) ? -height : height};
  found.meets = f.size[k] == 2 || !(height < T(0));
  for (std::size_t e = 0; e < 3; ++e) {
    const Vec3 one = f.v[e][k], other = f.v[(e + 1) % 3][k], bisector = f.v[7 + e][k];
    const bool in_valley = !bisector.isZero() && (height < T(0)) == (bisector.dot(normal) < 0);
    found.meets &=
        !beyond<T>(p - as<T>(is_lesser(one, other) ? one : other), in_valley ? bisector : Vec3(f.v[3 + e][k]));
  }
  return found;
}

template <class T>
Nearest<T> of_edge(const Vec<T>& p, const FacetViews& f, Index k) {
  const Vec3 along = f.v[4][k], out1 = f.v[2][k], out2 = f.v[3][k];
  const Vec<T> q = p - as<T>(f.v[0][k]);
  Nearest<T> found = from_point<T>(q - dot(q, as<T>(along)) * as<T>(along), out1);
  found.meets = beyond<T>(q, along) && beyond<T>(p - as<T>(f.v[1][k]), -along) && beyond<T>(q, out1) &&
                (out2.isZero() || beyond<T>(q, out2));
  return found;
}

template <class T>
Nearest<T> of_corner(const Vec<T>& p, const FacetViews& f, Index k) {
  const Vec<T> q = p - as<T>(f.v[0][k]);
  Nearest<T> found = from_point<T>(q, -Vec3(f.v[2][k]));
  found.meets = !(dot(q, as<T>(f.v[1][k])) < T(0));
  const auto count = static_cast<Index>(f.size[k]);
  for (Index n = 0; n < count; ++n)
    found.meets &= !beyond<T>(q, f.v[static_cast<std::size_t>(2 + n % edges_in_a_corner)][k + n / edges_in_a_corner]);
  return found;
}

}  // namespace facets

/// Of facet k, to the place p in the frame of the wall.
template <class T>
Nearest<T> nearest(const FacetViews& f, Index k, const Vec<T>& p) {
  using namespace facets;
  const Vec3 a = f.v[0][k], b = f.v[1][k];
  const Real size = f.size[k];
  switch (static_cast<FacetKind>(f.kind[k])) {
    case FacetKind::plane: return {as<T>(b), dot(p - as<T>(a), as<T>(b))};
    case FacetKind::disc: return of_disc<T>(p, a, b, size);
    case FacetKind::box: return of_full_box<T>(p, a, b);
    case FacetKind::cylinder: return of_full_cylinder<T>(p, a, b, size, f.length[k]);
    case FacetKind::hollow_cylinder: {
      const Vec<T> q = p - as<T>(a);
      const Nearest<T> out = from_point<T>(q - dot(q, as<T>(b)) * as<T>(b), any_across(b));
      return {Vec<T>(-out.normal), T(size) - out.distance};
    }
    case FacetKind::pipe: return of_pipe<T>(p, a, b, size, f.length[k]);
    case FacetKind::sphere: {
      const Nearest<T> out = from_point<T>(p - as<T>(a), Vec3::UnitZ());
      return {out.normal, out.distance - T(size)};
    }
    case FacetKind::hollow_sphere: {
      const Nearest<T> out = from_point<T>(p - as<T>(a), Vec3::UnitZ());
      return {Vec<T>(-out.normal), T(size) - out.distance};
    }
    case FacetKind::face: return of_face<T>(p, f, k);
    case FacetKind::edge: return of_edge<T>(p, f, k);
    case FacetKind::corner: return of_corner<T>(p, f, k);
    case FacetKind::more: break;
  }
  return {as<T>(Vec3::UnitZ()), T(0), false};
}

/// Radius of a sphere that is as blunt against a plane as one of radius r at that place is against this facet: Hertz' R* of
/// a rigid partner. At the mantle of a cylinder the geometric mean of its two directions, good for full cylinders that are
/// not thinner than the sphere and hollow ones of twice its radius (Johnson 1985, section 4.2). Not > 0 where the sphere does
/// not fit in.
inline Real effective_radius(const FacetViews& f, Index k, Real r, const Vec3& place) {
  const Real size = f.size[k];
  switch (static_cast<FacetKind>(f.kind[k])) {
    case FacetKind::sphere: return r * size / (size + r);
    case FacetKind::hollow_sphere: return size > r ? r * size / (size - r) : 0;
    case FacetKind::cylinder: {
      constexpr Real flat = 0.7;  // nearer to an end than to the mantle
      const bool at_an_end = std::abs(nearest<Real>(f, k, place).normal.dot(Vec3(f.v[1][k]))) > flat;
      return at_an_end ? r : r * std::sqrt(size / (size + r));
    }
    case FacetKind::pipe:
      if ((place - f.v[0][k]).cross(Vec3(f.v[1][k])).norm() > size) return r * std::sqrt(size / (size + r));
      [[fallthrough]];
    case FacetKind::hollow_cylinder: return size > r ? r * std::sqrt(size / (size - r)) : 0;
    default: return r;
  }
}

}  // namespace beadwork
