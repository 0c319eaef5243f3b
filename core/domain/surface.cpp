#include "core/domain/surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>

#include "core/domain/nearest.hpp"

namespace beadwork {

namespace {

namespace bg = boost::geometry;
using Point = bg::model::point<Real, 3, bg::cs::cartesian>;
using Region = bg::model::box<Point>;
using PointTree = bg::index::rtree<std::pair<Region, std::size_t>, bg::index::quadratic<16>>;

Point point(const Vec3& p) { return {p.x(), p.y(), p.z()}; }
Region region(const Vec3& low, const Vec3& high) { return {point(low), point(high)}; }
std::string tell(const Vec3& p) { return fmt::format("({:.6g} {:.6g} {:.6g})", p.x(), p.y(), p.z()); }

/// Corners that were meant to be one.
std::vector<Triangle> welded(std::span<const Triangle> triangles, Real near) {
  std::vector<Triangle> all(triangles.begin(), triangles.end());
  std::vector<Vec3> known;
  PointTree tree;
  for (Triangle& triangle : all)
    for (Vec3& corner : triangle) {
      const Vec3 half = Vec3::Constant(near);
      std::vector<std::pair<Region, std::size_t>> found;
      tree.query(bg::index::intersects(region(corner - half, corner + half)), std::back_inserter(found));
      if (found.empty()) {
        tree.insert({region(corner, corner), known.size()});
        known.push_back(corner);
      } else {
        corner = known[std::min_element(found.begin(), found.end(), [](const auto& a, const auto& b) {
                         return a.second < b.second;
                       })->second];
      }
    }
  return all;
}

Real extent_of(std::span<const Triangle> triangles) {
  Eigen::AlignedBox3d box;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const Vec3& corner : triangles[t]) {
      if (!corner.allFinite())
        throw std::invalid_argument(fmt::format("triangle {} has a coordinate that is not finite", t + 1));
      box.extend(Eigen::Vector3d(corner));
    }
  return box.isEmpty() ? 0 : box.sizes().maxCoeff();
}

struct Lesser {
  bool operator()(const Vec3& a, const Vec3& b) const { return facets::is_lesser(a, b); }
};

/// An edge at which faces meet, from its lesser end.
struct Edge {
  std::vector<std::pair<std::size_t, std::size_t>> at;  ///< (face, which of its edges)
  bool flat = false;
  bool concave = false;  ///< seen from the front
};
struct LesserEdge {
  bool operator()(const Triangle& a, const Triangle& b) const {
    return Lesser{}(a[0], b[0]) || (!Lesser{}(b[0], a[0]) && Lesser{}(a[1], b[1]));
  }
};
using Edges = std::map<Triangle, Edge, LesserEdge>;  // by its two ends, the lesser first

constexpr Real one_plane = 1e-6;  ///< sine of the angle up to which two triangles lie in one plane: single precision
constexpr Real round_off = 1e-6;  ///< of places, over the extent: single precision too
/// Sine of the angle up to which an edge belongs to something round: a sphere that overlaps by less than 6 % of its radius
/// then comes to the next face before the valley of the two has an end on this one.
constexpr Real hardly_bent = 0.342;

Triangle ends(const Facet& face, std::size_t e) {
  const Vec3 one = face.v[e], other = face.v[(e + 1) % 3];
  return Lesser{}(one, other) ? Triangle{one, other, Vec3::Zero()} : Triangle{other, one, Vec3::Zero()};
}

std::vector<Facet> faces_of(std::span<const Triangle> triangles, Sides sides) {
  std::vector<Facet> faces;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Vec3 a = triangles[t][0], b = triangles[t][sides == Sides::back ? 2 : 1],
               c = triangles[t][sides == Sides::back ? 1 : 2];
    const Vec3 area = (b - a).cross(c - a);
    const Real longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    if (!(area.norm() > 1e-12 * longest * longest)) continue;
    Facet face = Facet::of(FacetKind::face, a, b, sides == Sides::both ? 2 : 1);
    const Vec3 normal = area.normalized();
    face.v[2] = c;
    face.v[6] = normal;
    for (std::size_t e = 0; e < 3; ++e) face.v[3 + e] = (face.v[(e + 1) % 3] - face.v[e]).cross(normal).normalized();
    faces.push_back(face);
  }
  if (faces.empty()) throw std::invalid_argument("it has no triangle with an area");
  return faces;
}

Edges edges_of(std::vector<Facet>& faces, Sides sides) {
  Edges edges;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t e = 0; e < 3; ++e) edges[ends(faces[f], e)].at.emplace_back(f, e);
  for (auto& [between, edge] : edges) {
    if (edge.at.size() > 2)
      throw std::invalid_argument(fmt::format("{} triangles share the edge from {} to {}: a surface has two at most",
                                              edge.at.size(), tell(between[0]), tell(between[1])));
    if (edge.at.size() < 2) continue;
    Facet &one = faces[edge.at[0].first], &other = faces[edge.at[1].first];
    if (sides != Sides::both && one.v[edge.at[0].second] == other.v[edge.at[1].second])
      throw std::invalid_argument(
          fmt::format("the two triangles at the edge from {} to {} go round differently, so that "
                      "their side cannot be told",
                      tell(between[0]), tell(between[1])));
    const Vec3 out1 = one.v[3 + edge.at[0].second];
    Vec3& out2 = other.v[3 + edge.at[1].second];
    edge.flat = out1.cross(out2).norm() < one_plane && out1.dot(out2) < 0;
    edge.concave = out1.dot(other.v[6]) < 0;
    if (!edge.flat && out1.cross(out2).norm() < hardly_bent && out1.dot(out2) < 0) {
      one.v[7 + edge.at[0].second] = (out1 - out2).normalized();
      other.v[7 + edge.at[1].second] = -one.v[7 + edge.at[0].second];
    }
    if (edge.flat) out2 = -out1;  // both ask about one plane, so that no place is on neither side
  }
  return edges;
}

