#pragma once
// The central spring: elements that a fibre strings together, no rotations. docs/theory/cohesive-beam.md

#include <numbers>

#include "core/mechanics/lane.hpp"

namespace beadwork {

template <class T>
struct SpringRest {
  T length;  ///< distance of the centres when bonded [m]
  T axial;   ///< k_n [N/m]
};

/// k_n = E_f pi R_f^2 / s for the spacing s. Springs in series then add up to E S / (sum of s), whatever the
/// spacings.
inline SpringRest<Real> fibre_spring(Real spacing, Real young, Real radius) {
  return {spacing, young * std::numbers::pi * radius * radius / spacing};
}

/// Force on end 2; d = x2 - x1.
template <class T>
[[gnu::always_inline]] inline Vec<T> spring_force(const SpringRest<T>& rest, const Same<Vec<T>>& d) {
  return (rest.axial * (rest.length / sqrt(dot(d, d)) - T(1))) * d;
}

template <class T>
T spring_energy(const SpringRest<T>& rest, const Same<Vec<T>>& d) {
  const T stretch = sqrt(dot(d, d)) - rest.length;
  return T(0.5) * rest.axial * stretch * stretch;
}

}  // namespace beadwork
