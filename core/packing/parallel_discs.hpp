#pragma once
// Random places for parallel fibres: the discs of their cross-section in a rectangle.

#include <cstdint>
#include <vector>

#include "core/base/pause.hpp"
#include "core/base/types.hpp"

namespace beadwork::packing {

using Place = Eigen::Matrix<Real, 2, 1>;

struct Discs {
  Place low, high;  ///< corners of the rectangle that their centres lie in
  Real distance;    ///< least one of two centres
  std::size_t count;
  std::uint64_t seed = 1;
  Pause pause = never_paused;
};

/// Centres of hard discs, by Monte Carlo moves: they start anywhere, and what counts as overlap grows with the least
/// distance that there is, until it is the one asked for; then they are stirred. Reaches what random insertion cannot
/// (an area fraction of .547 at most, Feder 1980), up to about .7. Throws PackingFailure where they do not fit, which
/// tells how far it came; docs/theory/packing.md.
std::vector<Place> place_discs(const Discs&);

}  // namespace beadwork::packing
