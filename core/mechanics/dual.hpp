#pragma once
// A number with its slopes against N coordinates: whatever is computed with it is differentiated on the way, exactly. So a
// law that is written for a number type T gives its own derivative.

#include <array>
#include <cmath>

#include "core/mechanics/lane.hpp"

namespace beadwork {

template <int N>
struct Dual {
  Real value = 0;
  std::array<Real, N> slope{};

  Dual() = default;
  Dual(Real number) : value(number) {}  // a constant: implicit, as laws mix plain numbers with T
  /// Coordinate `k` itself.
  static Dual coordinate(Real number, int k) {
    Dual x(number);
    x.slope[static_cast<std::size_t>(k)] = 1;
    return x;
  }

  /// f, whose slope is `by` times this one's.
  [[gnu::always_inline]] Dual chain(Real f, Real by) const {
    Dual result(f);
    for (std::size_t k = 0; k < N; ++k) result.slope[k] = by * slope[k];
    return result;
  }
  [[gnu::always_inline]] friend Dual combine(Real f, const Dual& a, Real by_a, const Dual& b, Real by_b) {
    Dual result(f);
    for (std::size_t k = 0; k < N; ++k) result.slope[k] = by_a * a.slope[k] + by_b * b.slope[k];
    return result;
  }

  friend Dual operator+(const Dual& a, const Dual& b) { return combine(a.value + b.value, a, 1, b, 1); }
  friend Dual operator-(const Dual& a, const Dual& b) { return combine(a.value - b.value, a, 1, b, -1); }
  friend Dual operator*(const Dual& a, const Dual& b) { return combine(a.value * b.value, a, b.value, b, a.value); }
  friend Dual operator/(const Dual& a, const Dual& b) {
    return combine(a.value / b.value, a, 1 / b.value, b, -a.value / (b.value * b.value));
  }
  friend Dual operator-(const Dual& a) { return a.chain(-a.value, -1); }
  friend bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
  friend bool operator>(const Dual& a, const Dual& b) { return a.value > b.value; }
  friend bool operator<=(const Dual& a, const Dual& b) { return a.value <= b.value; }
  friend bool operator>=(const Dual& a, const Dual& b) { return a.value >= b.value; }

  friend Dual min(const Dual& a, const Dual& b) { return b < a ? b : a; }
  friend Dual max(const Dual& a, const Dual& b) { return a < b ? b : a; }
  friend Dual select(bool mask, const Dual& a, const Dual& b) { return mask ? a : b; }
  /// At 0 the slope is told as 0: a length that vanishes has none, and laws choose another way there.
  friend Dual sqrt(const Dual& a) {
    const Real root = std::sqrt(a.value);
    return a.chain(root, root > 0 ? 0.5 / root : 0);
  }
};

}  // namespace beadwork

namespace Eigen {
template <int N>
struct NumTraits<beadwork::Dual<N>> : GenericNumTraits<beadwork::Dual<N>> {
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = N,
    AddCost = N,
    MulCost = 2 * N
  };
};
}  // namespace Eigen
