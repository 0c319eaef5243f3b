#pragma once
// How far loads go from one equilibrium to the next: as far as the deck says, less where that was too much.

#include <algorithm>
#include <optional>
#include <span>

#include "core/domain/constraint.hpp"

namespace beadwork {

/// The time after `now` at which something that is pulled has come `displacement` further [s]; nothing where it never
/// does.
std::optional<Real> time_of_displacement(std::span<const Constraint> constraints, Real now, Real displacement);

/// The share of the whole increment that is tried: cut in half where no equilibrium was found, and grown again.
class IncrementShare {
 public:
  /// `kept`: where the share is remembered; `smallest`: below this it is of no use to cut it.
  IncrementShare(Real& kept, Real smallest) : share_(kept), smallest_(smallest) {}

  Real share() const { return share_; }
  /// False: it is as small as it may be already.
  bool cut() {
    if (share_ <= smallest_) return false;
    share_ = std::max(smallest_, share_ / 2);
    return true;
  }
  /// After so many iterations of so many that are allowed.
  void grow(int iterations, int allowed) {
    if (iterations <= allowed / 2) share_ = std::min<Real>(1, 2 * share_);
  }

 private:
  Real& share_;
  Real smallest_;
};

}  // namespace beadwork
