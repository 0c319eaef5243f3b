#include "core/packing/sizing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "core/base/memory.hpp"
#include "core/base/parallel.hpp"
#include "core/domain/domain.hpp"
#include "core/packing/even_points.hpp"
#include "core/packing/insertion.hpp"

namespace beadwork::packing {
namespace {

// Recorded: packings of spread .25 at Z = 6.2 end within 1.5 % of the radius that these two figures give,
// between 5 and 100 elements across.
constexpr Real bulk_density = 0.65;
constexpr Real empty_layer = 0.15;

[[noreturn]] void refuse(const std::string& what) { throw std::invalid_argument(what); }

template <class... Parts>
std::string text(const Parts&... parts) {
  std::ostringstream out;
  (out << ... << parts);
  return out.str();
}

// An element, and the lists of its neighbours and contacts, while it is arranged: more, rather than less.
constexpr Real bytes_of_element = 400;

/// Of the points that are clear of obstacles by the margin, and that an element of that radius can cover.
Real share_clear(const Region& region, const Obstacles& around, Real margin, Real radius) {
  constexpr std::uint64_t points = 100000;
  // Cells need not be as small as the margin where the region is large.
  InsertionGrid grid(region, std::max({margin, 2 * radius, inradius(region) / 20}));
  for (std::size_t k = 0; k < around.position.size(); ++k) grid.add_obstacle({around.position[k], around.radius[k]});
  const auto clear = sum_shared<std::uint64_t>(
      points, std::uint64_t{1024}, [&](std::uint64_t begin, std::uint64_t end, std::uint64_t& sum) {
        for (std::uint64_t k = begin; k < end; ++k) {
          const Vec3 x = point_in(region, even_point(k));
          sum += grid.clear_of_obstacles(x, margin) && (radius <= 0 || grid.reachable(x, radius));
        }
      });
  return Real(clear) / Real(points);
}

void check(const Request& q) {
  check(q.region);
  check(q.dispersion);
  if (q.count && q.mean_radius) {
    const Real phi = Real(*q.count) * 4 / 3 * std::numbers::pi * std::pow(*q.mean_radius, 3) * mean_cube(q.dispersion) /
                     volume(q.region);
    refuse(text("count and mean radius are both given: together they ask for a volume fraction of ", phi,
                ", while a random packing ends near 0.64; give one of the two, the other follows"));
  }
  if (!q.count && !q.mean_radius) refuse("neither the count nor the mean radius of the elements is given");
  if (q.count && *q.count < 1) refuse(text("the count of elements must be at least 1, got ", *q.count));
  if (q.count && Real(*q.count) > most_elements)
    refuse(text("the count of elements must be at most ", most_elements, ", got ", *q.count));
  if (q.mean_radius && !(std::isfinite(*q.mean_radius) && *q.mean_radius > 0))
    refuse(text("the mean radius must be positive, got ", *q.mean_radius));
  if (q.tries < 1) refuse(text("the number of tries must be at least 1, got ", q.tries));
  if (q.around.position.size() != q.around.radius.size()) refuse("obstacles need one radius for each position");
  for (std::size_t k = 0; k < q.around.position.size(); ++k)
    if (!q.around.position[k].allFinite() || !(std::isfinite(q.around.radius[k]) && q.around.radius[k] >= 0))
      refuse(text("obstacle ", k, " has a position or radius that is negative or not finite"));
}

Real smallest(const Request& q) { return 1 - q.dispersion.spread; }

Real largest_fitting(const Request& q) { return inradius(q.region) / (1 + q.dispersion.spread); }

Sizing from_mean_radius(const Request& q) {
  const Real R = *q.mean_radius;
  if (R > largest_fitting(q))
    refuse(text("elements of mean radius ", R, " and spread ", q.dispersion.spread, " do not fit into the ",
                describe(q.region), ": the mean radius can be at most ", largest_fitting(q)));
  const Real room = effective_volume(q.region, q.around, empty_layer * R, smallest(q) * R);
  const Real count = bulk_density * room / (4.0 / 3 * std::numbers::pi * R * R * R * mean_cube(q.dispersion));
  if (count > most_elements)
    refuse(text("elements of mean radius ", R, " would number ", count, "; at most ", most_elements,
                " are possible: enlarge the radius"));
  if (count < 0.5)
    throw PackingFailure("the obstacles leave no room for an element: remove some, or make the mean radius smaller");
  return {static_cast<std::size_t>(std::lround(count)), R};
}

Sizing from_count(const Request& q) {
  const Real count = Real(*q.count);
  Real R = largest_fitting(q);
  for (int k = 0; k < 8; ++k) {
    const Real room =
        effective_volume(q.region, q.around, std::min(empty_layer * R, inradius(q.region) / 2), smallest(q) * R);
    const Real before = R;
    R = std::cbrt(bulk_density * room / (count * 4 / 3 * std::numbers::pi * mean_cube(q.dispersion)));
    R = std::min(R, largest_fitting(q));
    if (std::abs(R - before) < 1e-3 * before) break;
  }
  if (!(R > 0)) throw PackingFailure("the obstacles leave no room for an element: remove some, or enlarge the region");
  const Real solid = count * 4 / 3 * std::numbers::pi * R * R * R * mean_cube(q.dispersion);
  const Real share = solid / free_volume(q.region, q.around);
  constexpr Real so_few = 0.01;
  if (share < so_few)
    throw PackingFailure(text("the region is too thin for so few elements: ", *q.count,
                              " of them, no larger than fits between its walls (mean radius ", R,
                              "), take up a share of ", share, " of it; make the region thicker, or ask for about ",
                              count * bulk_density / share, " elements"));
  return {static_cast<std::size_t>(*q.count), R};
}

}  // namespace

Real effective_volume(const Region& region, const Obstacles& around, Real layer, Real radius) {
  if (layer >= inradius(region)) return 0;
  const Region inner = layer > 0 ? shrunk(region, layer) : region;
  return volume(inner) * (around.position.empty() ? 1 : share_clear(inner, around, layer, radius));
}

Real free_volume(const Region& region, const Obstacles& around) { return effective_volume(region, around, 0, 0); }

Sizing sizing_of(const Request& q) {
  check(q);
  const Sizing sizing = q.count ? from_count(q) : from_mean_radius(q);
  if (const std::string why = why_no_memory(Real(sizing.count), "elements", bytes_of_element); !why.empty())
    throw PackingFailure(why);
  return sizing;
}

}  // namespace beadwork::packing
