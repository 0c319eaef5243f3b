#pragma once
// Normals of the contacts of an interface when they are bonded: of the plane that it lies in, or radial from the axis
// of a fibre. They point from the first set of `between` to the second. docs/theory/cohesive-contact.md

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "core/base/failure.hpp"
#include "core/domain/domain.hpp"
#include "core/domain/neighbours.hpp"
#include "core/mechanics/spread.hpp"
#include "core/plugin/plugin.hpp"

namespace beadwork {

/// A contact when it is bonded.
struct Meeting {
  Index first, second;  ///< elements
  Vec3 point;           ///< of contact
  Vec3 apart;           ///< from the first element to the second
  int order;            ///< 1: the first element is of the first set, -1: the second is, 0: both are of both sets
};

struct Axis {
  Vec3 point, direction;
};

/// For each element that lies in a row with its neighbours: the way of the row; else zero.
inline std::vector<Vec3> directions_along(std::span<const Index> fibre, const PairList& neighbours,
                                          const View<const Vec3>& position, Index elements) {
  constexpr Real straight = 0.1;  // rms distance of neighbours from the line through them over that along it, at most
  std::vector<std::vector<Vec3>> around(static_cast<std::size_t>(elements));
  for (const Index row : fibre) around[static_cast<std::size_t>(row)] = {position[row]};
  for (const auto& [first, second] : neighbours) {
    around[static_cast<std::size_t>(first)].push_back(position[second]);
    around[static_cast<std::size_t>(second)].push_back(position[first]);
  }
  std::vector<Vec3> directions(around.size(), Vec3::Zero());
  for (std::size_t k = 0; k < around.size(); ++k) {
    if (around[k].size() < 2) continue;
    const Spread spread = spread_of(around[k]);
    if (spread.rms[1] <= straight * spread.rms[2]) directions[k] = spread.direction[2];
  }
  return directions;
}

/// How far the lines of centres of contacts lie off what they should be along (rms).
struct Tilt {
  Real degrees = 0;
  bool at_fibres = false;  ///< off the radii of the fibres of the first set; else off the one direction that they share
};

inline Tilt tilt_of_lines(const Domain& domain, const BondTable& table, const std::string& first_set) {
  constexpr Real degree = std::numbers::pi / 180;
  const auto position = domain.elements().column("position").view<Vec3>();
  const auto line = [&](Index row) {
    return Vec3((position[table.second()[row]] - position[table.first()[row]]).normalized());
  };
  const auto listed = domain.pairs().find(first_set);
  if (listed == domain.pairs().end()) {
    Mat3 mean = Mat3::Zero();
    for (Index row = 0; row < table.size(); ++row)
      mean += line(row) * line(row).transpose() / static_cast<Real>(table.size());
    const Real along = Eigen::SelfAdjointEigenSolver<Mat3>(mean, Eigen::EigenvaluesOnly).eigenvalues()[2];
    return {std::acos(std::sqrt(std::clamp(along, Real(0), Real(1)))) / degree, false};
  }
  const auto directions = directions_along(domain.set(first_set), listed->second, position, domain.size());
  Real sum = 0, counted = 0;
  for (Index row = 0; row < table.size(); ++row)
    for (const Index end : {table.first()[row], table.second()[row]}) {
      const Vec3& direction = directions[static_cast<std::size_t>(end)];
      if (direction.isZero()) continue;  // the other set's, or a single element
      sum += std::pow(line(row).dot(direction), 2);
      counted += 1;
    }
  return {std::asin(std::sqrt(std::min<Real>(1, counted > 0 ? sum / counted : 0))) / degree, true};
}

class InterfaceNormals {
 public:
  /// `at` is the place in the deck that complaints name.
  InterfaceNormals(std::vector<Meeting> meetings, Location at) : meetings_(std::move(meetings)), at_(std::move(at)) {}

  /// Of a plane with this normal, of either sign; of the plane of least squares through the points of contact where
  /// none is given.
  std::vector<Vec3> of_plane(const std::optional<Vec3>& given) {
    const Vec3 normal = given ? Vec3(given->normalized()) : fitted();
    return turned_to_second(std::vector<Vec3>(meetings_.size(), normal));
  }

  /// Away from an axis.
  std::vector<Vec3> of_axis(const Axis& axis) {
    return radial([&](const Meeting&) { return axis; });
  }

