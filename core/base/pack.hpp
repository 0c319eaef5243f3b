#pragma once
// Several numbers at once, one of each bond or element in hand: what a law is written over when it runs in a vector
// loop. It does what lane.hpp asks of a number, lane by lane, in the same operations as a scalar: so the bits are the
// same.
//
// Its width is that of the instruction set that the file is compiled for; a plugin library is compiled for several and
// the widest that the processor has is loaded (docs/decisions/instruction-sets.md). Compiled for the baseline,
// `pack_width` is 1 and loops are scalar.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include "core/base/types.hpp"

namespace beadwork {

#if defined(__AVX512F__)
inline constexpr int pack_width = 8;
#elif defined(__AVX2__)
inline constexpr int pack_width = 4;
#else
inline constexpr int pack_width = 1;
#endif

template <int W, class N>
struct Register;
template <>
struct Register<4, double> {
  typedef double Numbers __attribute__((vector_size(32)));
  typedef long long Flags __attribute__((vector_size(32)));
};
template <>
struct Register<8, double> {
  typedef double Numbers __attribute__((vector_size(64)));
  typedef long long Flags __attribute__((vector_size(64)));
};
template <>
struct Register<4, float> {
  typedef float Numbers __attribute__((vector_size(16)));
  typedef std::int32_t Flags __attribute__((vector_size(16)));
};
template <>
struct Register<8, float> {
  typedef float Numbers __attribute__((vector_size(32)));
  typedef std::int32_t Flags __attribute__((vector_size(32)));
};
template <>
struct Register<16, float> {
  typedef float Numbers __attribute__((vector_size(64)));
  typedef std::int32_t Flags __attribute__((vector_size(64)));
};

/// What comparisons of packs give.
template <int W, class N = Real>
struct Mask {
  using Native = typename Register<W, N>::Flags;
  Native m;

  [[gnu::always_inline]] friend Mask operator&&(const Mask& a, const Mask& b) { return {a.m & b.m}; }
  [[gnu::always_inline]] friend Mask operator||(const Mask& a, const Mask& b) { return {a.m | b.m}; }
  [[gnu::always_inline]] friend Mask operator!(const Mask& a) { return {~a.m}; }
};

template <int W, class N>
[[gnu::always_inline]] inline bool any(const Mask<W, N>& mask) {
  long long all = 0;
  for (int k = 0; k < W; ++k) all |= mask.m[k];
  return all != 0;
}
inline bool any(bool mask) { return mask; }

template <int W, class N = Real>
struct Pack {
  using Native = typename Register<W, N>::Numbers;
  static constexpr int width = W;
  Native v;

  Pack() = default;
  [[gnu::always_inline]] Pack(Native native) : v(native) {}
  [[gnu::always_inline]] Pack(Real all)
      : v(static_cast<N>(all) - Native{}) {}  // g++ makes a loop over lanes sixteen masked moves
  [[gnu::always_inline]] static Pack load(const N* from) {
    Pack p;
    std::memcpy(&p.v, from, sizeof(Native));
    return p;
  }
  [[gnu::always_inline]] void store(N* to) const { std::memcpy(to, &v, sizeof(Native)); }

  [[gnu::always_inline]] friend Pack operator+(const Pack& a, const Pack& b) { return {a.v + b.v}; }
  [[gnu::always_inline]] friend Pack operator-(const Pack& a, const Pack& b) { return {a.v - b.v}; }
  [[gnu::always_inline]] friend Pack operator*(const Pack& a, const Pack& b) { return {a.v * b.v}; }
  [[gnu::always_inline]] friend Pack operator/(const Pack& a, const Pack& b) { return {a.v / b.v}; }
  [[gnu::always_inline]] friend Pack operator-(const Pack& a) { return {-a.v}; }
  [[gnu::always_inline]] friend Mask<W, N> operator<(const Pack& a, const Pack& b) { return {a.v < b.v}; }
  [[gnu::always_inline]] friend Mask<W, N> operator>(const Pack& a, const Pack& b) { return {a.v > b.v}; }
  [[gnu::always_inline]] friend Mask<W, N> operator<=(const Pack& a, const Pack& b) { return {a.v <= b.v}; }
  [[gnu::always_inline]] friend Mask<W, N> operator>=(const Pack& a, const Pack& b) { return {a.v >= b.v}; }

