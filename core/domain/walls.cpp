#include "core/domain/walls.hpp"

#include <algorithm>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <limits>

#include "core/base/parallel.hpp"
#include "core/domain/nearest.hpp"
#include "core/mechanics/rotation.hpp"

namespace beadwork {

namespace {

constexpr const char* vectors[] = {"v0", "v1", "v2", "v3", "v4", "v5", "v6"};
constexpr Real infinity = std::numeric_limits<Real>::infinity();

using Box = Eigen::AlignedBox<Real, 3>;

Box around_disc(const Vec3& centre, const Vec3& normal, Real radius) {
  const Vec3 half = radius * (Vec3::Ones() - normal.cwiseProduct(normal)).cwiseMax(0).cwiseSqrt();
  return Box(Eigen::Vector3d(centre - half), Eigen::Vector3d(centre + half));
}

/// Of facet k; empty of what is no part by itself, without end of a plane.
Box box_of(const FacetViews& f, Index k) {
  const Vec3 a = f.v[0][k], b = f.v[1][k];
  const Real size = f.size[k];
  const auto around = [](const Vec3& centre, const Vec3& half) {
    return Box(Eigen::Vector3d(centre - half), Eigen::Vector3d(centre + half));
  };
  switch (static_cast<FacetKind>(f.kind[k])) {
    case FacetKind::plane: return around(Vec3::Zero(), Vec3::Constant(infinity));
    case FacetKind::disc: return around_disc(a, b, size);
    case FacetKind::box: return around(a, b);
    case FacetKind::cylinder:
    case FacetKind::barrel: return around_disc(a, b, size).merged(around_disc(a + f.length[k] * b, b, size));
    case FacetKind::ball:
    case FacetKind::bowl: return around(a, Vec3::Constant(size));
    case FacetKind::face: return Box(Eigen::Vector3d(a)).extend(Eigen::Vector3d(b)).extend(Eigen::Vector3d(f.v[2][k]));
    case FacetKind::edge: return Box(Eigen::Vector3d(a)).extend(Eigen::Vector3d(b));
    case FacetKind::corner: return Box(Eigen::Vector3d(a));
    case FacetKind::more: break;
  }
  return {};
}

/// Farthest that any point of it stands off the origin, about which the wall turns.
Real farthest(const Box& box) {
  if (box.isEmpty()) return 0;
  return box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).norm();
}

namespace bg = boost::geometry;
using Point = bg::model::point<Real, 3, bg::cs::cartesian>;
using Region = bg::model::box<Point>;

Region region(const Box& box) {
  return {Point(box.min().x(), box.min().y(), box.min().z()), Point(box.max().x(), box.max().y(), box.max().z())};
}

/// The facets of one wall, to be asked which are near a place.
class FacetTree {
 public:
  FacetTree(const FacetViews& views, Index begin, Index end) : views_(views) {
    std::vector<std::pair<Region, Index>> bounded;
    for (Index k = begin; k < end; ++k) {
      const Box box = box_of(views, k);
      if (box.isEmpty()) continue;
      if (std::isfinite(box.min().x()))
        bounded.emplace_back(region(box), k);
      else
        endless_.push_back(k);
    }
    tree_ = Tree(bounded.begin(), bounded.end());
  }
  /// Adds to `found` the facets within `reach` of p, in the frame of the wall.
  void ask(const Vec3& p, Real reach, std::vector<Index>& found) const {
    std::vector<std::pair<Region, Index>> candidates;
    tree_.query(bg::index::intersects(region(Box(Eigen::Vector3d(p - Vec3::Constant(reach)),
                                                 Eigen::Vector3d(p + Vec3::Constant(reach))))),
                std::back_inserter(candidates));
    const auto take = [&](Index k) {
      if (nearest<Real>(views_, k, p).distance <= reach) found.push_back(k);
    };
    for (const Index k : endless_) take(k);
    for (const auto& [box, k] : candidates) take(k);
  }

 private:
  using Tree = bg::index::rtree<std::pair<Region, Index>, bg::index::rstar<16>>;
  FacetViews views_;
  std::vector<Index> endless_;
  Tree tree_;
};

}  // namespace

Walls::Walls() {
  walls_.add({"element", On::scene, Type::index, "1", "Row of the element that the wall is", ""}).keep();
  walls_.add({"begin", On::scene, Type::index, "1", "First facet", ""}).keep();
  walls_.add({"end", On::scene, Type::index, "1", "Behind its last facet", ""}).keep();
  walls_.add({"free", On::scene, Type::index, "1", "1: forces move it where no load does", ""}).keep();
  walls_.add({"extent", On::scene, Type::real, "m", "From its place to its farthest point", ""}).keep();
  walls_.add({"noted-position", On::scene, Type::vec3, "m", "Place when pairs were last looked for", ""}).keep();
  walls_.add({"noted-orientation", On::scene, Type::quat, "1", "Orientation then", ""}).keep();
  facets_.add({"kind", On::scene, Type::index, "1", "What it is", "facet"}).keep();
  facets_.add({"size", On::scene, Type::real, "m", "Radius", "facet"}).keep();
  facets_.add({"length", On::scene, Type::real, "m", "Length", "facet"}).keep();
  for (const char* vector : vectors)
    facets_.add({vector, On::scene, Type::vec3, "m", "A place or a direction, by kind", "facet"}).keep();
}

