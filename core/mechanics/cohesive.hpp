#pragma once
// The cohesive contact: elastic up to the strength, then softening in a straight line to zero.   Eqs (3)-(5)
// The force is a function of the state and of the *accepted* history k, the largest opening so far; the new
// history is returned beside it, and the caller accepts it or not. docs/theory/cohesive-contact.md
//
//   F = (1 - d) k0 u,   d = u_p (k - u_e) / (k (u_p - u_e))  for u_e < k < u_p,   k = max u (C1) compression
//   (u_n < 0): F = k0 u_n, undamaged, also after failure dissipated: D(k) = G S (k - u_e)/(u_p - u_e) (C2)

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
[[gnu::always_inline]] inline T soundness(const Softening<T>& law, Same<T> history) {
  const T k = max(history, law.onset);
  return max(T(0), law.onset * (law.open - k) / (k * (law.open - law.onset)));
}

template <class T>
T damage(const Softening<T>& law, Same<T> history) {
  return T(1) - soundness(law, history);
}

/// Pull between the faces, per area [Pa]. Negative in compression, which is elastic whatever the damage.
template <class T>
[[gnu::always_inline]] inline T traction(const Softening<T>& law, Same<T> opening, Same<T> history) {
  const T sound = soundness(law, max(history, opening));
  return select(opening < T(0), T(1), sound) * law.stiffness * opening;
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
inline Real contact_area_on_large(Real small_radius) {
  return std::numbers::pi * small_radius * small_radius;
}

// ---------------------------------------------------------------------------------------------- opening
// alone

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
[[gnu::always_inline]] inline CohesivePull<T> cohesive_pull(const Softening<T>& law,
                                                            const CohesiveRest<T>& rest,
                                                            const Same<Vec<T>>& d, Same<T> history) {
  const T l = sqrt(dot(d, d));
  const T u_n = l - rest.length;
  const T pull = rest.area * traction(law, u_n, history);
  return {(-pull / l) * d, max(history, u_n)};
}

// ---------------------------------------------------------------------------------------------- sliding

/// The contact point as each element carries it along: body vectors from the centres, equal places when
/// bonded.
template <class T>
struct ContactArms {
  Vec<T> arm1, arm2;  ///< [m]
};

/// Both arms to the point on the line of centres that divides d = x2 - x1 as the radii do.
inline ContactArms<Real> contact_arms(const Vec3& d, Real radius1, Real radius2, const Quat& q1,
                                      const Quat& q2) {
  const Vec3 to_point = d * (radius1 / (radius1 + radius2));
  return {rotate_back(q1, to_point), rotate_back(q2, to_point - d)};
}

enum class CohesiveModes { shear, both };

/// One number for each mode: an opening, or its history [m].
template <class T>
struct Openings {
  T normal, shear;
};

template <class T>
struct CohesiveLaws {
  Softening<T> normal, shear;
};

template <class T>
[[gnu::always_inline]] inline CohesiveLaws<T> as(const CohesiveLaws<Real>& laws) {
  return {as<T>(laws.normal), as<T>(laws.shear)};
}

/// Where the contact stands: u = c2 - c1 of the two carried points, split along n = d/l.
template <class T>
struct ContactState {
  Vec<T> normal;        ///< n, from 1 to 2
  T length;             ///< l [m]
  Vec<T> arm1, arm2;    ///< c_i - x_i, world [m]
  Vec<T> slip;          ///< u_s = u - n (u.n) [m]
  T along;              ///< u.n [m]
  Openings<T> opening;  ///< l - l0 and |u_s|
};

template <class T>
[[gnu::always_inline]] inline ContactState<T> contact_state(const CohesiveRest<T>& rest,
                                                            const ContactArms<T>& arms, const Same<Vec<T>>& d,
                                                            const Quaternion<T>& q1,
                                                            const Quaternion<T>& q2) {
  const T l = sqrt(dot(d, d));
  const Vec<T> n = (T(1) / l) * d;
  const Vec<T> arm1 = rotate(q1, arms.arm1);
  const Vec<T> arm2 = rotate(q2, arms.arm2);
  const Vec<T> u = d + arm2 - arm1;
  const T along = dot(u, n);
  const Vec<T> slip = u - along * n;
  return {copy(n), l, copy(arm1), copy(arm2), copy(slip), along, {l - rest.length, sqrt(dot(slip, slip))}};
}

/// Whether the contact has failed: either mode at its u_p takes both. A mask of T.
template <CohesiveModes modes, class T>
[[gnu::always_inline]] inline auto has_failed(const CohesiveLaws<T>& laws, const Openings<T>& history) {
  if constexpr (modes == CohesiveModes::shear)
    return history.shear >= laws.shear.open;
  else
    return max(history.normal - laws.normal.open, history.shear - laws.shear.open) >= T(0);
}

/// The history if this state is accepted. A failed contact remembers no more: what it dissipated stands.
template <CohesiveModes modes, class T>
[[gnu::always_inline]] inline Openings<T> next_history(const CohesiveLaws<T>& laws,
                                                       const Openings<T>& opening,
                                                       const Openings<T>& history) {
  const auto failed = has_failed<modes>(laws, history);
  return {select(failed, history.normal, max(history.normal, opening.normal)),
          select(failed, history.shear, max(history.shear, opening.shear))};
}

/// Share of the stiffness that acts in each mode, given the history that includes the present state.
template <CohesiveModes modes, class T>
[[gnu::always_inline]] inline Openings<T> active_share(const CohesiveLaws<T>& laws,
                                                       const Openings<T>& opening,
                                                       const Openings<T>& history) {
  const auto failed = has_failed<modes>(laws, history);
  const T shear = select(failed, T(0), soundness(laws.shear, history.shear));
  if constexpr (modes == CohesiveModes::shear) return {T(0), shear};  // no normal law, no normal force
  const T pulled = select(failed, T(0), soundness(laws.normal, history.normal));
  return {select(opening.normal < T(0), T(1), pulled), shear};
}

template <class T>
struct Cohesion {
  Wrench<T> wrench;
  Openings<T> history;  ///< if this state is accepted
};

/// Shear law, or both laws. With the damage held, minus the gradient of  S K_n/2 u_n^2 + S K_s/2 |u_s|^2:
/// hence the factor 1 - u.n/l of the force, and both ends' forces on one line: angular momentum is kept to
/// round-off.
template <CohesiveModes modes, class T>
[[gnu::always_inline]] inline Cohesion<T> cohesive_wrench(const CohesiveLaws<T>& laws,
                                                          const CohesiveRest<T>& rest,
                                                          const ContactArms<T>& arms, const Same<Vec<T>>& d,
                                                          const Quaternion<T>& q1, const Quaternion<T>& q2,
                                                          const Openings<T>& history) {
  const ContactState<T> at = contact_state<T>(rest, arms, d, q1, q2);
  const Openings<T> next = next_history<modes>(laws, at.opening, history);
  const Openings<T> share = active_share<modes>(laws, at.opening, next);
  const Vec<T> drag = (-rest.area * share.shear * laws.shear.stiffness) * at.slip;
  const T pull = rest.area * share.normal * laws.normal.stiffness * at.opening.normal;
  return {
      {(T(1) - at.along / at.length) * drag - pull * at.normal, cross(drag, at.arm1), cross(at.arm2, drag)},
      {next.normal, next.shear}};
}

/// Recoverable energy of the contact [J].
template <CohesiveModes modes, class T>
T cohesive_stored(const CohesiveLaws<T>& laws, const CohesiveRest<T>& rest, const Openings<T>& opening,
                  const Openings<T>& history) {
  const Openings<T> share = active_share<modes>(laws, opening, next_history<modes>(laws, opening, history));
  return T(0.5) * rest.area *
         (share.normal * laws.normal.stiffness * opening.normal * opening.normal +
          share.shear * laws.shear.stiffness * opening.shear * opening.shear);
}

/// Energy that softening has taken so far [J].
template <CohesiveModes modes, class T>
T cohesive_dissipated(const CohesiveLaws<T>& laws, const CohesiveRest<T>& rest, const Openings<T>& history) {
  const T sliding = dissipated_per_area(laws.shear, history.shear);
  if constexpr (modes == CohesiveModes::shear) return rest.area * sliding;
  return rest.area * (dissipated_per_area(laws.normal, history.normal) + sliding);
}

/// Energy let go in this step because the other mode failed [J]: still recoverable a step ago, now gone, and
/// in no history. The ledger books it once, when the state is accepted.
template <CohesiveModes modes, class T>
T cohesive_released(const CohesiveLaws<T>& laws, const CohesiveRest<T>& rest, const Openings<T>& opening,
                    const Openings<T>& history) {
  if constexpr (modes == CohesiveModes::shear) return T(0);
  const Openings<T> next = next_history<modes>(laws, opening, history);
  const T pulled = max(T(0), opening.normal);
  const T held = T(0.5) * rest.area *
                 (soundness(laws.normal, next.normal) * laws.normal.stiffness * pulled * pulled +
                  soundness(laws.shear, next.shear) * laws.shear.stiffness * opening.shear * opening.shear);
  const T newly = select(has_failed<modes>(laws, next), held, T(0));
  return select(has_failed<modes>(laws, history), T(0), newly);
}

}  // namespace beadwork
