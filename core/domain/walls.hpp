#pragma once
// Rigid walls. A wall is an element without a radius, which stands behind those that have one, and whose shape is a list of
// facets in its own frame: so it is held, moved and asked for its reaction like any element.

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/domain/facet.hpp"
#include "core/domain/near.hpp"
#include "core/domain/table.hpp"

namespace beadwork {

/// Mass [kg] and moment of inertia [kg m2] of a wall that moves only as loads tell: too small to count in any sum.
inline constexpr Real no_mass = 1e-30;

/// Where something stands, and how it is turned.
struct Pose {
  Vec3 position;  ///< [m]
  Quat orientation;
};

class FacetTree;

class Walls {
 public:
  Walls();

  /// Makes element `row` a wall. `moved_by_forces`: its mass is its own.
  void add(Index row, bool moved_by_forces, std::span<const Facet> facets);
  bool any() const { return walls_.size() > 0; }
  Index size() const { return walls_.size(); }
  /// Row of the element that wall k is.
  Index element(Index k) const { return walls_.column("element").view<Index>()[k]; }
  /// From its place, about which it turns, to its farthest point; infinite of a plane [m].
  Real extent(Index k) const { return walls_.column("extent").view<Real>()[k]; }
  bool is_wall(Index row) const { return any() && find(row) >= 0; }
  /// Whether forces move it too, beside loads.
  bool moved_by_forces(Index row) const;
  /// Takes what stood in row r to row_of[r].
  void reorder(std::span<const Index> row_of);
  /// Whether its numbers are those of walls, as a checkpoint may have lost: elements without a radius, behind all others of
  /// which `radius` tells; facets of their own, all finite.
  bool is_whole(View<const Real> radius, Index elements) const;
  /// Whether this facet is one of the wall that stands in that row.
  bool has_facet(Index row, Index facet) const;

  FacetViews facets() const;
  /// The first facet of wall k, and the one behind its last.
  std::pair<Index, Index> parts(Index k) const;
  /// Facets of all the walls.
  Index facet_count() const { return facets_.size(); }

  /// Which facets of the walls `among`, given by their rows, which stand at `poses`, are within reach[e] [m] of place[e]:
  /// (e, row of the wall, facet), sorted.
  std::vector<Near> near(std::span<const Vec3> place, std::span<const Real> reach, std::span<const Index> among,
                         std::span<const Pose> poses) const;

  /// Notes how wall k stands, and how far off the farthest element does [m].
  void note(Index k, const Pose& pose, Real farthest);
  /// How far any of its points may have moved since [m], that is no farther off than that element and `slack` [m].
  Real moved(Index k, const Pose& pose, Real slack) const;
  /// From its place to the farthest of its points that an element, moved by less than `slack` since, can be near to [m].
  Real lever(Index k, Real slack) const;

  Table& walls() { return walls_; }
  const Table& walls() const { return walls_; }
  Table& facet_rows() { return facets_; }
  const Table& facet_rows() const { return facets_; }

 private:
  Index find(Index row) const;
  const FacetTree& tree(Index k) const;
  Table walls_{Table::Layout::rows};
  Table facets_{Table::Layout::rows};
  mutable std::vector<std::shared_ptr<const FacetTree>> trees_;  ///< by wall, once somebody has looked for its facets
};

}  // namespace beadwork
