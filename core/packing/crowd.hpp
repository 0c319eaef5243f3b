#pragma once
// The elements while they are being arranged: moving ones first, obstacles behind them; lengths in units of
// the mean radius, so that the numbers of the method do not depend on the units of the specimen.

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/base/pause.hpp"
#include "core/base/types.hpp"
#include "core/domain/neighbours.hpp"
#include "core/packing/packing.hpp"
#include "core/packing/region.hpp"

namespace beadwork::packing {

/// Position and radius side by side: half a line of memory, loaded together in every loop over neighbours.
struct Ball {
  Vec3 x;
  Real r;
};

struct Crowd {
  Walls walls;
  std::vector<Ball> ball;
  std::size_t moving = 0;  ///< ball[moving] and those behind are obstacles
  Vec3 origin;
  Real unit;
  Pause pause = never_paused;
};

/// Along a Hilbert curve; `order[k]` is the element of the packing that became ball k.
Crowd crowd_of(const Packing&, std::vector<Index>& order);
void put_back(const Crowd&, const std::vector<Index>& order, Packing&);

/// Pairs with a gap below `gap`.
std::vector<Pair> near_pairs(const Crowd&, Real gap);

Real mean_radius(const Crowd&);
void scale_radii(Crowd&, Real factor);

/// Neighbour lists that stay valid until elements have moved or grown by the skin.
class Neighbours {
 public:
  explicit Neighbours(Real skin) : skin_(skin) {}
  /// The list for the crowd as it is; rebuilt only if needed.
  const NeighbourList& of(const Crowd&);
  /// The same for one who followed the changes: `worst` is the largest `change` of an element.
  const NeighbourList& after(const Crowd&, Real worst);
  /// How far element i has come since the list was built, its growth included.
  Real change(const Crowd& crowd, std::size_t i) const {
    const Ball &now = crowd.ball[i], &then = built_for_[i];
    return (now.x - then.x).norm() + std::max(Real(0), now.r - then.r);
  }

 private:
  void build(const Crowd&);
  Real skin_;
  std::vector<Ball> built_for_;
  NeighbourList list_;
};

struct Largest {
  Real value = 0;
  void operator+=(const Largest& other) { value = std::max(value, other.value); }
};

/// What is nearer to a wall or an obstacle is not bulk [mean radii].
inline constexpr Real bulk_margin = 3;
/// Which moving elements are within 3 mean radii of an obstacle.
std::vector<char> near_obstacles(const Crowd&);
/// Which moving elements are farther than 3 mean radii from walls and obstacles.
std::vector<char> bulk_of(const Crowd&);

/// How far each moving element reaches into an obstacle, over its own radius; 0 where it does not.
std::vector<Real> depth_in_obstacles(const Crowd&);

/// Contacts among elements (obstacles included, walls not) per moving element; or per one that counts. 0 if none does.
Real coordination(const Crowd&, Neighbours&);
Real coordination(const Crowd&, Neighbours&, const std::vector<char>& counts);

/// Overlap / (R1 + R2), the mean over the pairs that overlap.
Real mean_overlap(const Crowd&, Neighbours&);

}  // namespace beadwork::packing
