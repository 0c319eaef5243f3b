#include "core/mechanics/restitution.hpp"

#include <algorithm>
#include <stdexcept>

namespace beadwork {

// The overlap x grows from 0 at speed 1. A unit of time is that of the contact, as its stiffness and mass are 1.
Real restitution_of(Real exponent, Real zeta) {
  const auto force = [&](Real x, Real v) {
    if (x < 0) return Real(0);
    const Real g = exponent == 1 ? 1 : std::sqrt(exponent * std::pow(x, exponent - 1));
    return std::pow(x, exponent) + 2 * zeta * g * v;
  };
  Real x = 0, v = 1;
  const Real dt = 1e-3;
  for (int step = 0; step < 200000; ++step) {
    const Real a1 = -force(x, v), a2 = -force(x + dt / 2 * v, v + dt / 2 * a1);
    const Real v2 = v + dt / 2 * a1, v3 = v + dt / 2 * a2;
    const Real a3 = -force(x + dt / 2 * v2, v3), v4 = v + dt * a3;
    const Real a4 = -force(x + dt * v3, v4);
    const Real x_next = x + dt / 6 * (v + 2 * v2 + 2 * v3 + v4), v_next = v + dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    if (v_next < 0 && (x_next <= 0 || force(x_next, v_next) <= 0)) return -v_next;
    x = x_next, v = v_next;
  }
  return 0;
}

Real damping_for(Real exponent, Real restitution) {
  if (!(restitution > 0 && restitution <= 1)) throw std::invalid_argument("a restitution is above 0 and at most 1");
  if (restitution == 1) return 0;
  Real low = 0, high = 1;
  while (restitution_of(exponent, high) > restitution) {
    high *= 2;
    if (high > 1e3) throw std::invalid_argument("no damping gives so small a restitution");
  }
  for (int round = 0; round < 50; ++round) {
    const Real middle = 0.5 * (low + high);
    (restitution_of(exponent, middle) > restitution ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace beadwork
