#pragma once
// Rigid walls. A wall is an element without a radius, which stands behind those that have one, and whose shape is a list of
// facets in its own frame: so it is held, moved and asked for its reaction like any element.

#include <span>
#include <utility>
#include <vector>

#include "core/domain/table.hpp"
#include "core/domain/facet.hpp"

namespace beadwork {

/// Mass [kg] and moment of inertia [kg m2] of a wall that moves only as loads tell: too small to count in any sum.
inline constexpr Real no_mass = 1e-30;

/// An element and one near it; or a wall, and which of its facets.
struct Near {
  Index first, second;
  Index facet = -1;
  friend auto operator<=>(const Near&, const Near&) = default;
};

class Walls {
 public:
  Walls();

  /// Makes element `row` a wall. `moved_by_forces`: its mass is its own.
  void add(Index row, bool moved_by_forces, std::span<const Facet> facets);
  bool any() const { return walls_.size() > 0; }
  Index size() const { return walls_.size(); }
  /// Row of the element that wall k is, ascending.
  Index element(Index k) const { return walls_.column("element").view<Index>()[k]; }
  /// From its place, about which it turns, to its farthest point; infinite of a plane [m].
  Real extent(Index k) const { return walls_.column("extent").view<Real>()[k]; }
  bool is_wall(Index row) const { return find(row) >= 0; }
  /// Whether forces move it too, beside loads.
  bool moved_by_forces(Index row) const;
  /// Takes what stood in row r to row_of[r].
  void reorder(std::span<const Index> row_of);

  /// Whether its numbers lead to facets that there are, and to elements below `elements`.
  bool is_whole(Index elements) const;

  FacetViews facets() const;
  /// The first facet of wall k, and the one behind its last.
  std::pair<Index, Index> parts(Index k) const;
  /// Facets of all the walls.
  Index facet_count() const { return facets_.size(); }

  /// The facets within `reach[e]` of place[e], each with the number e and the row of its wall in `among`, sorted.
  /// `pose(row)` is the position and orientation of a wall.
  struct Pose {
    Vec3 position;
    Quat orientation;
  };
  std::vector<Near> near(std::span<const Vec3> place, std::span<const Real> reach, std::span<const Index> among,
                         std::span<const Pose> poses) const;

  /// Notes how wall k stands; and how far any of its points, no farther off than `distance`, may have moved since.
  void note(Index k, const Pose& pose);
  Real moved(Index k, const Pose& pose, Real distance) const;

  Table& walls() { return walls_; }
  const Table& walls() const { return walls_; }
  Table& facet_rows() { return facets_; }
  const Table& facet_rows() const { return facets_; }

 private:
  Index find(Index row) const;
  Table walls_{Table::Layout::rows};
  Table facets_{Table::Layout::rows};
};

}  // namespace beadwork
