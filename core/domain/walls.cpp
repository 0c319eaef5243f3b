#include "core/domain/walls.hpp"

#include <algorithm>
#include <array>
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

constexpr const char* vectors[] = {"v0", "v1", "v2", "v3", "v4", "v5", "v6", "v7", "v8", "v9"};
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
    case FacetKind::pipe:
    case FacetKind::hollow_cylinder: return around_disc(a, b, size).merged(around_disc(a + f.length[k] * b, b, size));
    case FacetKind::sphere:
    case FacetKind::hollow_sphere: return around(a, Vec3::Constant(size));
    case FacetKind::face: return Box(Eigen::Vector3d(a)).extend(Eigen::Vector3d(b)).extend(Eigen::Vector3d(f.v[2][k]));
    case FacetKind::edge: return Box(Eigen::Vector3d(a)).extend(Eigen::Vector3d(b));
    case FacetKind::corner: return Box(Eigen::Vector3d(a));
    case FacetKind::more: break;
  }
  return {};
}

bool are_facets(const FacetViews& f, Index count) {
  constexpr auto kinds = static_cast<Index>(FacetKind::more);
  for (Index n = 0; n < count; ++n) {
    const Index kind = f.kind[n];
    if (kind < 0 || kind > kinds || !(f.size[n] >= 0) || !std::isfinite(f.size[n]) || !std::isfinite(f.length[n]))
      return false;
    for (const auto& v : f.v)
      if (!Vec3(v[n]).allFinite()) return false;
    if (kind == static_cast<Index>(FacetKind::corner) &&
        n + (std::max<Real>(f.size[n], 1) - 1) / facets::edges_in_a_corner >= count)
      return false;
  }
  return true;
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

}  // namespace

