#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>

#include "core/packing/blocks.hpp"
#include "core/packing/order_measure.hpp"
#include "core/packing/packing.hpp"
#include "core/packing/projection.hpp"
#include "core/packing/settle.hpp"

namespace beadwork::packing {
namespace {

constexpr Real skin = 0.35;
constexpr Real wide_spread = 0.4;

void check(const Relaxation& rule) {
  if (!(std::isfinite(rule.overlap) && rule.overlap > 0))
    throw std::invalid_argument("the overlap that relaxation may leave must be positive, got " +
                                std::to_string(rule.overlap));
  if (!(rule.radius_change >= 0 && rule.radius_change < 0.5))
    throw std::invalid_argument(
        "the share by which relaxation may change a radius must be at least 0 and below 0.5, got " +
        std::to_string(rule.radius_change));
}

/// The share by which each radius must shrink for its last overlap to vanish.
std::vector<Real> shrinkage_of_each(const Crowd& crowd, Neighbours& neighbours) {
  const NeighbourList& list = neighbours.of(crowd);
  std::vector<Real> share(crowd.moving, 0);
  for_each(crowd.moving, [&](std::size_t i) {
    const Ball& a = crowd.ball[i];
    for (std::size_t w = 0; w < crowd.walls.size(); ++w)
      share[i] = std::max(share[i], 1 - crowd.walls.view(w, a.x).distance / a.r);
    for (const Index j : list.of(i)) {
      const Ball& b = crowd.ball[std::size_t(j)];
      const Real overlap = a.r + b.r - (b.x - a.x).norm();
      share[i] = std::max(share[i], overlap / (std::size_t(j) < crowd.moving ? a.r + b.r : a.r));
    }
  });
  return share;
}

/// For all radii to shrink alike.
Real shrinkage_needed(const Crowd& crowd, Neighbours& neighbours) {
  const std::vector<Real> share = shrinkage_of_each(crowd, neighbours);
  return share.empty() ? 0 : *std::max_element(share.begin(), share.end());
}

/// Beside obstacles a few may find no room, however much the others have.
void shrink_those_that_overlap(Crowd& crowd, Neighbours& neighbours) {
  constexpr Real much = 1e-6;
  const std::vector<Real> share = shrinkage_of_each(crowd, neighbours);
  for (std::size_t i = 0; i < crowd.moving; ++i)
    if (share[i] > much) crowd.ball[i].r *= 1 - share[i];
}

void tell_of_overlap(const Tell& tell, const char* which, Real overlap) {
  tell((std::ostringstream() << which << " overlap " << overlap).str());
}

/// Radii shrink together, each time by a little more than the mean overlap, and the forces balance again: the
/// overlap falls in proportion to the distance from the jamming point.
void decompress(Crowd& crowd, Neighbours& neighbours, const Tell& tell) {
  constexpr Real small = 2e-5;
  for (int round = 0; round < 15; ++round) {
    settle(crowd, neighbours, 500, 0.02);
    const Real mean = mean_overlap(crowd, neighbours);
    tell_of_overlap(tell, "mean", mean);
    if (mean < small) return;
    scale_radii(crowd, 1 - 1.5 * mean);
  }
}

template <class... Parts>
void warn(Packing& packing, const Parts&... parts) {
  std::ostringstream out;
  (out << ... << parts);
  packing.warnings.push_back(out.str());
}

/// Contacts per element, counting gaps up to a thousandth: what bonds will be made of.
Real coordination_with_gap(Crowd crowd) {
  scale_radii(crowd, 1.001);
  Neighbours neighbours(skin);
  return coordination(crowd, neighbours);
}

void warn_of_lost_contacts(Packing& packing, const Crowd& crowd, Real before) {
  const Real after = coordination_with_gap(crowd);
  if (after < before - 0.05)
    warn(packing, "relaxation lowered the coordination number from ", before, " to ", after,
         " (gaps up to .001 counted); ",
         packing.dispersion.spread > wide_spread
             ? "where radii spread so wide, small elements come loose between large ones: let the radii change more, "
               "or narrow the spread"
             : "let the radii change more, widen the spread, or ask for less to begin with");
}

void warn_of_crystal(Packing& packing, const Crowd& crowd) {
  constexpr Real narrow = 0.05, many = 0.02;
  const Order order = bond_order(crowd);
  if (packing.dispersion.spread >= narrow && order.crystalline <= many) return;
  warn(packing, "a spread of the radii of ", packing.dispersion.spread,
       " lets elements crystallise: ", 100 * order.crystalline,
       " % have the surroundings of a crystal (below .1 % at a spread of .25); the solid is ",
       "then not isotropic; use a spread of .1 or more");
}

/// What pressure has pushed into a crevice between obstacles becomes as small as it has to be there: else all others would
/// have to. Returns how many.
std::size_t shrink_lodged(Crowd& crowd) {
  constexpr Real much = 0.03;  // of its own radius: what touches an obstacle reaches into it by the overlap of the rest
  const std::vector<Real> depth = depth_in_obstacles(crowd);
  std::size_t lodged = 0;
  for (std::size_t i = 0; i < crowd.moving; ++i) {
    if (depth[i] <= much) continue;
    crowd.ball[i].r *= 1 - depth[i];
    ++lodged;
  }
  return lodged;
}

void shrink_away_last_overlap(Packing& packing, Crowd& crowd, Neighbours& neighbours, Real goal) {
  if (crowd.ball.size() > crowd.moving) shrink_those_that_overlap(crowd, neighbours);
  const Real left = shrinkage_needed(crowd, neighbours);
  if (left <= goal) return;
  scale_radii(crowd, 1 - left);
  if (left > 1e-3)
    warn(packing, "relaxation left an overlap of ", left, " (R1 + R2): all radii were reduced by that share, which ",
         "opened contacts");
}

}  // namespace

void relaxation(Packing& packing, const Relaxation& rule) {
  const auto start = std::chrono::steady_clock::now();
  check(rule);
  if (packing.position.empty()) throw std::invalid_argument("there are no elements to relax: free filling comes first");
  std::vector<Index> order;
  Crowd crowd = crowd_of(packing, order);
  Neighbours neighbours(skin);
  const Real before = coordination(crowd, neighbours);
  if (const std::size_t lodged = shrink_lodged(crowd); lodged > 0)
    warn(packing, lodged, " elements were lodged between obstacles, and are as small as the crevices there");
  const Real spread = packing.dispersion.spread;
  const Real change = std::min(rule.radius_change, spread / 5);
  if (change > 0)
    project(crowd, neighbours, {1 - spread, 1 + spread, change}, rule.overlap / 2,
            [&](Real largest) { tell_of_overlap(packing.tell, "largest", largest); });
  else
    decompress(crowd, neighbours, packing.tell);
  shrink_away_last_overlap(packing, crowd, neighbours, rule.overlap / 2);
  warn_of_lost_contacts(packing, crowd, before);
  warn_of_crystal(packing, crowd);
  put_back(crowd, order, packing);
  packing.seconds += std::chrono::duration<Real>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace beadwork::packing
