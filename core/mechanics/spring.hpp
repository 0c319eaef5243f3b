#pragma once
// The central spring: it pulls along the line of centres, and no rotations come into it. docs/theory/spring.md

#include <numbers>

#include "core/mechanics/lane.hpp"

namespace beadwork {

template <class T>
struct SpringRest {
  T length;  ///< distance of the centres when bonded [m]
  T axial;   ///< k_n [N/m]
};

/// A spring of round section between centres at this distance: k_n = E pi r^2 / L. Springs in series add up to
/// E S / (sum of L), whatever the distances.
inline SpringRest<Real> round_spring(Real length, Real young, Real radius) {
  return {length, young * std::numbers::pi * radius * radius / length};
}

/// Force on end 2; d = x2 - x1.
template <class T>
[[gnu::always_inline]] inline Vec<T> spring_force(const SpringRest<T>& rest, const Same<Vec<T>>& d) {
  return (rest.axial * (rest.length / sqrt(dot(d, d)) - T(1))) * d;
}

/// Axial force, tension positive.
template <class T>
[[gnu::always_inline]] inline T spring_tension(const SpringRest<T>& rest, const Same<Vec<T>>& d) {
  return rest.axial * (sqrt(dot(d, d)) - rest.length);
}

template <class T>
T spring_energy(const SpringRest<T>& rest, const Same<Vec<T>>& d) {
  const T stretch = sqrt(dot(d, d)) - rest.length;
  return T(0.5) * rest.axial * stretch * stretch;
}

}  // namespace beadwork