/// The facets of one wall, to be asked which are near a place.
class FacetTree {
 public:
  FacetTree(const FacetViews& views, Index begin, Index end) {
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
  /// Calls take(k) for the facets within `reach` of p, in the frame of the wall.
  template <class Take>
  void ask(const FacetViews& views, const Vec3& p, Real reach, const Take& take) const {
    const auto try_one = [&](Index k) {
      if (nearest<Real>(views, k, p).distance <= reach) take(k);
    };
    for (const Index k : endless_) try_one(k);
    const Vec3 half = Vec3::Constant(reach);
    const Region around = region(Box(Eigen::Vector3d(p - half), Eigen::Vector3d(p + half)));
    for (auto found = tree_.qbegin(bg::index::intersects(around)); found != tree_.qend(); ++found)
      try_one(found->second);
  }

 private:
  using Tree = bg::index::rtree<std::pair<Region, Index>, bg::index::rstar<16>>;
  std::vector<Index> endless_;
  Tree tree_;
};

Walls::Walls() {
  walls_.add({"element", On::scene, Type::index, "1", "Row of the element that the wall is", ""}).keep();
  walls_.add({"begin", On::scene, Type::index, "1", "First facet", ""}).keep();
  walls_.add({"end", On::scene, Type::index, "1", "Behind its last facet", ""}).keep();
  walls_.add({"free", On::scene, Type::index, "1", "1: forces move it where no load does", ""}).keep();
  walls_.add({"extent", On::scene, Type::real, "m", "From its place to its farthest point", ""}).keep();
  walls_.add({"noted-position", On::scene, Type::vec3, "m", "Place when pairs were last looked for", ""}).keep();
  walls_.add({"noted-distance", On::scene, Type::real, "m", "From it to the farthest element then", ""}).keep();
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
  trees_.clear();
  const auto kind = facets_.column("kind").view<Index>();
  const auto size = facets_.column("size").view<Real>(), length = facets_.column("length").view<Real>();
  std::array<View<Vec3>, 10> v;
  for (std::size_t c = 0; c < v.size(); ++c) v[c] = facets_.column(vectors[c]).view<Vec3>();
  for (Index n = begin; n < facets_.size(); ++n) {
    const Facet& facet = facets[static_cast<std::size_t>(n - begin)];
    kind[n] = static_cast<Index>(facet.kind);
    size[n] = facet.size;
    length[n] = facet.length;
    for (std::size_t c = 0; c < v.size(); ++c) v[c].set(n, facet.v[c]);
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
  note(k, {Vec3::Zero(), identity()}, 0);
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

bool Walls::is_whole(View<const Real> radius, Index elements) const {
  if (!any()) return facets_.size() == 0;
  const auto column = [&](const char* name) { return walls_.column(name).view<Index>(); };
  const auto number = [&](const char* name) { return walls_.column(name).view<Real>(); };
  const auto element = column("element"), begin = column("begin"), end = column("end");
  const auto extent = number("extent"), distance = number("noted-distance");
  const auto place = walls_.column("noted-position").view<Vec3>();
  const auto turn = walls_.column("noted-orientation").view<Quat>();
  Index next = 0;  // facets of one wall stand behind those of the one before
  for (Index k = 0; k < size(); ++k) {
    const Index row = element[k];
    if (row < 0 || row >= elements || radius[row] != 0) return false;
    if (begin[k] != next || end[k] <= begin[k] || end[k] > facets_.size()) return false;
    next = end[k];
    if (!(extent[k] >= 0) || !(distance[k] >= 0) || !Vec3(place[k]).allFinite()) return false;
    if (!(std::abs(squared_norm(Quat(turn[k])) - 1) < 1e-6)) return false;
  }
  for (Index row = 0; row < elements; ++row)
    if ((radius[row] == 0) != (row >= elements - size())) return false;
  return next == facets_.size() && are_facets(facets(), next);
}

bool Walls::has_facet(Index row, Index facet) const {
  const Index k = find(row);
  return k >= 0 && facet >= parts(k).first && facet < parts(k).second;
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

const FacetTree& Walls::tree(Index k) const {
  const auto place = static_cast<std::size_t>(k);
  trees_.resize(static_cast<std::size_t>(size()));
  if (!trees_[place]) trees_[place] = std::make_shared<FacetTree>(facets(), parts(k).first, parts(k).second);
  return *trees_[place];
}

std::vector<Near> Walls::near(std::span<const Vec3> place, std::span<const Real> reach, std::span<const Index> among,
                              std::span<const Pose> poses) const {
  constexpr std::size_t block = 256;  // places that one thread asks for, one by one
  const FacetViews views = facets();
  std::vector<Near> all;
  for (std::size_t w = 0; w < among.size(); ++w) {
    const FacetTree& facets_of_wall = tree(find(among[w]));
    std::vector<std::vector<Near>> found((place.size() + block - 1) / block);
    each_shared(found.size(), [&](std::size_t b) {
      for (std::size_t e = b * block; e < std::min(place.size(), (b + 1) * block); ++e) {
        const Vec3 p = rotate_back(poses[w].orientation, Vec3(place[e] - poses[w].position));
        facets_of_wall.ask(views, p, reach[e], [&](Index facet) {
          found[b].push_back({static_cast<Index>(e), among[w], facet});
        });
      }
    });
    for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
  }
  std::sort(all.begin(), all.end());
  return all;
}

void Walls::note(Index k, const Pose& pose, Real farthest) {
  walls_.column("noted-position").view<Vec3>().set(k, pose.position);
  walls_.column("noted-orientation").view<Quat>().set(k, pose.orientation);
  walls_.column("noted-distance").view<Real>()[k] = farthest;
}

Real Walls::lever(Index k, Real slack) const {
  return std::min<Real>(walls_.column("noted-distance").view<Real>()[k] + slack, extent(k));
}

Real Walls::moved(Index k, const Pose& pose, Real slack) const {
  const Vec3 shift = pose.position - walls_.column("noted-position").view<Vec3>()[k];
  const Vec3 turn = log_map(relative(Quat(walls_.column("noted-orientation").view<Quat>()[k]), pose.orientation));
  return shift.norm() + (turn.isZero() ? 0 : turn.norm() * lever(k, slack));
}

}  // namespace beadwork
