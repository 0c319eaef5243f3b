#include "core/packing/region.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace beadwork::packing {
namespace {

constexpr Real pi = std::numbers::pi;

Vec3 axis_of(const Cylinder& c) { return (c.to - c.from).normalized(); }

/// Two directions that complete an axis to a right-handed frame.
Mat3 frame_of(const Vec3& axis) {
  int smallest = 0;
  axis.cwiseAbs().minCoeff(&smallest);
  Mat3 frame;
  frame.col(0) = axis.cross(Vec3::Unit(smallest)).normalized();
  frame.col(1) = axis.cross(frame.col(0));
  frame.col(2) = axis;
  return frame;
}

void check(const Box& b) {
  if (!b.low.allFinite() || !b.high.allFinite() || !((b.high - b.low).minCoeff() > 0))
    throw std::invalid_argument("the box to be filled is empty: each of its three extents must be positive, got " +
                                describe(b));
}

void check(const Cylinder& c) {
  if (!c.from.allFinite() || !c.to.allFinite() || !std::isfinite(c.radius) || !(c.radius > 0) ||
      !((c.to - c.from).norm() > 0))
    throw std::invalid_argument("the cylinder to be filled is empty: its length and radius must be positive, got " +
                                describe(c));
}

}  // namespace

Walls::Walls(const Region& region) {
  if (const auto* box = std::get_if<Box>(&region)) {
    for (int a = 0; a < 3; ++a) {
      planes_.push_back({Vec3::Unit(a), box->low[a]});
      planes_.push_back({-Vec3::Unit(a), -box->high[a]});
    }
  } else {
    const auto& c = std::get<Cylinder>(region);
    const Vec3 axis = axis_of(c);
    planes_.push_back({axis, axis.dot(c.from)});
    planes_.push_back({-axis, -axis.dot(c.to)});
    tube_ = Tube{c.from, axis, c.radius};
  }
}

WallView Walls::tube_view(const Tube& t, const Vec3& x) {
  const Vec3 arm = x - t.point;
  const Vec3 across = arm - t.axis.dot(arm) * t.axis;
  const Real r = across.norm();
  // On the axis every direction is as good: the wall is as far as it can be.
  return {t.radius - r, r > 0 ? Vec3(-across / r) : zero<Vec3>()};
}

Real Walls::distance(const Vec3& x) const {
  Real nearest = std::numeric_limits<Real>::infinity();
  for (std::size_t w = 0; w < size(); ++w) nearest = std::min(nearest, view(w, x).distance);
  return nearest;
}

Real volume(const Region& region) {
  if (const auto* box = std::get_if<Box>(&region)) return (box->high - box->low).prod();
  const auto& c = std::get<Cylinder>(region);
  return pi * c.radius * c.radius * (c.to - c.from).norm();
}

Real inradius(const Region& region) {
  if (const auto* box = std::get_if<Box>(&region)) return (box->high - box->low).minCoeff() / 2;
  const auto& c = std::get<Cylinder>(region);
  return std::min(c.radius, (c.to - c.from).norm() / 2);
}

Vec3 point_in(const Region& region, const Vec3& unit, Real margin) {
  if (const auto* box = std::get_if<Box>(&region)) {
    const Vec3 m = Vec3::Constant(margin);
    return box->low + m + (box->high - box->low - 2 * m).cwiseProduct(unit);
  }
  const auto& c = std::get<Cylinder>(region);
  const Mat3 frame = frame_of(axis_of(c));
  const Real r = (c.radius - margin) * std::sqrt(unit[0]);
  const Real angle = 2 * pi * unit[1];
  const Real along = margin + ((c.to - c.from).norm() - 2 * margin) * unit[2];
  return c.from + r * std::cos(angle) * frame.col(0) + r * std::sin(angle) * frame.col(1) + along * frame.col(2);
}

Region shrunk(const Region& region, Real margin) {
  if (const auto* box = std::get_if<Box>(&region)) {
    const Vec3 m = Vec3::Constant(margin);
    return Box{box->low + m, box->high - m};
  }
  const auto& c = std::get<Cylinder>(region);
  const Vec3 m = margin * axis_of(c);
  return Cylinder{c.from + m, c.to - m, c.radius - margin};
}

Region rescaled(const Region& region, const Vec3& origin, Real unit) {
  if (const auto* box = std::get_if<Box>(&region)) return Box{(box->low - origin) / unit, (box->high - origin) / unit};
  const auto& c = std::get<Cylinder>(region);
  return Cylinder{(c.from - origin) / unit, (c.to - origin) / unit, c.radius / unit};
}

Vec3 centre(const Region& region) {
  if (const auto* box = std::get_if<Box>(&region)) return (box->low + box->high) / 2;
  const auto& c = std::get<Cylinder>(region);
  return (c.from + c.to) / 2;
}

Box bounds(const Region& region) {
  if (const auto* box = std::get_if<Box>(&region)) return *box;
  const auto& c = std::get<Cylinder>(region);
  const Vec3 axis = axis_of(c);
  // A disc across the axis reaches radius * sin(angle between the axis and the coordinate direction).
  const Vec3 reach = c.radius * (Vec3::Ones() - axis.cwiseProduct(axis)).cwiseMax(0).cwiseSqrt();
  return {c.from.cwiseMin(c.to) - reach, c.from.cwiseMax(c.to) + reach};
}

std::string describe(const Region& region) {
  std::ostringstream out;
  const auto put = [&](const Vec3& v) { out << v[0] << ' ' << v[1] << ' ' << v[2]; };
  if (const auto* box = std::get_if<Box>(&region)) {
    out << "box from ";
    put(box->low);
    out << " to ";
    put(box->high);
  } else {
    const auto& c = std::get<Cylinder>(region);
    out << "cylinder from ";
    put(c.from);
    out << " to ";
    put(c.to);
    out << ", radius " << c.radius;
  }
  return out.str();
}

void check(const Region& region) {
  std::visit([](const auto& r) { check(r); }, region);
  // Beyond these the volumes and moments of inertia of elements are no numbers any more.
  constexpr Real smallest = 1e-50, largest = 1e50;
  // So far away from the origin, places are rounded to more than the overlap that relaxation leaves.
  constexpr Real farthest = 1e6;
  const Box box = bounds(region);
  const Real narrow = inradius(region), wide = (box.high - box.low).maxCoeff();
  if (!(narrow >= smallest && wide <= largest))
    throw std::invalid_argument("the extents of the region to be filled must lie between 1e-50 and 1e50, got " +
                                describe(region));
  const Real away = std::max(box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff());
  if (away > farthest * std::max(narrow, wide))
    throw std::invalid_argument(
        "the region to be filled lies so far from the origin that the places of its elements would be rounded: " +
        describe(region) + "; move it to the origin");
}

}  // namespace beadwork::packing
