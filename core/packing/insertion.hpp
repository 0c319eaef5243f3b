#pragma once
// Placing elements at random where there is room.

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/pause.hpp"
#include "core/base/random.hpp"
#include "core/base/types.hpp"
#include "core/packing/crowd.hpp"

namespace beadwork::packing {

/// The region cut into cells as wide as the largest element: who is in the way of a new one.
class InsertionGrid {
 public:
  InsertionGrid(const Region&, Real largest_radius);

  void add(const Ball&);
  /// Obstacles may be much larger than a cell: each is entered in every cell from which it can be touched.
  void add_obstacle(const Ball&);
  /// Smallest gap / (R1 + R2) between the ball and the others near it, at most 1; any number below `least` if
  /// it is below `least`. An obstacle gives way less than others do: what would reach into one by a tenth of its own
  /// radius fits nowhere.
  Real clearance(const Ball&, Real least) const;
  /// Whether x is at least `margin` outside every obstacle; the margin is at most the largest radius.
  bool clear_of_obstacles(const Vec3& x, Real margin) const;
  /// Whether x lies in a ball of that radius that no obstacle reaches into: in a crevice too narrow for it no place does.
  /// The radius is at most half the largest one. Found by moving the ball out of the way of one obstacle after another.
  bool reachable(const Vec3& x, Real radius) const;

 private:
  std::size_t cell_of(const Vec3& x) const { return flat(place_of(x)); }
  Eigen::Vector3i place_of(const Vec3& x) const;
  std::size_t flat(const Eigen::Vector3i& c) const {
    return (std::size_t(c[2]) * std::size_t(cells_[1]) + std::size_t(c[1])) * std::size_t(cells_[0]) +
           std::size_t(c[0]);
  }
  std::span<const Ball> obstacles_at(std::size_t cell) const {
    if (obstacles_.empty()) return {};
    return obstacles_[cell];
  }
  struct Entry {
    Ball ball;
    Index next;
  };
  Vec3 low_;
  Real reach_;
  Real edge_;
  Eigen::Vector3i cells_;
  std::vector<Index> first_;  ///< per cell: its last entry, which names the one before
  std::vector<Entry> entry_;
  std::vector<std::vector<Ball>> obstacles_;  ///< per cell; empty if there are none
};

/// Largest part of its own radius by which an element may be put into an obstacle.
inline constexpr Real most_into_obstacle = 0.1;

struct InsertionRule {
  Real tolerance = 0;          ///< largest overlap / (R1 + R2)
  int choices = 1;             ///< random places looked at for each element; the one with the most room is taken
  int patience = 1;            ///< goes of an element before the next one's turn
  int tries = 20000;           ///< ends after so many goes in a row found no place
  Pause pause = never_paused;  ///< called at each element's turn
  Tell tell = [](const std::string&) {};
};

/// Tries the radii in turn until all are placed or nothing more fits. Placed balls are appended to `placed`
/// and entered in the grid; `radii` keeps the others. More numbers may be drawn than tries are made.
void insert_at_random(InsertionGrid&, const Region&, const InsertionRule&, Random&, std::vector<Real>& radii,
                      std::vector<Ball>& placed);

}  // namespace beadwork::packing
