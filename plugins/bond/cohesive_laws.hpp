#pragma once
// The laws of a cohesive contact as the loop over bonds runs them: one for each way of finding the opening, and each
// choice of modes.

#include "core/mechanics/cohesive_stiffness.hpp"
#include "core/plugin/bond_law_of.hpp"

namespace beadwork {

/// Columns of the contacts; null where no law of the deck has need of them, or nobody reads them.
struct CohesiveColumns {
  View<const Real> length, area;
  View<const Vec3> arm1, arm2, normal1, normal2;
  View<Real> largest_opening, largest_sliding;  // what independent modes remember
  View<Real> integrity, mix;                    // what coupled modes remember
  View<Real> parted;                            // faces with a normal of their own
  View<Real> extra_dissipation;
  View<Real> damage, opening, sliding;

  template <class At>
  [[gnu::always_inline]] auto rest(const At& at) const {
    return CohesiveRest<typename At::Number>{at(length), at(area)};
  }
};

/// Opening of a pair alone: a central force, and no rotations.   Eqs (3)-(5)
struct CohesiveOpening : CohesiveColumns {
  static constexpr bool turns = false;
  Softening<Real> law;

  template <Pass pass, class At, class T>
  [[gnu::always_inline]] Wrench<T> act(const At& at, const Ends<T>& ends) const {
    const T history = at(largest_opening);
    const CohesivePull<T> pull = cohesive_pull<T>(as<T>(law), rest(at), ends.apart, history);
    if constexpr (pass.settle) {
      at.store(largest_opening, pull.history);
      at.flag(newly(history, pull.history, law.onset) || newly(history, pull.history, law.open));
    }
    if constexpr (pass.sections) {
      if (damage) at.store(damage, beadwork::damage<T>(as<T>(law), pull.history));
      if (opening) at.store(opening, normal_opening<T>(rest(at), ends.apart));
    }
    return {pull.force, zero<Vec<T>>(), zero<Vec<T>>()};
  }

  template <class At, class T>
  T stored(const At& at, const Ends<T>& ends) const {
    const auto r = rest(at);
    return r.area * stored_per_area<T>(as<T>(law), normal_opening<T>(r, ends.apart), at(largest_opening));
  }

  template <class At>
  auto dissipated(const At& at) const {
    return at(area) * dissipated_per_area<Real>(law, at(largest_opening));
  }

  Matrix12 stiffness(const One& at, const Ends<Real>& ends, Slope slope) const {
    return opening_stiffness(law, rest(at), ends.apart, at(largest_opening), slope);
  }
  bool has_failed(const One& at) const { return at(largest_opening) >= law.open; }
  bool softens(const One& at) const { return at(largest_opening) > law.onset; }
  bool has_slid(const One&) const { return false; }
  bool parts(const One&) const { return false; }

 private:
  template <class T>
  static auto newly(const T& before, const T& after, Real mark) {
    return before < T(mark) && after >= T(mark);
  }
};

/// All others: the faces of a pair, or faces that carry a normal; modes that are independent, or coupled.
template <bool carried, class Modes>
struct CohesiveFaces : CohesiveColumns {
  static constexpr bool turns = true;
  Modes modes;

  template <Pass pass, class At, class T>
  [[gnu::always_inline]] Wrench<T> act(const At& at, const TurningEnds<T>& ends) const {
    const auto here = faces(at, ends);
    const T size = at(area);
    const auto before = recall(at);
    const auto now = cohesive_state<Modes>(modes, here, size, before);
    if constexpr (pass.settle) {
      if constexpr (carried || Modes::releases)
        at.store(extra_dissipation, at(extra_dissipation) + cohesive_lost<Modes>(modes, here, size, before, now.after));
      remember(at, now.after);
      at.flag((modes.softens(now.after.modes) && !modes.softens(before.modes)) ||
              (modes.failed(now.after.modes) && !modes.failed(before.modes)) || now.after.parted > before.parted);
    }
    if constexpr (pass.sections) {
      if (opening) at.store(opening, here.opening.normal);
      if (sliding) at.store(sliding, here.opening.shear);
      if (damage) at.store(damage, select(now.after.parted > T(0), T(1), modes.damage(now.after.modes)));
    }
    return cohesive_wrench(modes, here, size, now.share);
  }