struct Corner {
  std::vector<Vec3> leaving;   ///< along its edges
  Vec3 front = Vec3::Zero();   ///< normals of its faces by their angles: tells the side (Baerentzen and Aanaes 2005)
  bool is_at_an_edge = false;  ///< that stands out
};
using Corners = std::map<Vec3, Corner, Lesser>;

void add_fronts(Corners& corners, std::span<const Facet> faces) {
  for (const Facet& face : faces)
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 one = face.v[(c + 1) % 3] - face.v[c], other = face.v[(c + 2) % 3] - face.v[c];
      corners[face.v[c]].front += std::atan2(one.cross(other).norm(), one.dot(other)) * face.v[6];
    }
}

void add_corner(std::vector<Facet>& all, const Vec3& place, const Corner& corner, Sides sides) {
  constexpr auto room = static_cast<std::size_t>(facets::edges_in_a_corner);
  for (std::size_t n = 0; n < corner.leaving.size(); ++n) {
    if (n % room == 0) {
      Facet& facet = all.emplace_back(Facet::of(n == 0 ? FacetKind::corner : FacetKind::more, place));
      if (n == 0 && sides != Sides::both) facet.v[1] = corner.front.normalized();
      if (n == 0) facet.size = static_cast<Real>(corner.leaving.size());
    }
    all.back().v[2 + n % room] = corner.leaving[n];
  }
}

}  // namespace

namespace {

/// A corner on the edge of a triangle that it is no corner of leaves a gap that is touched twice.
void refuse_corners_on_edges(const Edges& edges, Real near) {
  PointTree corners;
  std::vector<Vec3> places;
  for (const auto& [between, edge] : edges)
    for (const std::size_t end : {0U, 1U}) {
      if (edge.at.size() > 1) continue;
      corners.insert({region(between[end], between[end]), places.size()});
      places.push_back(between[end]);
    }
  for (const auto& [between, edge] : edges) {
    if (edge.at.size() > 1) continue;
    const Vec3 half = Vec3::Constant(near), along = (between[1] - between[0]).normalized();
    const Region around = region(between[0].cwiseMin(between[1]) - half, between[0].cwiseMax(between[1]) + half);
    for (auto found = corners.qbegin(bg::index::intersects(around)); found != corners.qend(); ++found) {
      const Vec3 p = places[found->second], q = p - between[0];
      const Real z = q.dot(along);
      if (z > near && z < (between[1] - between[0]).norm() - near && (q - z * along).norm() < near)
        throw std::invalid_argument(
            fmt::format("corner {} lies on the edge from {} to {} of a triangle that ends there: "
                        "divide that triangle, so that the two share the corner",
                        tell(p), tell(between[0]), tell(between[1])));
    }
  }
}

/// Six times the volume that faces enclose whose front is outside.
Real volume_of(std::span<const Facet> faces) {
  Real sum = 0;
  for (const Facet& face : faces) sum += face.v[0].dot(Vec3(face.v[1].cross(face.v[2])));
  return sum;
}

void require_closed(const Edges& edges, std::span<const Facet> faces, Sides sides) {
  const auto open =
      std::count_if(edges.begin(), edges.end(), [](const auto& edge) { return edge.second.at.size() < 2; });
  if (open > 0)
    throw std::invalid_argument(fmt::format(
        "it is not closed, {} of its edges belong to one triangle only: it has no inside, so leave 'side' out", open));
  if ((sides == Sides::front) != (volume_of(faces) > 0))
    throw std::invalid_argument("its triangles go round clockwise, seen from outside: turn them over");
}

}  // namespace

bool is_closed(std::span<const Triangle> triangles) {
  std::vector<Facet> faces = faces_of(welded(triangles, round_off * extent_of(triangles)), Sides::both);
  const Edges edges = edges_of(faces, Sides::both);
  return std::all_of(edges.begin(), edges.end(), [](const auto& edge) { return edge.second.at.size() == 2; });
}

std::vector<Facet> facets_of(std::span<const Triangle> triangles, Sides sides) {
  const Real near = round_off * extent_of(triangles);
  std::vector<Facet> all = faces_of(welded(triangles, near), sides);
  const Edges edges = edges_of(all, sides);
  refuse_corners_on_edges(edges, near);
  if (sides != Sides::both) require_closed(edges, all, sides);
  Corners corners;
  if (sides != Sides::both) add_fronts(corners, all);
  for (const auto& [between, edge] : edges) {
    const Vec3 along = (between[1] - between[0]).normalized();
    const bool stands_out = !edge.flat && (sides == Sides::both || !edge.concave);
    for (const std::size_t end : {0U, 1U}) {
      Corner& corner = corners[between[end]];
      corner.leaving.push_back(end == 0 ? along : Vec3(-along));
      corner.is_at_an_edge |= stands_out;
    }
    if (!stands_out) continue;
    Facet facet = Facet::of(FacetKind::edge, between[0], between[1]);
    facet.v[4] = along;
    for (std::size_t n = 0; n < edge.at.size(); ++n) facet.v[2 + n] = all[edge.at[n].first].v[3 + edge.at[n].second];
    all.push_back(facet);
  }
  for (const auto& [place, corner] : corners)
    if (corner.is_at_an_edge) add_corner(all, place, corner, sides);
  return all;
}

}  // namespace beadwork
