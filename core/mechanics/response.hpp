#pragma once
// A quantity that was measured at some values of another, to be read between them and backwards: which radius ratio
// gives this Poisson's ratio?

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "core/base/types.hpp"

namespace beadwork {

/// Cubic between the points, with slopes that keep what rises or falls from point to point rising or falling.
/// Fritsch and Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300
class Response {
 public:
  void note(Real at, Real value) { points_[at] = value; }
  bool is_empty() const { return points_.empty(); }
  const std::map<Real, Real>& points() const { return points_; }

  struct Span {
    Real low, high;
  };
  /// Of the values that were measured.
  Span range() const {
    Span span{points_.begin()->second, points_.begin()->second};
    for (const auto& [at, value] : points_) span = {std::min(span.low, value), std::max(span.high, value)};
    return span;
  }

  /// The value at `at`; beyond the first or the last point that of this point.
  Real at(Real where) const {
    const auto right = points_.lower_bound(where);
    if (right == points_.begin()) return right->second;
    if (right == points_.end()) return points_.rbegin()->second;
    const auto left = std::prev(right);
    const Real h = right->first - left->first, t = (where - left->first) / h;
    const Real m0 = slope(left), m1 = slope(right);
    return left->second + t * h * m0 +
           t * t *
               (3 * (right->second - left->second) - h * (2 * m0 + m1) +
                t * (2 * (left->second - right->second) + h * (m0 + m1)));
  }

  /// Where the value is reached: between the first two points, from the left, that have it between them. Nothing if no
  /// two have.
  std::optional<Real> where(Real value) const {
    if (points_.size() == 1 && points_.begin()->second == value) return points_.begin()->first;
    for (auto left = points_.begin(), right = std::next(left); !points_.empty() && right != points_.end();
         ++left, ++right)
      if ((left->second - value) * (right->second - value) <= 0) return halved(left->first, right->first, value);
    return std::nullopt;
  }

 private:
  using Point = std::map<Real, Real>::const_iterator;

  static Real secant(Point a, Point b) { return (b->second - a->second) / (b->first - a->first); }

  // The harmonic mean of the slopes on both sides; 0 where they differ in sign.
  Real slope(Point p) const {
    const bool is_first = p == points_.begin(), is_last = std::next(p) == points_.end();
    if (is_first && is_last) return 0;
    if (is_first) return secant(p, std::next(p));
    if (is_last) return secant(std::prev(p), p);
    const Real before = secant(std::prev(p), p), behind = secant(p, std::next(p));
    if (before * behind <= 0) return 0;
    const Real h0 = p->first - std::prev(p)->first, h1 = std::next(p)->first - p->first;
    const Real weight = (h0 + 2 * h1) / (3 * (h0 + h1));
    return before * behind / (weight * behind + (1 - weight) * before);
  }

  Real halved(Real low, Real high, Real value) const {
    constexpr int enough = 100;
    const bool rises = at(high) >= at(low);
    for (int k = 0; k < enough && low < high; ++k) {
      const Real middle = 0.5 * (low + high);
      ((at(middle) < value) == rises ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

  std::map<Real, Real> points_;
};

/// Mean and scatter of what several samples gave.
struct Scatter {
  Real mean = 0;
  Real deviation = 0;  ///< standard deviation of a sample; 0 of a single one
};
inline Scatter scatter_of(const std::vector<Real>& values) {
  Scatter spread;
  const auto count = static_cast<Real>(values.size());
  for (const Real value : values) spread.mean += value / count;
  if (values.size() < 2) return spread;
  for (const Real value : values) spread.deviation += (value - spread.mean) * (value - spread.mean) / (count - 1);
  spread.deviation = std::sqrt(spread.deviation);
  return spread;
}

}  // namespace beadwork