  [[gnu::always_inline]] friend Pack select(const Mask<W, N>& mask, const Pack& a, const Pack& b) {
    return {mask.m ? a.v : b.v};
  }
  [[gnu::always_inline]] friend Pack min(const Pack& a, const Pack& b) { return {b.v < a.v ? b.v : a.v}; }
  [[gnu::always_inline]] friend Pack max(const Pack& a, const Pack& b) { return {a.v < b.v ? b.v : a.v}; }
  [[gnu::always_inline]] friend Pack sqrt(const Pack& a) {
#if defined(__AVX512F__)
    if constexpr (W == 16) return {Native(_mm512_maskz_sqrt_ps(0xffff, __m512(a.v)))};
    if constexpr (W == 8 && std::is_same_v<N, double>) return {Native(_mm512_maskz_sqrt_pd(0xff, __m512d(a.v)))};
#endif
#if defined(__AVX2__)
    if constexpr (W == 8 && std::is_same_v<N, float>) return {Native(_mm256_sqrt_ps(__m256(a.v)))};
    if constexpr (W == 4) return {Native(_mm256_sqrt_pd(__m256d(a.v)))};
#endif
    Pack root;
    for (int k = 0; k < W; ++k) root.v[k] = static_cast<N>(__builtin_sqrt(a.v[k]));
    return root;
  }
};

/// Four numbers that lie side by side in memory: half a line of an element.
using Quad = Pack<4>;

namespace pack {

template <int W>
[[gnu::always_inline]] inline Pack<W> join(const Quad& low, const Quad& high) {
  if constexpr (W == 4)
    return low;
  else
    return __builtin_shufflevector(low.v, high.v, 0, 1, 2, 3, 4, 5, 6, 7);
}

/// Numbers 4 part ... 4 part + 3.
template <int W>
[[gnu::always_inline]] inline Quad part(const Pack<W>& p, int which) {
  if constexpr (W == 4)
    return p;
  else if (which == 0)
    return __builtin_shufflevector(p.v, p.v, 0, 1, 2, 3);
  else
    return __builtin_shufflevector(p.v, p.v, 4, 5, 6, 7);
}

/// Within each four lanes: row k becomes column k. Its own inverse.
template <int W>
[[gnu::always_inline]] inline std::array<Pack<W>, 4> transpose(const std::array<Pack<W>, 4>& r) {
  const auto &a = r[0].v, &b = r[1].v, &c = r[2].v, &d = r[3].v;
  if constexpr (W == 4) {
    const auto ab = __builtin_shufflevector(a, b, 0, 4, 2, 6), AB = __builtin_shufflevector(a, b, 1, 5, 3, 7);
    const auto cd = __builtin_shufflevector(c, d, 0, 4, 2, 6), CD = __builtin_shufflevector(c, d, 1, 5, 3, 7);
    return {__builtin_shufflevector(ab, cd, 0, 1, 4, 5), __builtin_shufflevector(AB, CD, 0, 1, 4, 5),
            __builtin_shufflevector(ab, cd, 2, 3, 6, 7), __builtin_shufflevector(AB, CD, 2, 3, 6, 7)};
  } else {
    static_assert(W == 8);
    const auto ab = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
    const auto AB = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
    const auto cd = __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14);
    const auto CD = __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15);
    return {__builtin_shufflevector(ab, cd, 0, 1, 8, 9, 4, 5, 12, 13),
            __builtin_shufflevector(AB, CD, 0, 1, 8, 9, 4, 5, 12, 13),
            __builtin_shufflevector(ab, cd, 2, 3, 10, 11, 6, 7, 14, 15),
            __builtin_shufflevector(AB, CD, 2, 3, 10, 11, 6, 7, 14, 15)};
  }
}

/// The four numbers at address(lane) of each lane, as four packs.
template <int W, class Address>
[[gnu::always_inline]] inline std::array<Pack<W>, 4> fetch(const Address& address) {
  std::array<Pack<W>, 4> rows;
  for (int k = 0; k < 4; ++k) {
    const Quad low = Quad::load(address(k));
    if constexpr (W == 4)
      rows[static_cast<std::size_t>(k)] = low;
    else
      rows[static_cast<std::size_t>(k)] = join<W>(low, Quad::load(address(k + 4)));
  }
  return transpose<W>(rows);
}

