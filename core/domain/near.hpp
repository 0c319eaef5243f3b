#pragma once
// A pair of what may touch.

#include <compare>

#include "core/base/types.hpp"

namespace beadwork {

/// Rows of two elements; or of an element and a wall, and the number of the facet.
struct Near {
  Index first, second;
  Index facet = -1;
  friend auto operator<=>(const Near&, const Near&) = default;
};

}  // namespace beadwork
