#pragma once
// Opening and sliding together: which share of its stiffness a contact still has in either mode, what it remembers, and
// what energy it has lost. docs/theory/cohesive-contact.md
//
//   IndependentModes  each mode by its own law; failure in either takes both. What it remembers: the largest openings.
//   MixedMode         one damage for both, after Camanho and Davila: onset by the quadratic criterion of stresses, failure at the
//                     energy G(B) of the mode mix. What it remembers: the share of the stiffness that is left.

#include "core/mechanics/cohesive.hpp"
#include "core/mechanics/cohesive_faces.hpp"
#include "core/mechanics/power.hpp"

namespace beadwork {

enum class CohesiveModes { normal, shear, both };

/// Recoverable energy of an area [J], `share` being what is left of the stiffnesses.
template <class Modes, class T>
[[gnu::always_inline]] inline T held_energy(const Modes& modes, Same<T> area, const Openings<T>& opening,
                                            const Openings<T>& share) {
  return T(0.5) * area *
         (share.normal * T(modes.normal.stiffness) * opening.normal * opening.normal +
          share.shear * T(modes.shear.stiffness) * opening.shear * opening.shear);
}

template <CohesiveModes modes>
struct IndependentModes {
  static constexpr bool opens = modes != CohesiveModes::shear;
  static constexpr bool slides = modes != CohesiveModes::normal;
  static constexpr bool coupled = false;
  static constexpr bool releases = modes == CohesiveModes::both;  ///< energy is lost that no history tells

  Softening<Real> normal, shear;

  template <class T>
  using History = Openings<T>;

  /// Whether the contact has failed: either mode at its u_p takes both. A mask.
  template <class T>
  [[gnu::always_inline]] auto failed(const Openings<T>& history) const {
    if constexpr (!opens)
      return history.shear >= T(shear.open);
    else if constexpr (!slides)
      return history.normal >= T(normal.open);
    else
      return max(history.normal - T(normal.open), history.shear - T(shear.open)) >= T(0);
  }
  template <class T>
  [[gnu::always_inline]] auto softens(const Openings<T>& history) const {
    const T opened = opens ? history.normal - T(normal.onset) : T(-1);
    const T slid = slides ? history.shear - T(shear.onset) : T(-1);
    return max(opened, slid) > T(0);
  }

  /// Of a contact that has failed: by sliding.
  bool slid(const Openings<Real>& history) const { return !opens || history.normal < normal.open; }

  /// What is remembered if this opening is accepted. A failed contact remembers no more: what it dissipated stands.
  template <class T>
  [[gnu::always_inline]] Openings<T> next(const Openings<T>& opening, const Openings<T>& history) const {
    const auto done = failed(history);
    return {select(done, history.normal, max(opening.normal, history.normal)),
            select(done, history.shear, max(opening.shear, history.shear))};
  }

  /// Share of the stiffness that acts in each mode; the history includes the present opening. `done`: the contact had
  /// failed by the step before. In the step in which it fails what the other mode holds still acts, and goes at the end
  /// of it.
  template <class T, class Mask>
  [[gnu::always_inline]] Openings<T> share(const Openings<T>& opening, const Openings<T>& history,
                                           const Mask& done) const {
    T slid(0), opened(0);
    if constexpr (slides) slid = select(done, T(0), integrity(as<T>(shear), history.shear));
    if constexpr (opens)
      opened = select(opening.normal < T(0), T(1), select(done, T(0), integrity(as<T>(normal), history.normal)));
    return {opened, slid};
  }

  template <class T>
  T damage(const Openings<T>& history) const {
    if constexpr (!opens) return beadwork::damage<T>(as<T>(shear), history.shear);
    if constexpr (!slides) return beadwork::damage<T>(as<T>(normal), history.normal);
    return max(beadwork::damage<T>(as<T>(shear), history.shear), beadwork::damage<T>(as<T>(normal), history.normal));
  }

  /// Energy that softening has taken so far, per area [J/m^2].
  template <class T>
  T dissipated(const Openings<T>& history) const {
    T lost(0);
    if constexpr (opens) lost = lost + dissipated_per_area<T>(as<T>(normal), history.normal);
    if constexpr (slides) lost = lost + dissipated_per_area<T>(as<T>(shear), history.shear);
    return lost;
  }

