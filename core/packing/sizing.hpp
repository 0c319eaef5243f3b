#pragma once
// How many elements, how large: the one follows from the other and from the room there is.

#include <cstddef>

#include "core/packing/packing.hpp"

namespace beadwork::packing {

struct Sizing {
  std::size_t count;
  Real mean_radius;
};

/// Throws std::invalid_argument on a malformed request, PackingFailure if there is no room.
Sizing sizing_of(const Request&);

/// Volume that behaves as if it were filled to the density of the bulk: next to walls and obstacles a layer
/// of this thickness counts as empty, and so do crevices between obstacles that an element of this radius does not fit
/// into.
Real effective_volume(const Region&, const Obstacles&, Real layer, Real radius);

/// Volume of the region outside the obstacles.
Real free_volume(const Region&, const Obstacles&);

}  // namespace beadwork::packing