  /// Forces of this step that act no more from its end on: of a mode that held until the other failed, or of faces that
  /// part.
  Wrench<Real> ended(const One& at, const TurningEnds<Real>& ends) const {
    const auto here = faces(at, ends);
    const auto history = recall(at);
    const bool done = modes.failed(history.modes);
    const Openings<Real> after = modes.share(here.opening, history.modes, done);
    if (parts(history)) return cohesive_wrench(modes, here, at(area), after);
    const Openings<Real> before = modes.share(here.opening, history.modes, false);
    return cohesive_wrench(modes, here, at(area),
                           Openings<Real>{before.normal - after.normal, before.shear - after.shear});
  }
  bool parts(const One& at) const { return parts(recall(at)); }

  template <class At, class T>
  T stored(const At& at, const TurningEnds<T>& ends) const {
    const auto here = faces(at, ends);
    const T size = at(area);
    return held_energy(modes, size, here.opening, cohesive_state<Modes>(modes, here, size, recall(at)).share);
  }

  template <class At>
  auto dissipated(const At& at) const {
    const auto softened = at(area) * modes.dissipated(recall(at).modes);
    if constexpr (carried || Modes::releases)
      return softened + at(extra_dissipation);
    else
      return softened;
  }

  Matrix12 stiffness(const One& at, const TurningEnds<Real>& ends, Slope slope) const {
    const auto here = faces(at, ends);
    const Real size = at(area);
    const Openings<Real> all{1, 1};
    return shared_stiffness(
        modes, here, size, slope == Slope::stiffest ? all : cohesive_state<Modes>(modes, here, size, recall(at)).share);
  }
  bool has_failed(const One& at) const { return modes.failed(recall(at).modes) || recall(at).parted > 0; }
  bool softens(const One& at) const { return modes.softens(recall(at).modes); }
  /// Of a contact that has failed: by sliding, rather than by opening.
  bool has_slid(const One& at) const {
    const auto history = recall(at);
    return !modes.failed(history.modes) || modes.slid(history.modes);
  }

 private:
  static bool parts(const CohesiveHistory<Modes, Real>& history) { return history.parted > 0 && history.parted < 1; }

  template <class At, class T>
  [[gnu::always_inline]] auto faces(const At& at, const TurningEnds<T>& ends) const {
    const ContactArms<T> arms{at(arm1), at(arm2)};
    if constexpr (carried)
      return carried_faces<T>(arms, {at(normal1), at(normal2)}, ends.apart, ends.q1, ends.q2);
    else
      return pair_faces<T>(at(length), arms, ends.apart, ends.q1, ends.q2);
  }

  template <class At>
  [[gnu::always_inline]] auto recall(const At& at) const {
    using T = typename At::Number;
    CohesiveHistory<Modes, T> history{{T(0), T(0)}, T(0)};
    if constexpr (Modes::coupled)
      history.modes = {at(integrity), at(mix)};
    else if constexpr (!Modes::slides)
      history.modes.normal = at(largest_opening);
    else if constexpr (!Modes::opens)
      history.modes.shear = at(largest_sliding);
    else
      history.modes = {at(largest_opening), at(largest_sliding)};
    if constexpr (carried) history.parted = at(parted);
    return history;
  }

  template <class At, class T>
  [[gnu::always_inline]] void remember(const At& at, const CohesiveHistory<Modes, T>& history) const {
    if constexpr (Modes::coupled) {
      at.store(integrity, history.modes.integrity);
      at.store(mix, history.modes.mix);
    } else {
      if constexpr (Modes::opens) at.store(largest_opening, history.modes.normal);
      if constexpr (Modes::slides) at.store(largest_sliding, history.modes.shear);
    }
    if constexpr (carried) at.store(parted, history.parted);
  }
};

}  // namespace beadwork
