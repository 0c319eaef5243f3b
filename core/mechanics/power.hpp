#pragma once
// Powers of numbers in [0, 1], by roots, products and a short series: the power of a library may pick other bits on
// another processor, and does not take packs.

#include <array>

#include "core/mechanics/lane.hpp"

namespace beadwork {

/// x^p for 0 <= x <= 1, to 1e-13; 0 below x = 1e-16, where nobody sees the difference for p of about 1.
class UnitPower {
 public:
  /// Any p > 0; its whole part costs a product for each 1.
  explicit UnitPower(Real p = 1) {
    whole_ = static_cast<int>(p);
    const Real scaled = (p - whole_) * (1 << halvings);
    halves_ = static_cast<int>(scaled);
    const Real rest = scaled - halves_;
    series_[0] = 1;
    for (int n = 1; n < terms; ++n)
      series_[static_cast<std::size_t>(n)] = series_[static_cast<std::size_t>(n - 1)] * (rest - n + 1) / n;
    fraction_ = p != whole_;
  }

  template <class T>
  [[gnu::always_inline]] T operator()(const T& x) const {
    T power(1);
    for (int k = 0; k < whole_; ++k) power = power * x;
    if (fraction_) power = power * fraction(max(x, T(least)));
    return select(x < T(least), T(0), power);
  }

 private:
  static constexpr int halvings = 11;  // x^(2^-11) lies within .018 of 1
  static constexpr int terms = 8;
  static constexpr Real least = 1e-16;

  /// x to the binary fraction of p: its bits pick among the repeated roots of x, the rest is the series of (1 +
  /// z)^rest.
  template <class T>
  [[gnu::always_inline]] T fraction(const T& x) const {
    T root = x, power(1);
    for (int k = halvings - 1; k >= 0; --k) {
      root = sqrt(root);
      if (halves_ >> k & 1) power = power * root;
    }
    const T z = root - T(1);
    T sum(series_[terms - 1]);
    for (int n = terms - 2; n >= 0; --n) sum = sum * z + T(series_[static_cast<std::size_t>(n)]);
    return power * sum;
  }

  std::array<Real, terms> series_;
  int whole_, halves_;
  bool fraction_;
};

}  // namespace beadwork
