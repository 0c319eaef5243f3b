#pragma once
// How far a packing is from random: do neighbours see the same directions around them?

#include "core/packing/crowd.hpp"

namespace beadwork::packing {

struct Order {
  Real correlation = 0;  ///< mean over pairs of neighbours; 1 in a crystal, about .2 in a random packing
  Real crystalline = 0;  ///< share of the elements with 7 or more neighbours of correlation above .7
};

/// ten Wolde, Ruiz-Montero and Frenkel, J. Chem. Phys. 104, 9932 (1996), with l = 6. Instead of spherical
/// harmonics their addition theorem is used: the product of two elements is the mean of P6(cos) over pairs of
/// their directions. Zeros where elements are heaped on one another, 60 around each, and the measure says nothing.
Order bond_order(const Crowd&);

}  // namespace beadwork::packing
