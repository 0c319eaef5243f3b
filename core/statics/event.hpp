#pragma once
// Where, on the way of an increment, something comes to its threshold.

#include "core/base/types.hpp"

namespace beadwork {

/// Narrows down the load at which a utilisation comes to a threshold of 1, by false position (Illinois): exact in one
/// round where it grows in a straight line. Where it jumps that line leads nowhere, and the interval is cut in half.
class EventSearch {
 public:
  /// By then it has found a jump, of any height.
  static constexpr int most_rounds = 60;

  /// At the start of the increment (share 0) it is `before` < 1, at its end (share 1) `after` > 1 + within.
  EventSearch(Real before, Real after, Real within) : within_(within), f_low_(before - aim()), f_high_(after - aim()) {}

  /// The share of the increment to be tried next.
  Real next() const {
    if (rounds_ >= patience) return 0.5 * (low_ + high_);
    return low_ + (high_ - low_) * f_low_ / (f_low_ - f_high_);
  }
  /// What was found there; true once that is near enough.
  bool take(Real share, Real utilisation) {
    if (utilisation >= 1 && utilisation <= 1 + within_) return true;
    ++rounds_;
    const Real f = utilisation - aim();
    if (f < 0) {
      low_ = share, f_low_ = f;
      if (side_ < 0) f_high_ *= 0.5;
      side_ = -1;
    } else {
      high_ = share, f_high_ = f;
      if (side_ > 0) f_low_ *= 0.5;
      side_ = 1;
    }
    return utilisation >= 1 && high_ - low_ < 1e-12;  // it jumps
  }

 private:
  static constexpr int patience = 12;  // of false position; a curve takes fewer
  Real aim() const { return 1 + 0.5 * within_; }
  Real within_;
  Real low_ = 0, high_ = 1, f_low_, f_high_;
  int side_ = 0, rounds_ = 0;
};

}  // namespace beadwork
