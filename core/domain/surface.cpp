#include "core/domain/surface.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <stdexcept>

#include "core/domain/nearest.hpp"

namespace beadwork {

namespace {

struct Lesser {
  bool operator()(const Vec3& a, const Vec3& b) const { return facets::is_lesser(a, b); }
};

/// An edge at which faces meet, from its lesser end.
struct Edge {
  std::vector<std::pair<std::size_t, std::size_t>> at;  ///< (face, which of its edges)
  bool flat = false;
  bool hollow = false;  ///< a valley, seen from the front
};
struct LesserEdge {
  bool operator()(const Triangle& a, const Triangle& b) const {
    return Lesser{}(a[0], b[0]) || (!Lesser{}(b[0], a[0]) && Lesser{}(a[1], b[1]));
  }
};
using Edges = std::map<Triangle, Edge, LesserEdge>;  // by its two ends, the lesser first

constexpr Real one_plane = 1e-6;  ///< sine of the angle up to which two triangles lie in one plane: single precision

Triangle ends(const Facet& face, std::size_t e) {
  const Vec3 one = face.v[e], other = face.v[(e + 1) % 3];
  return Lesser{}(one, other) ? Triangle{one, other, Vec3::Zero()} : Triangle{other, one, Vec3::Zero()};
}

std::vector<Facet> faces_of(std::span<const Triangle> triangles, Sides sides) {
  std::vector<Facet> faces;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Vec3 a = triangles[t][0], b = triangles[t][sides == Sides::back ? 2 : 1],
               c = triangles[t][sides == Sides::back ? 1 : 2];
    if (!a.allFinite() || !b.allFinite() || !c.allFinite())
      throw std::invalid_argument(fmt::format("triangle {} has a coordinate that is not finite", t + 1));
    const Vec3 area = (b - a).cross(c - a);
    const Real longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    if (!(area.norm() > 1e-12 * longest * longest)) continue;
    Facet face{FacetKind::face, {}, sides == Sides::both ? 2. : 1., 0};
    const Vec3 normal = area.normalized();
    face.v = {a, b, c, Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), normal};
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
    const auto tell = [&](const Vec3& p) { return fmt::format("({:.6g} {:.6g} {:.6g})", p.x(), p.y(), p.z()); };
    if (edge.at.size() > 2)
      throw std::invalid_argument(fmt::format("{} triangles share the edge from {} to {}: a surface has two at most",
                                              edge.at.size(), tell(between[0]), tell(between[1])));
    if (edge.at.size() < 2) continue;
    Facet &one = faces[edge.at[0].first], &other = faces[edge.at[1].first];
    if (sides != Sides::both && one.v[edge.at[0].second] == other.v[edge.at[1].second])
      throw std::invalid_argument(fmt::format("the two triangles at the edge from {} to {} go round differently, so that "
                                              "their side cannot be told",
                                              tell(between[0]), tell(between[1])));
    const Vec3 out1 = one.v[3 + edge.at[0].second];
    Vec3& out2 = other.v[3 + edge.at[1].second];
    edge.flat = out1.cross(out2).norm() < one_plane && out1.dot(out2) < 0;
    edge.hollow = out1.dot(other.v[6]) < 0;
    if (edge.flat) out2 = -out1;  // both ask about one plane, so that no place is on neither side
  }
  return edges;
}

struct Corner {
  std::vector<Vec3> leaving;    ///< along its edges
  Vec3 front = Vec3::Zero();    ///< normals of its faces by their angles: tells the side (Baerentzen and Aanaes 2005)
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
      Facet& facet = all.emplace_back(Facet{n == 0 ? FacetKind::corner : FacetKind::more, {}, 0, 0});
      facet.v.fill(Vec3::Zero());
      facet.v[0] = place;
      if (n == 0 && sides != Sides::both) facet.v[1] = corner.front.normalized();
      if (n == 0) facet.size = static_cast<Real>(corner.leaving.size());
    }
    all.back().v[2 + n % room] = corner.leaving[n];
  }
}

}  // namespace

std::vector<Facet> facets_of(std::span<const Triangle> triangles, Sides sides) {
  std::vector<Facet> all = faces_of(triangles, sides);
  const Edges edges = edges_of(all, sides);
  Corners corners;
  if (sides != Sides::both) add_fronts(corners, all);
  for (const auto& [between, edge] : edges) {
    const Vec3 along = (between[1] - between[0]).normalized();
    const bool stands_out = !edge.flat && (sides == Sides::both || !edge.hollow);
    for (const std::size_t end : {0U, 1U}) {
      Corner& corner = corners[between[end]];
      corner.leaving.push_back(end == 0 ? along : Vec3(-along));
      corner.is_at_an_edge |= stands_out;
    }
    if (!stands_out) continue;
    Facet facet{FacetKind::edge, {}, 0, 0};
    facet.v.fill(Vec3::Zero());
    facet.v[0] = between[0], facet.v[1] = between[1], facet.v[4] = along;
    for (std::size_t n = 0; n < edge.at.size(); ++n) facet.v[2 + n] = all[edge.at[n].first].v[3 + edge.at[n].second];
    all.push_back(facet);
  }
  for (const auto& [place, corner] : corners)
    if (corner.is_at_an_edge) add_corner(all, place, corner, sides);
  return all;
}

}  // namespace beadwork
