#pragma once
// What came out: the figures by which a packing is judged.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/types.hpp"
#include "core/packing/packing.hpp"

namespace beadwork::packing {

/// Contacts of an element with other elements (obstacles included, walls not), mean over the elements.
struct Coordination {
  Real all = 0;
  Real without_rattlers = 0;  ///< rattlers: elements with fewer than four contacts, walls included, found repeatedly
  Real bulk = 0;              ///< over the elements farther than 3 mean radii from the walls
};

/// How the elements stand around obstacles, such as a fibre: those whose gap to the nearest is below half a mean radius.
/// Gaps are over the sum of the two radii.
struct Surroundings {
  std::size_t near = 0;      ///< elements
  std::size_t touching = 0;  ///< those within the report's tolerance: what contacts are made of
  Real least_gap = 0, mean_gap = 0, largest_gap = 0;
  std::size_t inside = 0;  ///< elements whose centre lies in an obstacle
};

struct PackingReport {
  std::size_t count = 0;
  std::uint64_t seed = 0;
  Real seconds = 0;
  Coordination touching;  ///< gap <= 1e-6 (R1 + R2)
  Coordination near;      ///< gap <= tolerance (R1 + R2): what bonds are made of
  Real tolerance = 0;
  Real rattlers = 0;             ///< share of the elements
  Real max_overlap = 0;          ///< overlap / (R1 + R2), over all pairs and, over R, all walls
  Real mean_overlap = 0;         ///< over the pairs that overlap
  std::array<Real, 3> fabric{};  ///< eigenvalues of <n n> over the near contacts, rising; their sum is 1
  std::array<Real, 3> fabric_bulk{};
  Real density = 0;       ///< volume of the elements / volume of the region outside the obstacles
  Real density_bulk = 0;  ///< volume fraction farther than 3 mean radii from walls and obstacles
  std::size_t bulk_count = 0;
  Surroundings around;  ///< all zero where there are no obstacles
  Real mean_radius = 0, min_radius = 0, max_radius = 0;
  std::vector<Real> histogram_edges;  ///< R / mean R
  std::vector<std::size_t> histogram;
  Real kolmogorov = 0;         ///< distance of the radii from the law asked for
  Real bond_order = 0;         ///< mean correlation of the bond directions of neighbours (l = 6): 1 in a crystal
  Real crystalline_share = 0;  ///< elements whose surroundings agree with those of 7 neighbours or more
};

/// Figures of a packing; `tolerance` is the gap by which bonds are to be made.
PackingReport report(const Packing&, Real tolerance = 1e-3);

/// Share of the volume farther than `margin` from walls and obstacles that lies in elements; 0 if there is no
/// such volume. Counted on evenly spread points: good to about .001.
Real density_in_bulk(const Packing&, Real margin);

/// The packing that stored positions and radii make, to be reported on.
Packing packing_of(const Region&, const Dispersion&, std::vector<Vec3> position, std::vector<Real> radius);

}  // namespace beadwork::packing
