#pragma once
// Re-arrangement: elements push each other apart until the forces balance.

#include "core/packing/crowd.hpp"

namespace beadwork::packing {

struct Settled {
  int steps = 0;
  Real residual = 0;  ///< rms net force on an element / mean contact force
  Real pressure = 0;  ///< overlap summed over contacts, walls included, per element
};

/// Frictionless linear repulsion of unit stiffness between elements and at the walls, brought to balance by
/// FIRE (Bitzek et al., Phys. Rev. Lett. 97, 170201, 2006). Ends when the residual or the pressure is small
/// enough, and always after `max_steps`.
Settled settle(Crowd&, Neighbours&, int max_steps, Real residual, Real pressure = 1e-9);

}  // namespace beadwork::packing
