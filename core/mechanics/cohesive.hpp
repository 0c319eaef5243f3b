#pragma once
// The cohesive contact: elastic up to the strength, then softening in a straight line to zero.   Eqs (3)-(5)
// The force is a function of the state and of the *accepted* history k, the largest opening so far; the new
// history is returned beside it, and the caller accepts it or not. docs/theory/cohesive-contact.md
//
//   F = (1 - d) k0 u,   d = u_p (k - u_e) / (k (u_p - u_e))  for u_e < k < u_p,   k = max u      (C1)
//   compression (u_n < 0): F = k0 u_n, undamaged, also after failure
//   dissipated: D(k) = G S (k - u_e)/(u_p - u_e)                                                  (C2)
//
// How the two faces of a contact stand to one another: cohesive_faces.hpp; two modes together: cohesive_modes.hpp.

#include <numbers>

#include "core/mechanics/rotation.hpp"
#include "core/mechanics/wrench.hpp"

namespace beadwork {

/// Traction against opening of one mode, for a unit of area.
template <class T>
struct Softening {
  T stiffness;  ///< K, k0 = K S [N/m^3]
  T onset;      ///< u_e, where damage starts [m]
  T open;       ///< u_p > u_e, where nothing holds any more [m]
};

/// The same law for numbers of type T.
template <class T>
[[gnu::always_inline]] inline Softening<T> as(const Softening<Real>& law) {
  return {T(law.stiffness), T(law.onset), T(law.open)};
}

/// 1 - d. Exactly 1 up to the onset, exactly 0 from u_p on.
template <class T>
[[gnu::always_inline]] inline T integrity(const Softening<T>& law, Same<T> history) {
  const T k = max(history, law.onset);
  return max(T(0), law.onset * (law.open - k) / (k * (law.open - law.onset)));
}

template <class T>
T damage(const Softening<T>& law, Same<T> history) {
  return T(1) - integrity(law, history);
}

/// Pull between the faces, per area [Pa]. Negative in compression, which is elastic whatever the damage.
template <class T>
[[gnu::always_inline]] inline T traction(const Softening<T>& law, Same<T> opening, Same<T> history) {
  // where they are equal the opening goes on: the slope is that of loading
  const T left = integrity(law, max(opening, history));
  return select(opening < T(0), T(1), left) * law.stiffness * opening;
}

/// Recoverable energy per area [J/m^2].
template <class T>
T stored_per_area(const Softening<T>& law, Same<T> opening, Same<T> history) {
  return T(0.5) * traction(law, opening, history) * opening;
}

/// G = F_c u_p / (2 S), Eq (5) [J/m^2].
template <class T>
T fracture_energy(const Softening<T>& law) {
  return T(0.5) * law.stiffness * law.onset * law.open;
}

/// Energy gone for good per area, (C2) [J/m^2].
template <class T>
T dissipated_per_area(const Softening<T>& law, Same<T> history) {
  const T share = (min(history, law.open) - law.onset) / (law.open - law.onset);
  return fracture_energy(law) * max(T(0), share);
}

/// u_p = 2 G / sigma, from Eq (5) [m].
inline Real final_opening(Real strength, Real energy) { return 2 * energy / strength; }

// A deck gives strength [Pa] and energy G [J/m^2], and exactly one more number, which fixes where damage
// starts.

inline Softening<Real> softening_by_onset(Real strength, Real energy, Real onset) {
  return {strength / onset, onset, final_opening(strength, energy)};
}
inline Softening<Real> softening_by_stiffness(Real strength, Real energy, Real stiffness) {
  return {stiffness, strength / stiffness, final_opening(strength, energy)};
}
/// ratio = u_e / u_p.
inline Softening<Real> softening_by_ratio(Real strength, Real energy, Real ratio) {
  return softening_by_onset(strength, energy, ratio * final_opening(strength, energy));
}

/// Whether these numbers are a law at all: 0 < u_e < u_p, with a finite stiffness above 0.
inline bool is_softening(const Softening<Real>& law) {
  return law.stiffness > 0 && std::isfinite(law.stiffness) && law.onset > 0 && law.onset < law.open &&
         std::isfinite(law.open);
}

/// Area of a contact between elements of like size: pi ((R1+R2)/2)^2.
inline Real contact_area(Real radius1, Real radius2) {
  const Real mean = 0.5 * (radius1 + radius2);
  return std::numbers::pi * mean * mean;
}

/// Area of a contact between a small (matrix) element and a large (fibre) one: pi R1^2 of the small one.
inline Real contact_area_on_large(Real small_radius) { return std::numbers::pi * small_radius * small_radius; }

// ---------------------------------------------------------------------------------------------- opening alone

template <class T>
struct CohesiveRest {
  T length;  ///< l0, distance of the centres when bonded [m]
  T area;    ///< S [m^2]
};

template <class T>
struct CohesivePull {
  Vec<T> force;  ///< on end 2; end 1 gets the opposite [N]
  T history;     ///< k, if this state is accepted [m]
};

/// u_n = l - l0, d = x2 - x1.
template <class T>
T normal_opening(const CohesiveRest<T>& rest, const Same<Vec<T>>& d) {
  return sqrt(dot(d, d)) - rest.length;
}

/// The normal law alone: a central force, no rotations.
template <class T>
[[gnu::always_inline]] inline CohesivePull<T> cohesive_pull(const Softening<T>& law, const CohesiveRest<T>& rest,
                                                            const Same<Vec<T>>& d, Same<T> history) {
  const T l = sqrt(dot(d, d));
  const T u_n = l - rest.length;
  const T pull = rest.area * traction(law, u_n, history);
  return {(-pull / l) * d, max(history, u_n)};
}

}  // namespace beadwork
