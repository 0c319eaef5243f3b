#pragma once
// The cohesive beam: a bond that resists stretching, bending and twisting, with a potential, so that energy and both
// momenta are kept at finite rotations. Its linearisation is the Euler-Bernoulli beam. docs/theory/cohesive-beam.md
//
//   U = k_n/2 (l - L)^2  +  B (t1.t1 + t1.t2 + t2.t2)  +  k_t/2 phi^2                                            (B1)
//   t_i = e x n_i     the sine of the angle between the chord e and the section normal n_i = q_i e0              (B2)
//   phi = 2 u.n1      u = Im(q2 q1*): 2 sin(twist/2) for a pure twist; u.n1 = u.n2, so the ends are equal        (B3)
//
// Valid while both section normals are within 90 degrees of the chord; a real bond breaks long before.

#include <numbers>

#include "core/mechanics/rotation.hpp"
#include "core/mechanics/wrench.hpp"

namespace beadwork {

/// A beam as it was bonded. Orientations count from there: an element's q is the identity when it is bonded,
/// or the caller passes q * conjugate(q at bonding).
template <class T>
struct BeamRest {
  Vec<T> axis;  ///< e0, unit vector from end 1 to end 2
  T length;     ///< L, distance of the centres [m]
  T axial;      ///< k_n = E A / L [N/m]
  T bending;    ///< B = 2 E I / L [N m]; a round section has B = k_n r^2 / 2
  T torsion;    ///< k_t = G J / L [N m]; a round section has k_t = B / (2 (1 + nu))
};

/// k_t / B of a round section: it need not be stored for each bond.
inline Real torsion_to_bending(Real poisson) { return 1 / (2 * (1 + poisson)); }

/// A round beam of one material between two centres, d = x2 - x1.
inline BeamRest<Real> round_beam(const Vec3& d, Real young, Real poisson, Real radius) {
  const Real length = d.norm();
  const Real axial = young * std::numbers::pi * radius * radius / length;
  const Real bending = 0.5 * axial * radius * radius;
  return {d / length, length, axial, bending, bending * torsion_to_bending(poisson)};
}

/// Forces and torques on the ends: minus the gradient of (B1). One square root, one division.
template <class T>
[[gnu::always_inline]] inline Wrench<T> beam_wrench(const BeamRest<T>& rest, const Same<Vec<T>>& d,
                                                    const Quaternion<T>& q1, const Quaternion<T>& q2) {
  const T l = sqrt(dot(d, d));
  const T inverse = T(1) / l;
  const Vec<T> e = inverse * d;
  const Vec<T> n1 = rotate(q1, rest.axis);
  const Vec<T> n2 = rotate(q2, rest.axis);
  const T c1 = dot(e, n1);
  const T c2 = dot(e, n2);

  const T g1 = c1 + c1 + c2;
  const T g2 = c2 + c2 + c1;
  const Vec<T> g = rest.bending * (g1 * n1 + g2 * n2);
  const T along = dot(e, g);
  const T pull = rest.axial * (l - rest.length) + inverse * along;

  // dphi = dtheta2.(w n1 + u x n1): the twisting couple acts on both ends, in opposite senses
  const Quaternion<T> turn = relative(q1, q2);
  const T couple = (rest.torsion + rest.torsion) * dot(turn.v, n1);
  const Vec<T> lever = rest.bending * (g1 * e - n2) - couple * turn.v;
  const Vec<T> torque1 = cross(n1, lever) + (couple * turn.w) * n1;
  // T1 + T2 + d x F2 = 0: angular momentum is kept to round-off
  return {inverse * g - pull * e, copy(torque1), cross(g, e) - torque1};
}

/// How end 2 lies against where an unstrained beam would have it, as end 1 lies: small where strains are, however far
/// the whole has moved and turned.
template <class T>
struct BeamShift {
  Vec<T> moved;        ///< d - L n_1 [m]
  T grown;             ///< l^2 - L^2 [m^2]: far less than its two parts, where a slender beam swings
  Vec<T> normal;       ///< n_1
  Quaternion<T> turn;  ///< of end 2 against end 1
};

template <class T>
[[gnu::always_inline]] inline BeamShift<T> beam_shift(const BeamRest<T>& rest, const Same<Vec<T>>& d,
                                                      const Quaternion<T>& q1, const Quaternion<T>& q2) {
  const Vec<T> n1 = rotate(q1, rest.axis);
  const Vec<T> moved = d - rest.length * n1;
  return {moved, dot(moved, moved + (rest.length + rest.length) * n1), n1, relative(q1, q2)};
}

/// The same forces and torques from that: no large number is taken from another, so that single precision keeps its
/// digits (docs/decisions/mixed-precision.md). The axis of the rest is not used.
template <class T>
[[gnu::always_inline]] inline Wrench<T> beam_wrench(const BeamRest<T>& rest, const BeamShift<T>& shift) {
  const Vec<T>&n1 = shift.normal, &u = shift.moved;
  const T L = rest.length;
  const T l = sqrt(L * L + shift.grown);
  const T both = T(1) / (l * (l + L));         // one division for two
  const T stretch = shift.grown * (both * l);  // l - L
  const T inverse = both * (l + L);
  const Vec<T> swing = inverse * (u - stretch * n1);  // e - n_1
  const Vec<T> e = n1 + swing;
  const Vec<T> bend = turned_by(shift.turn, n1);  // n_2 - n_1
  const Vec<T> away = bend - swing;               // n_2 - e

  const T h1 = T(0.5) * dot(swing, swing);  // 1 - e.n_1
  const T h2 = T(0.5) * dot(away, away);
  const T g1 = T(3) - h1 - h1 - h2;  // 2 c_1 + c_2
  const T g2 = T(3) - h2 - h2 - h1;
  // what of the normals is across the chord: n_i - c_i e = (n_i - e) + h_i e
  const Vec<T> g = rest.bending * (g1 * (h1 * e - swing) + g2 * (h2 * e + away));
  const T couple = (rest.torsion + rest.torsion) * dot(shift.turn.v, n1);
  const Vec<T> lever = rest.bending * (g1 * swing - bend) - couple * shift.turn.v;
  const Vec<T> torque1 = cross(n1, lever) + (couple * shift.turn.w) * n1;
  return {inverse * g - (rest.axial * stretch) * e, copy(torque1), cross(g, e) - torque1};
}

template <class T>
struct BeamEnergy {
  T axial, bending, torsion;  ///< [J]
  T total() const { return axial + bending + torsion; }
};

/// (B1), term by term. Written with t_i: the difference of cosines loses half its digits at small angles.
template <class T>
BeamEnergy<T> beam_energy(const BeamRest<T>& rest, const Same<Vec<T>>& d, const Quaternion<T>& q1,
                          const Quaternion<T>& q2) {
  const T l = sqrt(dot(d, d));
  const Vec<T> e = (T(1) / l) * d;
  const Vec<T> n1 = rotate(q1, rest.axis);
  const Vec<T> t1 = cross(e, n1);
  const Vec<T> t2 = cross(e, rotate(q2, rest.axis));
  const T stretch = l - rest.length;
  const T phi = T(2) * dot(relative(q1, q2).v, n1);
  return {T(0.5) * rest.axial * stretch * stretch, rest.bending * (dot(t1, t1) + dot(t1, t2) + dot(t2, t2)),
          T(0.5) * rest.torsion * phi * phi};
}

/// Internal forces at the ends of a beam. The bending moment varies linearly between them: its maximum is at
/// an end.
template <class T>
struct BeamSection {
  T axial_force;       ///< N, tension positive [N]
  T moment1, moment2;  ///< bending moment at each end, never negative [N m]
  T torque;            ///< positive where end 2 is turned forwards about the chord against end 1 [N m]
};

template <class T>
BeamSection<T> beam_section(const Same<Vec<T>>& d, const Wrench<T>& on) {
  const Vec<T> e = (T(1) / sqrt(dot(d, d))) * d;
  const T torque = dot(e, on.torque1);
  const Vec<T> m1 = on.torque1 - torque * e;
  const Vec<T> m2 = on.torque2 + torque * e;
  return {-dot(e, on.force), sqrt(dot(m1, m1)), sqrt(dot(m2, m2)), torque};
}

template <class T>
BeamSection<T> beam_section(const BeamRest<T>& rest, const Same<Vec<T>>& d, const Quaternion<T>& q1,
                            const Quaternion<T>& q2) {
  return beam_section<T>(d, beam_wrench<T>(rest, d, q1, q2));
}

/// Largest stresses in a round section [Pa].
template <class T>
struct BeamStress {
  T axial;          ///< N/A
  T axial_bending;  ///< N/A + max(M1, M2) r/I: the largest normal stress of the section
  T principal;      ///< (s + sqrt(s^2 + 4 tau^2))/2, s = axial_bending, tau = |T| r/J
};

template <class T>
BeamStress<T> beam_stress(const BeamSection<T>& section, Same<T> radius) {
  const T area = T(std::numbers::pi) * radius * radius;
  const T per_area = T(1) / area;
  const T per_modulus = T(4) * per_area / radius;  // r/I = 4/(pi r^3), and r/J half of that
  const T axial = section.axial_force * per_area;
  const T s = axial + max(section.moment1, section.moment2) * per_modulus;
  const T tau = T(0.5) * section.torque * per_modulus;
  return {axial, s, T(0.5) * (s + sqrt(s * s + T(4) * tau * tau))};
}

}  // namespace beadwork
