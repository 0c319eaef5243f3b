#pragma once
// Which damping gives a coefficient of restitution, of a contact that pushes only: it ends when its force does.

#include <cmath>

#include "core/base/types.hpp"

namespace beadwork {

/// Speed after over speed before of x'' = -f(x), f = max(0, x^p + 2 zeta g(x) x'), g = 1 for p = 1 and sqrt(p x^(p-1))
/// else: in units of the contact the speed of impact drops out. By Runge and Kutta's fourth order.
Real restitution_of(Real exponent, Real zeta);
/// The zeta that gives it, 0 < restitution <= 1. Throws std::invalid_argument where none does.
Real damping_for(Real exponent, Real restitution);

}  // namespace beadwork
