#pragma once
// How large the elements are: a mean, a spread and a law.

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/pause.hpp"
#include "core/base/types.hpp"

namespace beadwork::packing {

enum class RadiusLaw { uniform, truncated_gaussian };

/// Radii lie in [1 - spread, 1 + spread] times the mean. The Gaussian has the given standard deviation
/// (relative to the mean) before it is cut at both ends.
struct Dispersion {
  RadiusLaw law = RadiusLaw::uniform;
  Real spread = 0.25;
  Real deviation = 0.125;
};

/// Throws std::invalid_argument unless 0 <= spread < 1 and the deviation is positive.
void check(const Dispersion&);

/// `count` radii with mean 1, in the order drawn. The sample is stratified: one radius in each of `count`
/// equally likely classes, shuffled; so mean and histogram of a small specimen are those of the law.
std::vector<Real> draw_radii(const Dispersion&, std::size_t count, std::uint64_t seed,
                             const Pause& pause = never_paused);

/// Share of radii below r (mean 1).
Real cumulative(const Dispersion&, Real r);
/// Mean of r^3 (mean of r is 1).
Real mean_cube(const Dispersion&);
/// Largest distance between the sample's cumulative curve and the law's, with the sample's mean as unit.
Real kolmogorov_distance(const Dispersion&, std::span<const Real> radius);

}  // namespace beadwork::packing
