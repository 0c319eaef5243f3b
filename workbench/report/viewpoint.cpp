#include "workbench/report/viewpoint.hpp"

#include <algorithm>
#include <cmath>

namespace beadwork::report {

namespace {

// Fewer broken bonds than this lie in a plane, or nearly, by chance.
constexpr std::size_t fewest_of_a_crack = 8;
// Of a crack: scatter of its bonds across it, over that of bonds spread evenly over the specimen.
constexpr Real thin = 0.35;

bool finite(const Vec3& v) { return std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z()); }

template <class Place>
Box box_of(const record::Frame& frame, const Place& place) {
  Box box{Vec3::Constant(1e300), Vec3::Constant(-1e300)};
  for (std::size_t i = 0; i < frame.position.size(); ++i) {
    const Vec3 p = place(i);
    if (!finite(p) || !(frame.radius[i] > 0)) continue;  // walls may stand far off
    box.low = box.low.cwiseMin(p - Vec3::Constant(frame.radius[i]));
    box.high = box.high.cwiseMax(p + Vec3::Constant(frame.radius[i]));
  }
  if (box.low.x() > box.high.x()) return {Vec3::Zero(), Vec3::Ones()};
  return box;
}

int largest_axis(const Vec3& v) { return v.x() >= v.y() && v.x() >= v.z() ? 0 : v.y() >= v.z() ? 1 : 2; }
int smallest_axis(const Vec3& v) { return largest_axis(-v); }

/// Of the two axes in a plane, the one along which the specimen is shorter.
int shorter_axis_in_plane(int normal, const Vec3& size) {
  const int a = (normal + 1) % 3, b = (normal + 2) % 3;
  return size[a] < size[b] ? a : b;
}

/// The normal of the plane in which the bonds lie; -1 if they lie in none.
int normal_of_crack(const Weak& weak, const Vec3& size) {
  if (weak.count < fewest_of_a_crack) return -1;
  const Vec3 even = size / std::sqrt(12.0);  // standard deviation of places that are spread evenly
  const Vec3 share = weak.scatter.cwiseQuotient(even.cwiseMax(1e-300));
  const int normal = smallest_axis(share);
  return share[normal] < thin ? normal : -1;
}

}  // namespace

Vec3 at_rest(const record::Frame& frame, std::size_t i) {
  return frame.displacement.empty() ? frame.position[i] : Vec3(frame.position[i] - frame.displacement[i]);
}

Vec3 magnified(const record::Frame& frame, std::size_t i, Real factor) {
  return frame.displacement.empty() ? frame.position[i]
                                    : Vec3(frame.position[i] + (factor - 1) * frame.displacement[i]);
}

Box box_at_rest(const record::Frame& frame) {
  return box_of(frame, [&](std::size_t i) { return at_rest(frame, i); });
}

Box box_magnified(const record::Frame& frame, Real factor) {
  return box_of(frame, [&](std::size_t i) { return magnified(frame, i, factor); });
}

Weak weak_bonds(const record::Frame& frame, const std::vector<std::string>& interfaces) {
  Weak weak;
  weak.is_interface = !interfaces.empty();
  Vec3 mean = Vec3::Zero(), square = Vec3::Zero();
  for (const record::Bonds& bonds : frame.bonds) {
    const bool of_interface = std::find(interfaces.begin(), interfaces.end(), bonds.family) != interfaces.end();
    if (weak.is_interface && !of_interface) continue;
    for (std::size_t b = 0; b < bonds.ends.size(); ++b) {
      if (!weak.is_interface && bonds.state[b] == State::intact) continue;
      const Vec3 first = at_rest(frame, static_cast<std::size_t>(bonds.ends[b][0]));
      const Vec3 second = at_rest(frame, static_cast<std::size_t>(bonds.ends[b][1]));
      const Vec3 along = second - first, place = 0.5 * (first + second);
      const Real length = along.squaredNorm();
      if (!(length > 0) || !std::isfinite(length)) continue;
      weak.direction += along.cwiseProduct(along) / length;
      mean += place;
      square += place.cwiseProduct(place);
      ++weak.count;
    }
  }
  if (weak.count == 0) return weak;
  const auto count = static_cast<Real>(weak.count);
  weak.direction /= count;
  mean /= count;
  weak.scatter = (square / count - mean.cwiseProduct(mean)).cwiseMax(0).cwiseSqrt();
  return weak;
}

Viewpoint choose_viewpoint(const Weak& weak, const Vec3& size, const std::string& wanted) {
  const bool any = weak.count > 0;
  if (!wanted.empty()) {
    const int axis = wanted[0] - 'x';
    return {axis, any ? axis : -1, "seen along " + wanted};
  }
  const int broad = smallest_axis(size);
  if (!any) return {broad, -1, "the specimen"};
  if (!weak.is_interface) {
    const int normal = normal_of_crack(weak, size);
    if (normal < 0) return {broad, broad, "broadest face"};
    return {shorter_axis_in_plane(normal, size), normal, "side view"};
  }
  const int normal = largest_axis(weak.direction), least = smallest_axis(weak.direction);
  const Real middle = weak.direction.sum() - weak.direction[normal] - weak.direction[least];
  if (weak.direction[normal] - middle > middle - weak.direction[least])
    return {shorter_axis_in_plane(normal, size), normal, "side view"};
  return {least, (least + 1) % 3, "face view"};
}

Camera camera_along(int axis, const Box& box, Real margin) {
  const Vec3 size = box.size();
  int right = (axis + 1) % 3, up = (axis + 2) % 3;
  const bool alike = std::abs(size[right] - size[up]) < 0.2 * std::max(size[right], size[up]);
  if (alike ? up < right : size[up] > size[right]) std::swap(right, up);
  Camera camera;
  camera.right = Vec3::Unit(right);
  camera.up = Vec3::Unit(up);
  camera.centre = 0.5 * (box.low + box.high);
  camera.width = size[right] + 2 * margin;
  camera.height = size[up] + 2 * margin;
  return camera;
}

std::string orientation(const Camera& camera) {
  const auto letter = [](const Vec3& direction) { return std::string(1, "xyz"[largest_axis(direction.cwiseAbs())]); };
  return letter(camera.right) + " to the right, " + letter(camera.up) + " up";
}

}  // namespace beadwork::report
