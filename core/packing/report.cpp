#include "core/packing/report.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "core/base/parallel.hpp"
#include "core/packing/blocks.hpp"
#include "core/packing/crowd.hpp"
#include "core/packing/even_points.hpp"
#include "core/packing/insertion.hpp"
#include "core/packing/order_measure.hpp"
#include "core/packing/sizing.hpp"

namespace beadwork::packing {
namespace {

constexpr Real touching_gap = 1e-6;
constexpr int rigid_contacts = 4;  // fewer cannot hold a sphere in three dimensions

/// gap / (R1 + R2) of a pair.
Real share(const Crowd& crowd, const Pair& p) {
  const Ball &a = crowd.ball[std::size_t(p.i)], &b = crowd.ball[std::size_t(p.j)];
  return (b.x - a.x).norm() / (a.r + b.r) - 1;
}

std::vector<Pair> contacts_within(const Crowd& crowd, const std::vector<Pair>& near, Real tolerance) {
  std::vector<Pair> contacts;
  for (const Pair& p : near)
    if (share(crowd, p) <= tolerance) contacts.push_back(p);
  return contacts;
}

/// Elements that are not held: fewer than four contacts with walls and with elements that are held
/// themselves.
std::vector<char> rattlers_of(const Crowd& crowd, const std::vector<Pair>& contacts, Real tolerance) {
  const NeighbourList list = neighbours_of(contacts, crowd.ball.size());
  std::vector<int> held(crowd.moving, 0);
  std::vector<char> loose(crowd.moving, 0);
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < crowd.moving; ++i) {
    held[i] = int(list.of(i).size());
    for (std::size_t w = 0; w < crowd.walls.size(); ++w)
      held[i] += crowd.walls.view(w, crowd.ball[i].x).distance <= (1 + tolerance) * crowd.ball[i].r;
    if (held[i] < rigid_contacts) open.push_back(i);
  }
  while (!open.empty()) {
    const std::size_t i = open.back();
    open.pop_back();
    if (loose[i]) continue;
    loose[i] = 1;
    for (const Index j : list.of(i))
      if (std::size_t(j) < crowd.moving && !loose[std::size_t(j)] && --held[std::size_t(j)] < rigid_contacts)
        open.push_back(std::size_t(j));
  }
  return loose;
}

/// Mean number of contacts of the elements that `counts` accepts, with those that `with` accepts and with
/// obstacles.
template <class Counts, class With>
Real mean_contacts(const Crowd& crowd, const std::vector<Pair>& contacts, const Counts& counts, const With& with) {
  std::size_t elements = 0, ends = 0;
  for (std::size_t i = 0; i < crowd.moving; ++i) elements += counts(i);
  const auto accepted = [&](std::size_t i) { return i >= crowd.moving || with(i); };
  for (const Pair& p : contacts) {
    const auto i = std::size_t(p.i), j = std::size_t(p.j);
    ends += i < crowd.moving && counts(i) && accepted(j);
    ends += j < crowd.moving && counts(j) && accepted(i);
  }
  return elements ? Real(ends) / Real(elements) : 0;
}

Coordination coordination_of(const Crowd& crowd, const std::vector<Pair>& contacts, const std::vector<char>& loose,
                             const std::vector<char>& bulk) {
  const auto any = [](std::size_t) { return true; };
  const auto held = [&](std::size_t i) { return !loose[i]; };
  const auto inside = [&](std::size_t i) { return bulk[i] != 0; };
  return {mean_contacts(crowd, contacts, any, any), mean_contacts(crowd, contacts, held, held),
          mean_contacts(crowd, contacts, inside, any)};
}

/// Eigenvalues of <n n> over the contacts of the elements that `counts` accepts, each contact once for each
/// of its ends: leaving out contacts that cross the border would favour directions along it.
template <class Counts>
std::array<Real, 3> fabric_of(const Crowd& crowd, const std::vector<Pair>& contacts, const Counts& counts) {
  Mat3 sum = Mat3::Zero();
  Real ends = 0;
  for (const Pair& p : contacts) {
    const auto i = std::size_t(p.i), j = std::size_t(p.j);
    const Real weight = j < crowd.moving ? Real(counts(i)) + Real(counts(j)) : 0;
    const Vec3 d = crowd.ball[j].x - crowd.ball[i].x;
    if (weight == 0 || !(d.norm() > 0)) continue;
    sum += weight * d * d.transpose() / d.squaredNorm();
    ends += weight;
  }
  if (ends == 0) return {0, 0, 0};
  const Eigen::Vector3d values = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(sum / ends).eigenvalues();
  return {values[0], values[1], values[2]};
}

void report_radii(const Packing& packing, PackingReport& r) {
  const auto& radius = packing.radius;
  r.mean_radius = std::accumulate(radius.begin(), radius.end(), Real(0)) / Real(radius.size());
  const auto [low, high] = std::minmax_element(radius.begin(), radius.end());
  r.min_radius = *low;
  r.max_radius = *high;
  constexpr int classes = 20;
  const Real from = std::min(1 - packing.dispersion.spread, *low / r.mean_radius);
  const Real to = std::max(1 + packing.dispersion.spread, *high / r.mean_radius);
  for (int k = 0; k <= classes; ++k) r.histogram_edges.push_back(from + (to - from) * k / classes);
  r.histogram.assign(classes, 0);
  for (const Real R : radius) {
    const Real place = to > from ? (R / r.mean_radius - from) / (to - from) * classes : 0;
    ++r.histogram[std::size_t(std::clamp(int(place), 0, classes - 1))];
  }
  r.kolmogorov = kolmogorov_distance(packing.dispersion, radius);
}

void report_overlap(const Crowd& crowd, const std::vector<Pair>& near, PackingReport& r) {
  Real sum = 0;
  std::size_t n = 0;
  for (const Pair& p : near) {
    const Real overlap = -share(crowd, p);
    if (overlap <= 0) continue;
    r.max_overlap = std::max(r.max_overlap, overlap);
    sum += overlap;
    ++n;
  }
  r.mean_overlap = n ? sum / Real(n) : 0;
  for (std::size_t i = 0; i < crowd.moving; ++i)
    r.max_overlap = std::max(r.max_overlap, 1 - crowd.walls.distance(crowd.ball[i].x) / crowd.ball[i].r);
}

Surroundings surroundings_of(const Crowd& crowd, Real tolerance) {
  constexpr Real far = 0.5;  // mean radii
  constexpr Real none = std::numeric_limits<Real>::infinity();
  std::vector<Real> gap(crowd.moving, none);  // over the sum of the radii
  std::vector<char> inside(crowd.moving, 0);
  for (const Pair& p : near_pairs(crowd, far)) {
    if (std::size_t(p.j) < crowd.moving) continue;
    const Ball &a = crowd.ball[std::size_t(p.i)], &b = crowd.ball[std::size_t(p.j)];
    gap[std::size_t(p.i)] = std::min(gap[std::size_t(p.i)], share(crowd, p));
    inside[std::size_t(p.i)] |= (b.x - a.x).norm() < b.r;
  }
  Surroundings found;
  Real sum = 0;
  for (std::size_t i = 0; i < crowd.moving; ++i) {
    if (gap[i] == none) continue;
    found.least_gap = found.near == 0 ? gap[i] : std::min(found.least_gap, gap[i]);
    found.largest_gap = found.near == 0 ? gap[i] : std::max(found.largest_gap, gap[i]);
    sum += gap[i];
    ++found.near;
    found.touching += gap[i] <= tolerance;
    found.inside += inside[i];
  }
  if (found.near > 0) found.mean_gap = sum / Real(found.near);
  return found;
}

}  // namespace

