#include "core/io/wall_outlines.hpp"

#include <cmath>
#include <numbers>

#include "core/mechanics/rotation.hpp"

namespace beadwork {

namespace {

constexpr int corners_of_a_circle = 48;

void add_ring(std::vector<Line>& lines, const Vec3& centre, const Vec3& u, const Vec3& v, int corners) {
  const auto at = [&](int k) {
    const Real angle = 2 * std::numbers::pi * (k + 0.5) / corners;
    return Vec3(centre + std::cos(angle) * u + std::sin(angle) * v);
  };
  for (int k = 0; k < corners; ++k) lines.push_back({at(k), at(k + 1)});
}
void add_circle(std::vector<Line>& lines, const Vec3& centre, const Vec3& normal, Real radius) {
  const Vec3 u = radius * normal.unitOrthogonal();
  add_ring(lines, centre, u, normal.cross(u), corners_of_a_circle);
}

void add_box(std::vector<Line>& lines, const Vec3& centre, const Vec3& half) {
  for (int axis = 0; axis < 3; ++axis)
    for (const Real a : {-1., 1.})
      for (const Real b : {-1., 1.}) {
        Vec3 from = centre - half;
        from[(axis + 1) % 3] += (a + 1) * half[(axis + 1) % 3];
        from[(axis + 2) % 3] += (b + 1) * half[(axis + 2) % 3];
        lines.push_back({from, Vec3(from + 2 * half[axis] * Vec3::Unit(axis))});
      }
}

void add_cylinder(std::vector<Line>& lines, const Vec3& from, const Vec3& along, Real radius, Real length) {
  const Vec3 u = radius * along.unitOrthogonal(), v = along.cross(u);
  for (const Real z : {0., length}) add_circle(lines, from + z * along, along, radius);
  for (const Vec3& side : {u, v, Vec3(-u), Vec3(-v)})
    lines.push_back({Vec3(from + side), Vec3(from + side + length * along)});
}

/// Where the elements are, seen from a wall: the middle and half of the extent.
struct Around {
  Vec3 centre;
  Real size;
};

Around around_elements(const Domain& domain) {
  const auto x = domain.elements().column("position").view<Vec3>();
  const auto radius = domain.elements().column("radius").view<Real>();
  Eigen::AlignedBox3d box;
  for (Index row = 0; row < domain.size(); ++row)
    if (radius[row] > 0 && Vec3(x[row]).allFinite()) box.extend(Eigen::Vector3d(x[row]));
  if (box.isEmpty()) return {Vec3::Zero(), 0};
  return {Vec3(box.center()), 0.6 * box.diagonal().norm()};
}

void add_facet(std::vector<Line>& lines, const FacetViews& f, Index k, const Around& around) {
  const Vec3 a = f.v[0][k], b = f.v[1][k];
  const Real size = f.size[k];
  switch (static_cast<FacetKind>(f.kind[k])) {
    case FacetKind::plane: {
      const Vec3 u = around.size * b.unitOrthogonal();
      return add_ring(lines, around.centre - (around.centre - a).dot(b) * b, u, b.cross(u), 4);
    }
    case FacetKind::disc: return add_circle(lines, a, b, size);
    case FacetKind::box: return add_box(lines, a, b);
    case FacetKind::cylinder:
    case FacetKind::pipe:
    case FacetKind::hollow_cylinder: return add_cylinder(lines, a, b, size, f.length[k]);
    case FacetKind::sphere:
    case FacetKind::hollow_sphere:
      for (int axis = 0; axis < 3; ++axis) add_circle(lines, a, Vec3::Unit(axis), size);
      return;
    case FacetKind::edge: {
      constexpr Real smooth = -0.94;  // cosine of 160 degrees: edges of what is round in truth are not shown
      if (Vec3(f.v[2][k]).dot(Vec3(f.v[3][k])) > smooth) lines.push_back({a, b});
      return;
    }
    case FacetKind::face:
    case FacetKind::corner:
    case FacetKind::more: return;
  }
}

}  // namespace

std::vector<Line> wall_outlines(const Domain& domain) {
  std::vector<Line> lines;
  const Walls& walls = domain.walls();
  if (!walls.any()) return lines;
  const Around elements = around_elements(domain);
  for (Index k = 0; k < walls.size(); ++k) {
    const auto& [place, turn] = domain.pose(walls.element(k));
    const std::size_t first = lines.size();
    const Around around{rotate_back(turn, Vec3(elements.centre - place)), elements.size};
    const auto [begin, end] = walls.parts(k);
    const FacetViews facets = walls.facets();
    for (Index n = begin; n < end; ++n) add_facet(lines, facets, n, around);
    for (std::size_t n = first; n < lines.size(); ++n)
      for (Vec3& point : lines[n]) point = place + rotate(turn, point);
  }
  return lines;
}

}  // namespace beadwork
