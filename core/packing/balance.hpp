#pragma once
// Radii that make all elements equally pressed, where rooms between obstacles cannot exchange elements.

#include "core/packing/packing.hpp"

namespace beadwork::packing {

struct Crowd;

/// Between obstacles that are hardly an element apart each element stays in the room that it was put into, and one
/// common radius leaves some rooms loose when others are full. So, of the elements within 3 mean radii of an obstacle,
/// those that are pressed too much shrink and the others grow, a little at a time, while all push each other apart, for
/// 40 rounds at most. The law's range, from `1 - spread` to `1 + spread` of the mean, is kept but for what the mean
/// itself changes by. The radii of all other elements stay. docs/theory/packing.md
void balance(Crowd&, Real spread, const Tell&);

}  // namespace beadwork::packing