Real density_in_bulk(const Packing& packing, Real margin) {
  if (packing.radius.empty() || margin >= inradius(packing.region)) return 0;
  constexpr std::uint64_t points = 300000;
  InsertionGrid elements(packing.region, *std::max_element(packing.radius.begin(), packing.radius.end()));
  for (std::size_t i = 0; i < packing.radius.size(); ++i) elements.add({packing.position[i], packing.radius[i]});
  packing.pause();
  InsertionGrid obstacles(packing.region, std::max(margin, inradius(packing.region) / 20));
  for (std::size_t k = 0; k < packing.around.radius.size(); ++k)
    obstacles.add_obstacle({packing.around.position[k], packing.around.radius[k]});
  const Region inner = shrunk(packing.region, margin);
  struct Hits {
    std::uint64_t counted = 0, filled = 0;
    Hits& operator+=(const Hits& more) { return counted += more.counted, filled += more.filled, *this; }
  };
  const auto hits =
      sum_shared<Hits>(points, std::uint64_t{1024}, [&](std::uint64_t begin, std::uint64_t end, Hits& sum) {
        for (std::uint64_t k = begin; k < end; ++k) {
          const Vec3 x = point_in(inner, even_point(k));
          if (!obstacles.clear_of_obstacles(x, margin)) continue;
          ++sum.counted;
          sum.filled += elements.clearance({x, 0}, 0) < 0;
        }
      });
  return hits.counted ? Real(hits.filled) / Real(hits.counted) : 0;
}

Packing packing_of(const Region& region, const Dispersion& dispersion, std::vector<Vec3> position,
                   std::vector<Real> radius) {
  Packing packing;
  packing.region = region;
  packing.dispersion = dispersion;
  packing.position = std::move(position);
  packing.radius = std::move(radius);
  return packing;
}

PackingReport report(const Packing& packing, Real tolerance) {
  PackingReport r;
  r.count = packing.position.size();
  r.seed = packing.seed;
  r.seconds = packing.seconds;
  r.tolerance = tolerance;
  if (packing.position.empty()) return r;
  report_radii(packing, r);
  std::vector<Index> order;
  const Crowd crowd = crowd_of(packing, order);
  const auto near = contacts_within(crowd, near_pairs(crowd, tolerance * 2 * r.max_radius / r.mean_radius), tolerance);
  const auto touching = contacts_within(crowd, near, touching_gap);
  const auto bulk = bulk_of(crowd);
  const auto loose = rattlers_of(crowd, touching, touching_gap);
  const auto loose_near = rattlers_of(crowd, near, tolerance);
  r.touching = coordination_of(crowd, touching, loose, bulk);
  r.near = coordination_of(crowd, near, loose_near, bulk);
  r.rattlers = Real(std::accumulate(loose.begin(), loose.end(), 0)) / Real(r.count);
  r.bulk_count = std::size_t(std::accumulate(bulk.begin(), bulk.end(), 0));
  r.fabric = fabric_of(crowd, near, [](std::size_t) { return true; });
  r.fabric_bulk = fabric_of(crowd, near, [&](std::size_t i) { return bulk[i] != 0; });
  report_overlap(crowd, near, r);
  if (!packing.around.position.empty()) r.around = surroundings_of(crowd, tolerance);
  Real solid = 0;
  for (const Real R : packing.radius) solid += 4.0 / 3 * std::numbers::pi * R * R * R;
  r.density = solid / free_volume(packing.region, packing.around);
  r.density_bulk = density_in_bulk(packing, bulk_margin * r.mean_radius);
  const Order measured = bond_order(crowd);
  r.bond_order = measured.correlation;
  r.crystalline_share = measured.crystalline;
  return r;
}

}  // namespace beadwork::packing
