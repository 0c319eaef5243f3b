#pragma once
// The volume to be filled and its rigid walls.

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/base/types.hpp"

namespace beadwork::packing {

struct Box {
  Vec3 low;
  Vec3 high;
};

/// From the centre of one end to the centre of the other, in any direction.
struct Cylinder {
  Vec3 from;
  Vec3 to;
  Real radius;
};

using Region = std::variant<Box, Cylinder>;

/// A wall as an element sees it: how far its centre is, and the direction back into the region.
struct WallView {
  Real distance;
  Vec3 inward;
};

struct Plane {
  Vec3 inward;
  Real offset;  ///< distance of x = inward . x - offset
};

struct Tube {
  Vec3 point;
  Vec3 axis;
  Real radius;
};

/// The walls of a region: some planes, and a tube for a cylinder. Every region is convex.
class Walls {
 public:
  Walls() = default;
  explicit Walls(const Region&);

  std::size_t size() const { return planes_.size() + (tube_ ? 1 : 0); }
  WallView view(std::size_t wall, const Vec3& x) const {
    return wall < planes_.size() ? plane_view(planes_[wall], x) : tube_view(*tube_, x);
  }
  /// Distance to the nearest wall, negative outside.
  Real distance(const Vec3& x) const;

 private:
  static WallView plane_view(const Plane& p, const Vec3& x) { return {p.inward.dot(x) - p.offset, p.inward}; }
  static WallView tube_view(const Tube& t, const Vec3& x);
  std::vector<Plane> planes_;
  std::optional<Tube> tube_;
};

Real volume(const Region&);
/// Radius of the largest sphere that fits.
Real inradius(const Region&);
/// A point of the region from three numbers in [0, 1), uniform over its volume; with a margin, over the part
/// whose distance from every wall is at least the margin.
Vec3 point_in(const Region&, const Vec3& unit, Real margin = 0);
/// The part of the region whose distance from every wall is at least the margin; the margin is below the
/// inradius.
Region shrunk(const Region&, Real margin);
/// The smallest box along the axes that holds the region.
Box bounds(const Region&);
/// The same region in another unit of length and with its origin elsewhere: x -> (x - origin) / unit.
Region rescaled(const Region&, const Vec3& origin, Real unit);
Vec3 centre(const Region&);
std::string describe(const Region&);
/// Throws std::invalid_argument if an extent is zero, negative or not finite.
void check(const Region&);

}  // namespace beadwork::packing