  /// Away from the fibres that are rows of elements of the first set: each goes, at an element, where its neighbours
  /// lie: those that its filling listed, else those that it touches.
  std::vector<Vec3> of_fibres(const Domain& domain, const std::string& set) {
    const auto position = domain.elements().column("position").view<Vec3>();
    const auto radius = domain.elements().column("radius").view<Real>();
    const auto listed = domain.pairs().find(set);
    const Set& fibre = domain.set(set);
    const std::vector<Vec3> directions =
        directions_along(fibre, listed == domain.pairs().end() ? touching(fibre, position, radius) : listed->second,
                         position, domain.size());
    return radial([&](const Meeting& m) {
      if (m.order == 0)
        refuse(at_, "rows of elements give an axis only between two sets: the fibres first, then what is around them");
      const Index element = m.order > 0 ? m.first : m.second;
      const Vec3& direction = directions[static_cast<std::size_t>(element)];
      if (direction.isZero())
        refuse(at_, fmt::format("element {} of the first set of 'between' does not lie in a row with its neighbours of "
                                "that set: name the fibre's set first, or give 'axis-point' and 'axis-direction'",
                                element));
      return Axis{position[element], direction};
    });
  }

  /// In words, for the log.
  const std::string& remark() const { return remark_; }

 private:
  static constexpr Real thin = 0.3;        // a plane's rms thickness over its smaller rms width, at most
  static constexpr Real one_sided = 0.05;  // mean of n.d over mean of |d|, at least

  Vec3 fitted() {
    std::vector<Vec3> points;
    for (const Meeting& m : meetings_) points.push_back(m.point);
    const Spread spread = spread_of(points);
    if (points.size() < 3 || !(spread.rms[1] > 1e-6 * spread.rms[2]) || !(spread.rms[0] <= thin * spread.rms[1]))
      refuse(at_, fmt::format("no plane follows from the points of contact ({}), which spread {:.3g}, {:.3g} and "
                              "{:.3g} m along three directions: give 'plane-normal'",
                              points.size(), spread.rms[2], spread.rms[1], spread.rms[0]));
    const Vec3& n = spread.direction[0];
    remark_ = fmt::format(", fitted to points of contact that lie {:.3g} m off the plane (rms)", spread.rms[0]);
    return n;
  }

  template <class AxisOf>
  std::vector<Vec3> radial(const AxisOf& axis_of) {
    std::vector<Vec3> normals;
    for (const Meeting& m : meetings_) {
      const Axis axis = axis_of(m);
      const Vec3 arm = m.point - axis.point;
      const Vec3 out = arm - axis.direction * axis.direction.dot(arm);
      if (!(out.norm() > 1e-3 * m.apart.norm()))
        refuse(at_, fmt::format("the contact of elements {} and {} lies on the axis, which gives it no radius: leave "
                                "it out with 'where'",
                                m.first, m.second));
      normals.push_back(out.normalized());
    }
    return turned_to_second(std::move(normals));
  }

  /// Given normals that all point to one side of the interface: each from its first element to its second.
  std::vector<Vec3> turned_to_second(std::vector<Vec3> normals) {
    Real side = 0, distance = 0;
    for (std::size_t k = 0; k < meetings_.size(); ++k) {
      const Meeting& m = meetings_[k];
      side += m.order * normals[k].dot(m.apart);
      distance += std::abs(m.order) * m.apart.norm();
    }
    if (distance > 0 && !(std::abs(side) >= one_sided * distance))
      refuse(at_, "the two sets do not lie on the two sides of the interface that its normal gives");
    for (std::size_t k = 0; k < meetings_.size(); ++k) {
      const Meeting& m = meetings_[k];
      const Real across = normals[k].dot(m.apart);
      if (m.order == 0 && !(std::abs(across) > 1e-3 * m.apart.norm()))
        refuse(at_, fmt::format("elements {} and {} are of both sets, and neither lies before the other along the "
                                "normal: name two sets that have no element in common",
                                m.first, m.second));
      if ((m.order == 0 ? across : m.order * side) < 0) normals[k] = -normals[k];
    }
    say_tilt(normals);
    return normals;
  }

  void say_tilt(const std::vector<Vec3>& normals) {
    Real least = 1;
    for (std::size_t k = 0; k < meetings_.size(); ++k)
      least = std::min(least, normals[k].dot(meetings_[k].apart) / meetings_[k].apart.norm());
    remark_ += fmt::format("; lines of centres are up to {:.0f} deg from their normal",
                           std::acos(std::clamp(least, Real(-1), Real(1))) * 180 / std::numbers::pi);
  }

  static PairList touching(std::span<const Index> fibre, const View<const Vec3>& position,
                           const View<const Real>& radius) {
    std::vector<Vec3> place;
    std::vector<Real> size;
    for (const Index row : fibre) {
      place.push_back(position[row]);
      size.push_back(radius[row]);
    }
    PairList pairs;
    for (const Pair& near : find_pairs(place, size, 1e-3))
      pairs.emplace_back(fibre[static_cast<std::size_t>(near.i)], fibre[static_cast<std::size_t>(near.j)]);
    return pairs;
  }

  std::vector<Meeting> meetings_;
  Location at_;
  std::string remark_;
};

}  // namespace beadwork
