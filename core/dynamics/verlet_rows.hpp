#pragma once
// What velocity Verlet does with elements, one or a pack of them at a time.   Eqs (1), (2); docs/theory/verlet.md
//
// A step ends with velocities half a step behind the places, and the next one brings them to the full step and on to
// the middle in one pass: elements are read and written once a step instead of twice. Whoever wants to see velocities
// has them completed first.

#include "core/domain/rows.hpp"
#include "core/dynamics/motion.hpp"
#include "core/mechanics/verlet.hpp"

namespace beadwork {

struct VerletRows {
  Motion all;
  Real dt;
  Real half;  ///< beta dt / 2

  /// Places and orientations at the next time, velocities half-way there; `behind`: these stand half-way of the step
  /// before. True where a load is an infinity or no number.
  template <bool behind, class At>
  [[gnu::always_inline]] auto advance(const At& at) const {
    using T = typename At::Number;
    const Vec<T> force = at(all.force);
    const Vec<T> a = (T(1) / at(all.mass)) * force;
    const Vec<T> v = full<behind, T>(at(all.velocity), a);
    at.set(all.place, beadwork::advance<T>(at(all.place), v, a, T(dt)));
    at.set(all.velocity, v + T(half) * a);
    T load = force[0] + force[1] + force[2];
    if (all.spin) {
      const Vec<T> torque = at(all.torque);
      const Vec<T> alpha = (T(1) / at(all.inertia)) * torque;
      const Vec<T> spin = full<behind, T>(at(all.spin), alpha);
      at.set(all.orientation, turn<T>(at(all.orientation), spin, alpha, T(dt)));
      at.set(all.spin, spin + T(half) * alpha);
      load = load + torque[0] + torque[1] + torque[2];
    }
    return !(load - load >= T(0));
  }

  /// Velocities from half-way to the full step.
  template <class At>
  [[gnu::always_inline]] auto complete(const At& at) const {
    using T = typename At::Number;
    const Vec<T> force = at(all.force);
    at.set(all.velocity, full<true, T>(at(all.velocity), (T(1) / at(all.mass)) * force));
    T load = force[0] + force[1] + force[2];
    if (all.spin) {
      const Vec<T> torque = at(all.torque);
      at.set(all.spin, full<true, T>(at(all.spin), (T(1) / at(all.inertia)) * torque));
      load = load + torque[0] + torque[1] + torque[2];
    }
    return !(load - load >= T(0));
  }

 private:
  template <bool behind, class T>
  [[gnu::always_inline]] Vec<T> full(const Vec<T>& rate, const Vec<T>& gained) const {
    if constexpr (behind)
      return rate + T(half) * gained;
    else
      return rate;
  }
};

}  // namespace beadwork