  /// Energy per area that goes in this step and that no history tells: what one mode still held when the other failed.
  template <class T>
  T released(const Openings<T>& opening, const Openings<T>& before, const Openings<T>& after) const {
    if constexpr (!releases) return T(0);
    const Openings<T> left{integrity(as<T>(normal), after.normal), integrity(as<T>(shear), after.shear)};
    const T held = held_energy(*this, T(1), Openings<T>{max(T(0), opening.normal), opening.shear}, left);
    return select(failed(before), T(0), select(failed(after), held, T(0)));
  }
};

/// The energy G(B) at which a mode mix fails.
struct Coupling {
  bool linear = true;  ///< G_I/G_Ic + G_II/G_IIc = 1, else G_Ic + (G_IIc - G_Ic) B^p of Benzeggagh and Kenane
  UnitPower power;

  template <class T>
  [[gnu::always_inline]] T energy(Real normal, Real shear, const T& mix) const {
    if (linear) return T(1) / ((T(1) - mix) * T(1 / normal) + mix * T(1 / shear));
    return T(normal) + T(shear - normal) * power(mix);
  }
};

struct MixedMode {
  static constexpr bool opens = true;
  static constexpr bool slides = true;
  static constexpr bool coupled = true;
  static constexpr bool releases = true;

  Softening<Real> normal, shear;
  Coupling coupling;

  template <class T>
  struct History {
    T integrity;  ///< smallest share of the stiffness so far, 1 - d
    T mix;        ///< B at the last accepted opening
  };

  /// w = sqrt(K_n <u_n>^2 + K_s u_s^2) and B = K_s u_s^2/w^2. While the openings stay in proportion, B is the share of
  /// the second mode in the work done, whatever the damage.
  template <class T>
  struct Mix {
    T size;  ///< [sqrt(J)/m]
    T share;
  };
  template <class T>
  [[gnu::always_inline]] Mix<T> mix_of(const Openings<T>& opening) const {
    const T pulled = max(T(0), opening.normal);
    const T opened = T(normal.stiffness) * pulled * pulled;
    const T slid = T(shear.stiffness) * opening.shear * opening.shear;
    const T both = opened + slid;
    return {sqrt(both), slid / max(both, T(1e-300))};
  }

  /// Traction over w at a mix: the triangle from the onset of the quadratic criterion to where its area is G(B).
  template <class T>
  [[gnu::always_inline]] Softening<T> at_mix(const T& mix) const {
    const T onset = sqrt(T(1) / ((T(1) - mix) * T(1 / squared_onset(normal)) + mix * T(1 / squared_onset(shear))));
    return {T(1), onset, T(2) * coupling.energy(fracture_energy(normal), fracture_energy(shear), mix) / onset};
  }

  template <class T>
  [[gnu::always_inline]] auto failed(const History<T>& history) const {
    return history.integrity <= T(0);
  }
  template <class T>
  [[gnu::always_inline]] auto softens(const History<T>& history) const {
    return history.integrity < T(1);
  }
  bool slid(const History<Real>& history) const { return history.mix > 0.5; }

  template <class T>
  [[gnu::always_inline]] History<T> next(const Openings<T>& opening, const History<T>& history) const {
    const Mix<T> now = mix_of(opening);
    return {min(history.integrity, integrity(at_mix(now.share), now.size)), now.share};
  }
  template <class T, class Mask>
  [[gnu::always_inline]] Openings<T> share(const Openings<T>& opening, const History<T>& history, const Mask&) const {
    return {select(opening.normal < T(0), T(1), history.integrity), history.integrity};
  }
  template <class T>
  T damage(const History<T>& history) const {
    return T(1) - history.integrity;
  }
  template <class T>
  T dissipated(const History<T>&) const {
    return T(0);
  }

