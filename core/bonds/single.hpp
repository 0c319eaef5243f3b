#pragma once
// Bonds at hand whose forces are found in single precision: columns, and how the ends lie against each other, are
// narrowed, forces are widened (docs/decisions/mixed-precision.md). The laws that can are beams.

#include "core/bonds/ends.hpp"
#include "core/mechanics/beam.hpp"

namespace beadwork {

template <class Law>
constexpr bool has_shift() {
  return requires(const Law& law, const One& at, const EndsOf<Law, Real>& ends) { law.shift(at, ends); };
}

/// One bond, and as many as two packs hold, in single precision. Columns stay in double.
struct OneSingle {
  using Number = float;
  One one;

  [[gnu::always_inline]] float operator()(const View<const Real>& column) const {
    return static_cast<float>(one(column));
  }
  [[gnu::always_inline]] Vec<float> operator()(const View<const Vec3>& column) const {
    return one(column).cast<float>();
  }
  [[gnu::always_inline]] void store(const View<Real>& column, float value) const { one.store(column, value); }
  [[gnu::always_inline]] void flag(bool mask) const { one.flag(mask); }
};
template <int W>
struct SeveralSingle {
  using Number = Pack<2 * W, float>;
  Several<W> low, high;

  [[gnu::always_inline]] Number operator()(const View<const Real>& column) const {
    return pack::narrow(low(column), high(column));
  }
  [[gnu::always_inline]] Vec<Number> operator()(const View<const Vec3>& column) const {
    const Vec<Pack<W>> a = low(column), b = high(column);
    return {pack::narrow(a[0], b[0]), pack::narrow(a[1], b[1]), pack::narrow(a[2], b[2])};
  }
  [[gnu::always_inline]] void store(const View<Real>& column, const Number& value) const {
    low.store(column, pack::widen<false>(value));
    high.store(column, pack::widen<true>(value));
  }
  template <class M>
  [[gnu::always_inline]] void flag(const M& mask) const {
    low.flag(mask);
  }
};

[[gnu::always_inline]] inline BeamShift<float> narrow(const BeamShift<Real>& s) {
  return {s.moved.cast<float>(),
          static_cast<float>(s.grown),
          s.normal.cast<float>(),
          {static_cast<float>(s.turn.w), s.turn.v.cast<float>()}};
}
template <int W>
[[gnu::always_inline]] inline BeamShift<Pack<2 * W, float>> narrow(const BeamShift<Pack<W>>& a,
                                                                   const BeamShift<Pack<W>>& b) {
  const auto vector = [](const Vec<Pack<W>>& u, const Vec<Pack<W>>& v) __attribute__((always_inline)) {
    return Vec<Pack<2 * W, float>>{pack::narrow(u[0], v[0]), pack::narrow(u[1], v[1]), pack::narrow(u[2], v[2])};
  };
  return {vector(a.moved, b.moved),
          pack::narrow(a.grown, b.grown),
          vector(a.normal, b.normal),
          {pack::narrow(a.turn.w, b.turn.w), vector(a.turn.v, b.turn.v)}};
}
inline Wrench<Real> widen(const Wrench<float>& w) {
  return {w.force.cast<Real>(), w.torque1.cast<Real>(), w.torque2.cast<Real>()};
}
template <bool upper, int W>
[[gnu::always_inline]] inline Wrench<Pack<W / 2>> widen(const Wrench<Pack<W, float>>& w) {
  const auto vector = [](const Vec<Pack<W, float>>& u) __attribute__((always_inline)) {
    return Vec<Pack<W / 2>>{pack::widen<upper>(u[0]), pack::widen<upper>(u[1]), pack::widen<upper>(u[2])};
  };
  return {vector(w.force), vector(w.torque1), vector(w.torque2)};
}

/// Numbers that single precision cannot hold with all their digits are zero while this lives: squares of small turns
/// are such, and processors are slow with them.
class FlushTiny {
#if defined(__SSE2__)
 public:
  FlushTiny() : before_(_mm_getcsr()) { _mm_setcsr(before_ | 0x8040); }
  ~FlushTiny() { _mm_setcsr(before_); }
  FlushTiny(const FlushTiny&) = delete;
  FlushTiny& operator=(const FlushTiny&) = delete;

 private:
  unsigned before_;
#endif
};

}  // namespace beadwork
