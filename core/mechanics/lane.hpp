#pragma once
// What a law may do with its number type T, besides + - * / and comparison: one scalar or a pack of lanes
// (core/base/pack.hpp). A law in the hot loop never branches on a T. It chooses with select(mask, a, b), so that each
// lane may choose differently. Packs bring the same functions in their own namespace, where unqualified calls find
// them.

#include <cmath>
#include <concepts>
#include <type_traits>

#include "core/base/types.hpp"

namespace beadwork {

inline double sqrt(double a) { return std::sqrt(a); }
inline float sqrt(float a) { return std::sqrt(a); }

inline double min(double a, double b) { return b < a ? b : a; }
inline float min(float a, float b) { return b < a ? b : a; }

inline double max(double a, double b) { return a < b ? b : a; }
inline float max(float a, float b) { return a < b ? b : a; }

/// a where the mask holds, else b. Both are computed: neither may trap where it is not chosen.
inline double select(bool mask, double a, double b) { return mask ? a : b; }
inline float select(bool mask, float a, float b) { return mask ? a : b; }

/// An argument that takes no part in the deduction of T, so that vector expressions (x2 - x1) convert to it.
template <class T>
using Same = std::type_identity_t<T>;

template <class T>
[[gnu::always_inline]] inline Vec<T> operator+(const Vec<T>& a, const Vec<T>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

template <class T>
[[gnu::always_inline]] inline Vec<T> operator-(const Vec<T>& a, const Vec<T>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

template <class T>
[[gnu::always_inline]] inline Vec<T> operator-(const Vec<T>& a) {
  return {-a[0], -a[1], -a[2]};
}

template <class S, class T>
requires std::convertible_to<S, T>
[[gnu::always_inline]] inline Vec<T> operator*(const S& scale, const Vec<T>& a) {
  const T s(scale);
  return {s * a[0], s * a[1], s * a[2]};
}

template <class S, class T>
requires std::convertible_to<S, T>
[[gnu::always_inline]] inline Vec<T> operator*(const Vec<T>& a, const S& scale) {
  const T s(scale);
  return {a[0] * s, a[1] * s, a[2] * s};
}

template <class T>
[[gnu::always_inline]] inline T dot(const Vec<T>& a, const Vec<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class T>
[[gnu::always_inline]] inline Vec<T> cross(const Vec<T>& a, const Vec<T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// A vector into a result, number by number: g++ copies the object as a block of memory.
template <class T>
[[gnu::always_inline]] inline Vec<T> copy(const Vec<T>& a) {
  return {a[0], a[1], a[2]};
}

}  // namespace beadwork