  /// The integral of w^2/2 dd at the mix in the middle of the step: exact for openings in proportion, of second order
  /// else.
  template <class T>
  T released(const Openings<T>&, const History<T>& before, const History<T>& after) const {
    const auto law = at_mix(select(before.integrity < T(1), T(0.5) * (before.mix + after.mix), after.mix));
    const auto way = [&](const T& left) {
      return law.onset * (T(1) - left) / (law.onset + left * (law.open - law.onset));
    };
    return fracture_energy(law) * (way(after.integrity) - way(before.integrity));
  }

 private:
  static Real squared_onset(const Softening<Real>& law) { return law.stiffness * law.onset * law.onset; }
};

// ------------------------------------------------------------------------------------------------- a contact

template <class Modes, class T>
struct CohesiveHistory {
  typename Modes::template History<T> modes;
  /// 1 for faces that have slid past one another: nothing acts between them for good. 0.5 in the step in which they
  /// part: what acts between them is part of that step, and goes at the end of it.
  T parted;
};

template <class Modes, class T>
struct CohesiveState {
  Openings<T> share;                ///< of the stiffnesses that acts
  CohesiveHistory<Modes, T> after;  ///< if this state is accepted
};

template <class Modes, class T>
[[gnu::always_inline]] inline T holding(const CohesiveHistory<Modes, T>& before) {
  return select(before.parted > T(0), T(0), T(1));
}

/// The opening that a contact feels: none once its faces have parted.
template <class Modes, class Faces, class T>
[[gnu::always_inline]] inline Openings<T> felt_opening(const Faces& at, const CohesiveHistory<Modes, T>& before) {
  if constexpr (!Faces::part) return at.opening;
  const T holds = holding(before);
  return {holds * at.opening.normal, holds * at.opening.shear};
}

/// Whether the faces part in this state: turned over, or slid past one another with nothing left to hold them by the
/// step before. What resists no sliding may slide by the final opening too. A mask.
template <class Modes, class T>
[[gnu::always_inline]] inline auto part_now(const Modes& modes, const CarriedFaces<T>& at, Same<T> area,
                                            const typename Modes::template History<T>& before) {
  if constexpr (Modes::slides)
    return (have_slid_past(at, area, T(0)) && modes.failed(before)) || have_turned_over(at);
  else
    return have_slid_past(at, area, T(modes.normal.open)) || have_turned_over(at);
}

/// Where a contact stands at an opening of its faces, given what it remembers.
template <class Modes, class Faces, class T>
[[gnu::always_inline]] inline CohesiveState<Modes, T> cohesive_state(const Modes& modes, const Faces& at, Same<T> area,
                                                                     const CohesiveHistory<Modes, T>& before) {
  const Openings<T> opening = felt_opening(at, before);
  const auto next = modes.next(opening, before.modes);
  const Openings<T> share = modes.share(opening, next, modes.failed(before.modes));
  if constexpr (!Faces::part) {
    return {share, {next, before.parted}};
  } else {
    const T holds = holding(before);
    const T parted =
        holds * select(part_now(modes, at, area, before.modes), T(0.5), T(0)) + (T(1) - holds) * before.parted;
    return {{holds * share.normal, holds * share.shear}, {next, parted}};
  }
}

/// Forces on the two elements.
template <class Modes, class Faces, class T>
[[gnu::always_inline]] inline Wrench<T> cohesive_wrench(const Modes& modes, const Faces& at, Same<T> area,
                                                        const Openings<T>& share) {
  const Vec<T> drag = (-area * share.shear * T(modes.shear.stiffness)) * at.slip;
  const T pull = area * share.normal * T(modes.normal.stiffness) * at.opening.normal;
  return wrench_of(at, pull, drag);
}

/// Energy that goes when this state is accepted and that no history tells [J]: the ledger books it once.
template <class Modes, class Faces, class T>
T cohesive_lost(const Modes& modes, const Faces& at, Same<T> area, const CohesiveHistory<Modes, T>& before,
                const CohesiveHistory<Modes, T>& after) {
  const Openings<T> opening = felt_opening(at, before);
  const T held = held_energy(modes, area, opening, modes.share(opening, after.modes, modes.failed(after.modes)));
  return area * modes.released(opening, before.modes, after.modes) + select(after.parted > before.parted, held, T(0));
}

}  // namespace beadwork
