#pragma once
// Two spheres that touch: they push one another apart along the normal, and hold or slide across it. docs/theory/contact.md
//
//   F_n = f(delta) - c v_n >= 0                         delta the overlap, v_n the rate of the distance                (T1)
//   F_t' = R F_t min(1, k_t/k_t_before) - k_t v_t dt    R follows the normal, v_t what slides at the contact           (T2)
//   |F_t| <= mu F_n                                     what is beyond is slip                                         (T3)
//
// (T2) loses energy where the tangential stiffness falls and makes none where it grows: F_t is kept, not the way.

#include "core/mechanics/rotation.hpp"
#include "core/mechanics/wrench.hpp"

namespace beadwork {

/// f = k delta.
struct LinearContact {
  template <class T>
  [[gnu::always_inline]] static T force(const T& k, const T& delta) {
    return k * delta;
  }
  template <class T>
  [[gnu::always_inline]] static T slope(const T& k, const T&) {
    return k;
  }
  template <class T>
  [[gnu::always_inline]] static T energy(const T& k, const T& delta) {
    return T(0.5) * k * delta * delta;
  }
  /// Of c, what goes with the overlap.
  template <class T>
  [[gnu::always_inline]] static T damping(const T&, const T&) {
    return T(1);
  }
  static constexpr bool even = true;  ///< its slopes do not change
  static constexpr Real exponent = 1;
  static constexpr const char* unit = "N/m";
  static constexpr const char* damping_unit = "N.s/m";
};

/// f = k delta^(3/2), k = 4/3 E* sqrt(R*) (Hertz); c as the root of the slope (Tsuji 1992), so that restitution does not
/// depend on the speed.
struct HertzContact {
  template <class T>
  [[gnu::always_inline]] static T force(const T& k, const T& delta) {
    return k * delta * sqrt(delta);
  }
  template <class T>
  [[gnu::always_inline]] static T slope(const T& k, const T& delta) {
    return T(1.5) * k * sqrt(delta);
  }
  template <class T>
  [[gnu::always_inline]] static T energy(const T& k, const T& delta) {
    return T(0.4) * k * delta * delta * sqrt(delta);
  }
  template <class T>
  [[gnu::always_inline]] static T damping(const T& k, const T& delta) {
    return sqrt(slope(k, delta));
  }
  static constexpr bool even = false;
  static constexpr Real exponent = 1.5;
  static constexpr const char* unit = "N/m^1.5";
  static constexpr const char* damping_unit = "kg^0.5";
};

/// Of the plane across n: a vector carried along as n turns and the pair spins about it, at its length.
template <class T>
[[gnu::always_inline]] inline Vec<T> carried_across(const Vec<T>& n, const Vec<T>& old, const T& turn) {
  const Vec<T> turned = old + turn * cross(n, old);
  const Vec<T> across = turned - dot(turned, n) * n;
  const T was = dot(old, old), is = dot(across, across);
  const T scale = select(is > T(0), sqrt(was / select(is > T(0), is, T(1))), T(0));
  return scale * across;
}

/// (T2) and (T3): the force on end 2 [N]. `before`: that of the last step, carried along.
template <class T>
[[gnu::always_inline]] inline Vec<T> friction(const Vec<T>& before, const T& k_before, const T& k, const Vec<T>& way,
                                              const T& cap) {
  const Vec<T> tried = min(T(1), k / k_before) * before - k * way;
  const T size = sqrt(dot(tried, tried));
  return (min(size, cap) / select(size > T(0), size, T(1))) * tried;
}

/// What is lost in a step by slip and by a stiffness that falls: the work that the scheme lets the force take over the way,
/// which is that of the trapezoid, less what is stored [J].
template <class T>
[[gnu::always_inline]] inline T lost_by_friction(const Vec<T>& before, const T& k_before, const Vec<T>& now, const T& k,
                                                 const Vec<T>& way) {
  return T(-0.5) * dot(before + now, way) - T(0.5) * (dot(now, now) / k - dot(before, before) / k_before);
}

}  // namespace beadwork
