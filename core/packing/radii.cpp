#include "core/packing/radii.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>

#include "core/base/random.hpp"

namespace beadwork::packing {
namespace {

Real normal_cumulative(Real x) { return std::erfc(-x / std::numbers::sqrt2) / 2; }

/// A Gaussian much wider than the cut is flat between the cuts (and its formula loses its digits).
bool flat(const Dispersion& d) { return d.law == RadiusLaw::uniform || d.deviation > 100 * d.spread; }

/// The radius below which a share u of the radii lies.
Real quantile(const Dispersion& d, Real u) {
  if (flat(d)) return 1 + d.spread * (2 * u - 1);
  Real low = 1 - d.spread, high = 1 + d.spread;
  for (int k = 0; k < 60; ++k) {
    const Real middle = (low + high) / 2;
    (cumulative(d, middle) < u ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace

void check(const Dispersion& d) {
  if (!(d.spread >= 0 && d.spread < 1))
    throw std::invalid_argument(
        "the spread of the radii must be at least 0 and below 1 (radii lie between 1 - spread and 1 + spread times "
        "their mean), got " +
        std::to_string(d.spread));
  if (d.law == RadiusLaw::truncated_gaussian && !(std::isfinite(d.deviation) && d.deviation > 0))
    throw std::invalid_argument("the standard deviation of the radii must be positive, got " +
                                std::to_string(d.deviation));
}

std::vector<Real> draw_radii(const Dispersion& d, std::size_t count, std::uint64_t seed, const Pause& pause) {
  Random random(seed, 1);
  std::vector<Real> radii(count);
  for (std::size_t k = 0; k < count; ++k) {
    if (k % 16384 == 0) pause();
    radii[k] = quantile(d, (Real(k) + random.uniform()) / Real(count));
  }
  for (std::size_t k = count; k > 1; --k) std::swap(radii[k - 1], radii[random.bits() % k]);
  return radii;
}

Real cumulative(const Dispersion& d, Real r) {
  if (d.spread == 0) return r < 1 ? 0 : 1;
  const Real t = std::clamp(r - 1, -d.spread, d.spread);
  if (flat(d)) return (t + d.spread) / (2 * d.spread);
  const Real cut = normal_cumulative(-d.spread / d.deviation);
  return (normal_cumulative(t / d.deviation) - cut) / (1 - 2 * cut);
}

Real mean_cube(const Dispersion& d) {
  if (flat(d)) return 1 + d.spread * d.spread;
  constexpr int classes = 1000;
  Real sum = 0;
  for (int k = 0; k < classes; ++k) sum += std::pow(quantile(d, (k + 0.5) / classes), 3);
  return sum / classes;
}

Real kolmogorov_distance(const Dispersion& d, std::span<const Real> radius) {
  if (radius.empty() || d.spread == 0) return 0;
  std::vector<Real> r(radius.begin(), radius.end());
  std::sort(r.begin(), r.end());
  const Real mean = std::accumulate(r.begin(), r.end(), Real(0)) / Real(r.size());
  Real distance = 0;
  for (std::size_t k = 0; k < r.size(); ++k) {
    const Real F = cumulative(d, r[k] / mean);
    distance = std::max({distance, std::abs(F - Real(k) / Real(r.size())), std::abs(F - Real(k + 1) / Real(r.size()))});
  }
  return distance;
}

}  // namespace beadwork::packing
