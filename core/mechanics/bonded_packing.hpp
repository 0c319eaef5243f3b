#pragma once
// What a packing of equal spheres that are joined by beams is like as a solid, if all bonds follow the mean strain:
// first guesses, from above.   docs/theory/calibration.md

#include <numbers>

#include "core/base/types.hpp"

namespace beadwork {

struct BondedPacking {
  Real coordination;  ///< bonds of an element
  Real density;       ///< share of the volume that is in elements
  Real radius_ratio;  ///< of a beam's section to the elements' mean radius
};

/// E_M / E_mu from the bulk modulus, which bends no beam: Z phi/4 (1 - 2 nu) r~^2.
inline Real stiffness_ratio(const BondedPacking& packing, Real poisson) {
  return 0.25 * packing.coordination * packing.density * (1 - 2 * poisson) * packing.radius_ratio *
         packing.radius_ratio;
}

/// Mean axial stress of the bonds over the uniaxial stress of the solid: 4 / (3 Z phi r~^2), from the trace of the
/// virial.
inline Real axial_stress_ratio(const BondedPacking& packing) {
  return 4 / (3 * packing.coordination * packing.density * packing.radius_ratio * packing.radius_ratio);
}

/// Mean hydrostatic stress of the elements over the uniaxial stress of the solid: 1 / (3 phi).
inline Real hydrostatic_stress_ratio(const BondedPacking& packing) { return 1 / (3 * packing.density); }

}  // namespace beadwork
