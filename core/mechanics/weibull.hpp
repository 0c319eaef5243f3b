#pragma once
// Strength with scatter, as brittle solids have: of the weakest of many flaws. docs/theory/bond-failure.md

#include <cmath>

#include "core/base/types.hpp"

namespace beadwork {

/// Strength over its mean where a share u of all, 0 <= u < 1, is weaker: P(f) = 1 - exp(-(f Gamma(1 + 1/m))^m), m the
/// Weibull modulus.
inline Real weibull_factor(Real modulus, Real u) {
  return std::pow(-std::log1p(-u), 1 / modulus) / std::tgamma(1 + 1 / modulus);
}

}  // namespace beadwork
