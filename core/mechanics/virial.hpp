#pragma once
// The stress of an element from the bonds that hold it. Eqs (6), (7)
//
//   sigma_i = 1/(2 Omega_i) sum_j sym(r_ij x f_ij),   r_ij = x_j - x_i,   f_ij the force *on i*: tension is positive
//
// Both ends of a bond get the same term, because r and f change sign together. Torques do not enter.

#include "core/mechanics/lane.hpp"

namespace beadwork {

/// What one bond adds to each of its ends; d = x2 - x1, force on end 2.
/// Which is sym(r x f) [N m].
template <class T>
[[gnu::always_inline]] inline Symmetric<T> bond_virial(const Vec<T>& d, const Vec<T>& force) {
  const T half = T(-0.5);
  return {-(d[0] * force[0]), half * (d[0] * force[1] + d[1] * force[0]), half * (d[0] * force[2] + d[2] * force[0]),
          -(d[1] * force[1]), half * (d[1] * force[2] + d[2] * force[1]), -(d[2] * force[2])};
}

/// Its trace: l N, the only part that the criterion of Eq (7) needs.
template <class T>
[[gnu::always_inline]] inline T bond_virial_trace(const Vec<T>& d, const Vec<T>& force) {
  return -dot(d, force);
}

/// Mean normal stress of an element from the sum of its bonds' traces and its volume, tension positive [Pa].
template <class T>
T hydrostatic_stress(Same<T> trace, T volume) {
  return trace / (T(6) * volume);
}

/// Stress of an element from the sum of its bonds' virials [Pa].
inline Sym3 virial_stress(const Sym3& sum, Real volume) {
  const Real s = 0.5 / volume;
  return {s * sum.xx, s * sum.xy, s * sum.xz, s * sum.yy, s * sum.yz, s * sum.zz};
}

inline Mat3 matrix(const Sym3& a) {
  Mat3 m;
  m << a.xx, a.xy, a.xz, a.xy, a.yy, a.yz, a.xz, a.yz, a.zz;
  return m;
}

}  // namespace beadwork