/// The lanes of four packs as W rows of four: row `lane` is rows[lane].
template <int W>
[[gnu::always_inline]] inline std::array<Quad, W> rows(const std::array<Pack<W>, 4>& columns) {
  const std::array<Pack<W>, 4> turned = transpose<W>(columns);
  std::array<Quad, W> out;
  for (int k = 0; k < W; ++k)
    out[static_cast<std::size_t>(k)] = part<W>(turned[static_cast<std::size_t>(k % 4)], k / 4);
  return out;
}

/// The lanes of eight packs as eight rows of eight numbers.
template <int W>
[[gnu::always_inline]] inline std::array<Pack<W>, W> rows_of_eight(const std::array<Pack<W>, 8>& c) {
  static_assert(W == 8);
  using V = typename Pack<W>::Native;
  const auto low = [](const Pack<W>& a, const Pack<W>& b) __attribute__((always_inline)) {
    return V(__builtin_shufflevector(a.v, b.v, 0, 8, 2, 10, 4, 12, 6, 14));
  };
  const auto high = [](const Pack<W>& a, const Pack<W>& b) __attribute__((always_inline)) {
    return V(__builtin_shufflevector(a.v, b.v, 1, 9, 3, 11, 5, 13, 7, 15));
  };
  const auto even = [](const V& a, const V& b) __attribute__((always_inline)) {
    return V(__builtin_shufflevector(a, b, 0, 1, 4, 5, 8, 9, 12, 13));
  };
  const auto odd = [](const V& a, const V& b) __attribute__((always_inline)) {
    return V(__builtin_shufflevector(a, b, 2, 3, 6, 7, 10, 11, 14, 15));
  };
  const V a = low(c[0], c[1]), b = low(c[2], c[3]), d = low(c[4], c[5]), e = low(c[6], c[7]);
  const V A = high(c[0], c[1]), B = high(c[2], c[3]), D = high(c[4], c[5]), E = high(c[6], c[7]);
  const V ab = even(a, b), de = even(d, e), ba = odd(a, b), ed = odd(d, e);
  const V AB = even(A, B), DE = even(D, E), BA = odd(A, B), ED = odd(D, E);
  return {even(ab, de), even(AB, DE), even(ba, ed), even(BA, ED), odd(ab, de), odd(AB, DE), odd(ba, ed), odd(BA, ED)};
}

/// Two packs in single precision, and each half of such a one in double.
template <int W>
[[gnu::always_inline]] inline Pack<2 * W, float> narrow(const Pack<W>& low, const Pack<W>& high) {
  using Half = typename Register<W, float>::Numbers;
  const Half a = __builtin_convertvector(low.v, Half), b = __builtin_convertvector(high.v, Half);
  if constexpr (W == 4)
    return {__builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7)};
  else
    return {__builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15)};
}
template <bool upper, int W>
[[gnu::always_inline]] inline Pack<W / 2> widen(const Pack<W, float>& p) {
  using Half = typename Pack<W / 2>::Native;
  if constexpr (W == 8)
    return {upper ? __builtin_convertvector(__builtin_shufflevector(p.v, p.v, 4, 5, 6, 7), Half)
                  : __builtin_convertvector(__builtin_shufflevector(p.v, p.v, 0, 1, 2, 3), Half)};
  else
    return {upper ? __builtin_convertvector(__builtin_shufflevector(p.v, p.v, 8, 9, 10, 11, 12, 13, 14, 15), Half)
                  : __builtin_convertvector(__builtin_shufflevector(p.v, p.v, 0, 1, 2, 3, 4, 5, 6, 7), Half)};
}

}  // namespace pack
}  // namespace beadwork

namespace Eigen {
template <int W, class N>
struct NumTraits<beadwork::Pack<W, N>> : GenericNumTraits<beadwork::Pack<W, N>> {
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 0,
    ReadCost = 1,
    AddCost = 1,
    MulCost = 1
  };
};
}  // namespace Eigen
