#pragma once
// Anderson's acceleration: of an iteration with a stiffness that is kept, the last few steps tell how the true one
// differs, so that it converges nearly as one with a new stiffness does.        docs/theory/statics.md

#include <Eigen/QR>
#include <vector>

#include "core/statics/symmetric_matrix.hpp"

namespace beadwork {

class Acceleration {
 public:
  void forget() { steps_.clear(), changes_.clear(), last_.resize(0); }

  /// The step to be made where the kept stiffness alone would make `correction`.
  Vector step(const Vector& correction) {
    if (last_.size() > 0) {
      changes_.push_back(correction - last_);
      if (changes_.size() > memory) changes_.erase(changes_.begin()), steps_.erase(steps_.begin());
    }
    last_ = correction;
    Vector step = correction;
    if (!changes_.empty()) {
      const auto count = static_cast<Eigen::Index>(changes_.size());
      Eigen::MatrixXd seen(correction.size(), count);
      for (Eigen::Index a = 0; a < count; ++a) seen.col(a) = change(a);
      Eigen::ColPivHouseholderQR<Eigen::MatrixXd> fit;
      fit.setThreshold(1e-10);  // steps that say the same count once
      const Vector share = fit.compute(seen).solve(correction);
      for (Eigen::Index a = 0; a < count; ++a) step -= share[a] * (steps_[static_cast<std::size_t>(a)] + change(a));
    }
    steps_.push_back(step);
    return step;
  }

 private:
  static constexpr std::size_t memory = 8;
  const Vector& change(Eigen::Index k) const { return changes_[static_cast<std::size_t>(k)]; }

  std::vector<Vector> steps_, changes_;  ///< what was moved, and what the correction changed by it
  Vector last_;
};

}  // namespace beadwork
