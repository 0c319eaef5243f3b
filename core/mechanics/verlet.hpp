#pragma once
// One step of velocity Verlet with numerical damping beta, for places and for orientations.   Eqs (1), (2)
// Advance, find the forces, then correct.                                             docs/theory/verlet.md

#include "core/mechanics/rotation.hpp"

namespace beadwork {

/// p(t+dt), Eq (1).
template <class T>
[[gnu::always_inline]] inline Vec<T> advance(const Vec<T>& p, const Vec<T>& v, const Vec<T>& a, Same<T> dt) {
  return p + dt * (v + (T(0.5) * dt) * a);
}

/// v(t+dt), Eq (2); spins alike. Stable for 0 < beta <= 1 below the critical step, for no step with beta > 1.
template <class T>
[[gnu::always_inline]] inline Vec<T> correct(const Vec<T>& v, const Vec<T>& a, const Vec<T>& a_next, Same<T> beta,
                                             Same<T> dt) {
  return v + (T(0.5) * beta * dt) * (a + a_next);
}

/// q(t+dt) = exp(dt w + dt^2/2 alpha) q, spin w and its rate alpha in the world, at most 2 rad a step.
/// Without the alpha term the scheme is of first order and gains energy until it blows up.
template <class T>
[[gnu::always_inline]] inline Quaternion<T> turn(const Quaternion<T>& q, const Vec<T>& w, const Vec<T>& alpha,
                                                 Same<T> dt) {
  return renormalise(increment(dt * (w + (T(0.5) * dt) * alpha)) * q);
}

}  // namespace beadwork