void Walls::add(Index row, bool moved_by_forces, std::span<const Facet> facets) {
  const Index k = walls_.size(), begin = facets_.size();
  facets_.resize(begin + static_cast<Index>(facets.size()));
  const auto kind = facets_.column("kind").view<Index>();
  const auto size = facets_.column("size").view<Real>(), length = facets_.column("length").view<Real>();
  for (Index n = begin; n < facets_.size(); ++n) {
    const Facet& facet = facets[static_cast<std::size_t>(n - begin)];
    kind[n] = static_cast<Index>(facet.kind);
    size[n] = facet.size;
    length[n] = facet.length;
    for (std::size_t v = 0; v < facet.v.size(); ++v) facets_.column(vectors[v]).view<Vec3>().set(n, facet.v[v]);
  }
  walls_.resize(k + 1);
  const auto set = [&](const char* column, Index value) { walls_.column(column).view<Index>()[k] = value; };
  set("element", row);
  set("begin", begin);
  set("end", facets_.size());
  set("free", moved_by_forces);
  Real extent = 0;
  const FacetViews views = this->facets();
  for (Index n = begin; n < facets_.size(); ++n) extent = std::max(extent, farthest(box_of(views, n)));
  walls_.column("extent").view<Real>()[k] = extent;
}

Index Walls::find(Index row) const {
  const auto element = walls_.column("element").view<Index>();
  for (Index k = 0; k < size(); ++k)
    if (element[k] == row) return k;
  return -1;
}

bool Walls::moved_by_forces(Index row) const {
  const Index k = find(row);
  return k >= 0 && walls_.column("free").view<Index>()[k] != 0;
}

void Walls::reorder(std::span<const Index> row_of) {
  const auto element = walls_.column("element").view<Index>();
  for (Index k = 0; k < size(); ++k) element[k] = row_of[static_cast<std::size_t>(element[k])];
}

bool Walls::is_whole(Index elements) const {
  const auto column = [&](const char* name) { return walls_.column(name).view<Index>(); };
  const auto element = column("element"), begin = column("begin"), end = column("end");
  bool whole = true;
  for (Index k = 0; k < size(); ++k)
    whole = whole && element[k] >= 0 && element[k] < elements && begin[k] >= 0 && begin[k] <= end[k] &&
            end[k] <= facets_.size();
  const FacetViews views = facets();
  for (Index n = 0; n < facets_.size(); ++n) {
    const Index kind = views.kind[n];
    const Real edges = kind == static_cast<Index>(FacetKind::corner) ? Real(views.size[n]) : 0;
    whole = whole && kind >= 0 && kind <= static_cast<Index>(FacetKind::more) && edges >= 0 &&
            n + (edges - 1) / facets::edges_in_a_corner < facets_.size();
  }
  return whole;
}

FacetViews Walls::facets() const {
  FacetViews views;
  views.kind = facets_.column("kind").view<Index>();
  views.size = facets_.column("size").view<Real>();
  views.length = facets_.column("length").view<Real>();
  for (std::size_t v = 0; v < views.v.size(); ++v) views.v[v] = facets_.column(vectors[v]).view<Vec3>();
  return views;
}

std::pair<Index, Index> Walls::parts(Index k) const {
  return {walls_.column("begin").view<Index>()[k], walls_.column("end").view<Index>()[k]};
}

std::vector<Near> Walls::near(std::span<const Vec3> place, std::span<const Real> reach, std::span<const Index> among,
                              std::span<const Pose> poses) const {
  const FacetViews views = facets();
  std::vector<Near> all;
  for (std::size_t w = 0; w < among.size(); ++w) {
    const auto [begin, end] = parts(find(among[w]));
    const FacetTree tree(views, begin, end);
    std::vector<std::vector<Index>> found(place.size());
    each_shared(
        place.size(),
        [&](std::size_t e) {
          const Vec3 p = rotate_back(poses[w].orientation, Vec3(place[e] - poses[w].position));
          tree.ask(p, reach[e], found[e]);
        },
        256);
    for (std::size_t e = 0; e < place.size(); ++e)
      for (const Index facet : found[e]) all.push_back({static_cast<Index>(e), among[w], facet});
  }
  std::sort(all.begin(), all.end());
  return all;
}

void Walls::note(Index k, const Pose& pose) {
  walls_.column("noted-position").view<Vec3>().set(k, pose.position);
  walls_.column("noted-orientation").view<Quat>().set(k, pose.orientation);
}

Real Walls::moved(Index k, const Pose& pose, Real distance) const {
  const Vec3 shift = pose.position - walls_.column("noted-position").view<Vec3>()[k];
  const Vec3 turn = log_map(relative(Quat(walls_.column("noted-orientation").view<Quat>()[k]), pose.orientation));
  return shift.norm() + turn.norm() * std::min<Real>(distance, walls_.column("extent").view<Real>()[k]);
}

}  // namespace beadwork
