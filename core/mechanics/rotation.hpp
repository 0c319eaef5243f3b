#pragma once
// Rotations as unit quaternions that take body vectors to the world. A turn seen from the world stands on the
// left: q' = increment(dt w + dt^2/2 alpha) q. docs/theory/verlet.md

#include <cmath>

#include "core/mechanics/lane.hpp"

namespace beadwork {

template <class T>
[[gnu::always_inline]] inline Quaternion<T> conjugate(const Quaternion<T>& q) {
  return {q.w, -q.v};
}

/// First b, then a.
template <class T>
[[gnu::always_inline]] inline Quaternion<T> operator*(const Quaternion<T>& a, const Quaternion<T>& b) {
  return {a.w * b.w - dot(a.v, b.v), a.w * b.v + b.w * a.v + cross(a.v, b.v)};
}

/// The rotation from one orientation to another, seen from the world: to * conjugate(from).
template <class T>
[[gnu::always_inline]] inline Quaternion<T> relative(const Quaternion<T>& from, const Quaternion<T>& to) {
  return {from.w * to.w + dot(from.v, to.v), from.w * to.v - to.w * from.v + cross(from.v, to.v)};
}

template <class T>
[[gnu::always_inline]] inline T squared_norm(const Quaternion<T>& q) {
  return q.w * q.w + dot(q.v, q.v);
}

/// Body to world in two cross products instead of a matrix.
template <class T>
[[gnu::always_inline]] inline Vec<T> rotate(const Quaternion<T>& q, const Same<Vec<T>>& body) {
  const Vec<T> t = T(2) * cross(q.v, body);
  return body + q.w * t + cross(q.v, t);
}

/// By how much a vector is turned: rotate(q, body) - body, to all digits however small the turn.
template <class T>
[[gnu::always_inline]] inline Vec<T> turned_by(const Quaternion<T>& q, const Same<Vec<T>>& body) {
  const Vec<T> t = T(2) * cross(q.v, body);
  return q.w * t + cross(q.v, t);
}

template <class T>
[[gnu::always_inline]] inline Vec<T> rotate_back(const Quaternion<T>& q, const Same<Vec<T>>& world) {
  const Vec<T> t = T(2) * cross(world, q.v);
  return world + q.w * t + cross(t, q.v);
}

template <class T>
[[gnu::always_inline]] inline Quaternion<T> normalise(const Quaternion<T>& q) {
  const T scale = T(1) / sqrt(squared_norm(q));
  return {q.w * scale, q.v * scale};
}

/// One Newton step towards length 1: for a quaternion that left it by rounding, at the cost of no root and no
/// division.
template <class T>
[[gnu::always_inline]] inline Quaternion<T> renormalise(const Quaternion<T>& q) {
  const T scale = T(1.5) - T(0.5) * squared_norm(q);
  return {q.w * scale, q.v * scale};
}

/// The turn by a rotation vector [rad], any length. Uses the sine and cosine of the library: not for hot
/// loops.
inline Quat exp_map(const Vec3& turn) {
  const Real angle = turn.norm();
  const Real x = angle * angle;
  if (angle < 1e-4) return {1 - x / 8, turn * (0.5 - x / 48)};  // the next terms are below 1e-18
  return {std::cos(0.5 * angle), turn * (std::sin(0.5 * angle) / angle)};
}

/// The turn by a rotation vector of at most 2 rad, to round-off: the series of sine and cosine up to s^8, s
/// being half the angle squared, whose next term is s^9/18!. An explicit step that turned an element further
/// would be far beyond its stable length. Its own series because the sine of a library may pick other bits on
/// another processor.
template <class T>
[[gnu::always_inline]] inline Quaternion<T> increment(const Vec<T>& turn) {
  constexpr double cosine[] = {1.,
                               -1. / 2,
                               1. / 24,
                               -1. / 720,
                               1. / 40320,
                               -1. / 3628800,
                               1. / 479001600,
                               -1. / 87178291200.,
                               1. / 20922789888000.};
  constexpr double sine[] = {1.,
                             -1. / 6,
                             1. / 120,
                             -1. / 5040,
                             1. / 362880,
                             -1. / 39916800,
                             1. / 6227020800.,
                             -1. / 1307674368000.,
                             1. / 355687428096000.};
  const T s = T(0.25) * dot(turn, turn);
  T c = T(cosine[8]);
  T half_sinc = T(sine[8]);
  for (int n = 7; n >= 0; --n) {
    c = c * s + T(cosine[n]);
    half_sinc = half_sinc * s + T(sine[n]);
  }
  return {c, turn * (T(0.5) * half_sinc)};
}

/// Rotation vector of q [rad], length at most pi. atan2 keeps its digits at both ends, where asin and acos
/// lose them.
inline Vec3 log_map(const Quat& q) {
  const Real sign = q.w < 0 ? -1 : 1;  // q and -q are one rotation: take the shorter way
  const Real w = sign * q.w;
  const Real sine = q.v.norm();
  const Real factor = sine < 1e-8 * w ? 2 / w : 2 * std::atan2(sine, w) / sine;
  return (sign * factor) * q.v;
}

/// The matrix with the same effect as rotate(q, .).
template <class T>
Mat<T> rotation_matrix(const Quaternion<T>& q) {
  Mat<T> r;
  r.col(0) = rotate(q, Vec<T>(T(1), T(0), T(0)));
  r.col(1) = rotate(q, Vec<T>(T(0), T(1), T(0)));
  r.col(2) = rotate(q, Vec<T>(T(0), T(0), T(1)));
  return r;
}

}  // namespace beadwork
