#pragma once
// Re-arrangement: elements push each other apart until the forces balance.

#include "core/packing/crowd.hpp"

namespace beadwork::packing {

/// Frictionless linear repulsion of unit stiffness between elements and at the walls, brought to balance by
/// FIRE (Bitzek et al., Phys. Rev. Lett. 97, 170201, 2006). Ends when the residual (rms net force on an element over
/// the mean contact force) or the pressure (overlap summed over contacts, walls included, per element) is small
/// enough, and always after `max_steps`.
void settle(Crowd&, Neighbours&, int max_steps, Real residual, Real pressure = 1e-9);

}  // namespace beadwork::packing
