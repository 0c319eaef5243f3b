#include "core/packing/insertion.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/parallel.hpp"

namespace beadwork::packing {
namespace {

constexpr Real most_cells = 3e7;

/// A cell and its 26 neighbours, those that share most with it first: most tries fail, and the sooner the cheaper.
constexpr auto nearest_first = [] {
  std::array<std::array<int, 3>, 27> steps{};
  std::size_t count = 0;
  for (int apart = 0; apart <= 3; ++apart)
    for (int z = -1; z <= 1; ++z)
      for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
          if (x * x + y * y + z * z == apart) steps[count++] = {x, y, z};
  return steps;
}();

/// Lowers `clearance` to that between two balls; false once it is below `least`.
bool lower(Real& clearance, Real least, const Ball& a, const Ball& b) {
  const Real sum = a.r + b.r;
  const Real d2 = (b.x - a.x).squaredNorm();
  if (d2 >= (1 + clearance) * (1 + clearance) * sum * sum) return true;
  clearance = std::sqrt(d2) / sum - 1;
  return clearance >= least;
}

}  // namespace

InsertionGrid::InsertionGrid(const Region& region, Real largest_radius) : reach_(largest_radius) {
  const Box box = bounds(region);
  const Vec3 extent = box.high - box.low;
  low_ = box.low;
  edge_ = std::max(2 * largest_radius, std::cbrt(extent.prod() / most_cells));
  const auto across = [&] { return (extent / edge_).array().ceil().max(1); };
  while (!(across().prod() <= 2 * most_cells)) edge_ *= 1.25;  // a thin or long region has cells for its walls alone
  cells_ = across().cast<int>().matrix();
  const std::size_t count = std::size_t(cells_[0]) * std::size_t(cells_[1]) * std::size_t(cells_[2]);
  first_.assign(count, -1);
}

Eigen::Vector3i InsertionGrid::place_of(const Vec3& x) const {
  Eigen::Vector3i c;
  for (int a = 0; a < 3; ++a)
    c[a] = int(std::clamp(std::floor((x[a] - low_[a]) / edge_), Real(0), Real(cells_[a] - 1)));
  return c;
}

void InsertionGrid::add(const Ball& ball) {
  const std::size_t cell = cell_of(ball.x);
  entry_.push_back({ball, first_[cell]});
  first_[cell] = static_cast<Index>(entry_.size()) - 1;
}

void InsertionGrid::add_obstacle(const Ball& ball) {
  if (obstacles_.empty()) obstacles_.resize(first_.size());
  const Vec3 arm = Vec3::Constant(ball.r + reach_);
  const Eigen::Vector3i from = place_of(ball.x - arm), to = place_of(ball.x + arm);
  const Real cell_radius = edge_ * std::sqrt(Real(3)) / 2;
  Eigen::Vector3i c;
  for (c[2] = from[2]; c[2] <= to[2]; ++c[2])
    for (c[1] = from[1]; c[1] <= to[1]; ++c[1])
      for (c[0] = from[0]; c[0] <= to[0]; ++c[0]) {
        const Vec3 middle = low_ + edge_ * (c.cast<Real>().array() + 0.5).matrix();
        if ((middle - ball.x).norm() <= ball.r + reach_ + cell_radius) obstacles_[flat(c)].push_back(ball);
      }
}

Real InsertionGrid::clearance(const Ball& ball, Real least) const {
  Real clearance = 1;
  const Eigen::Vector3i middle = place_of(ball.x);
  constexpr Real nowhere = -2;
  for (const Ball& obstacle : obstacles_at(flat(middle)))
    if (!lower(clearance, std::max(least, -most_into_obstacle * ball.r / (ball.r + obstacle.r)), ball, obstacle))
      return nowhere;
  for (const auto& step : nearest_first) {
    const Eigen::Vector3i c = middle + Eigen::Vector3i(step[0], step[1], step[2]);
    if ((c.array() < 0).any() || (c.array() >= cells_.array()).any()) continue;
    for (Index k = first_[flat(c)]; k >= 0; k = entry_[std::size_t(k)].next)
      if (!lower(clearance, least, ball, entry_[std::size_t(k)].ball)) return clearance;
  }
  return clearance;
}

bool InsertionGrid::clear_of_obstacles(const Vec3& x, Real margin) const {
  for (const Ball& obstacle : obstacles_at(cell_of(x)))
    if ((obstacle.x - x).squaredNorm() < (obstacle.r + margin) * (obstacle.r + margin)) return false;
  return true;
}

bool InsertionGrid::reachable(const Vec3& x, Real radius) const {
  constexpr int most_moves = 8;
  constexpr Real close = 1e-3;
  Vec3 centre = x;
  for (int move = 0; move < most_moves; ++move) {
    Real least = radius;
    Vec3 away = zero<Vec3>();
    for (const Ball& obstacle : obstacles_at(cell_of(centre))) {
      const Vec3 arm = centre - obstacle.x;
      const Real distance = arm.norm();
      if (distance - obstacle.r >= least || !(distance > 0)) continue;
      least = distance - obstacle.r;
      away = arm / distance;
    }
    if (least >= radius * (1 - close)) return true;
    centre += (radius - least) * away;
    if ((centre - x).squaredNorm() > radius * radius) return false;
  }
  return false;
}

namespace {

Vec3 random_unit(Random& random) {
  Vec3 unit;
  for (int a = 0; a < 3; ++a) unit[a] = random.uniform();
  return unit;
}

/// The roomiest of some random places for a radius.
bool find_place(const InsertionGrid& grid, const Region& region, const InsertionRule& rule, Random& random,
                Ball& ball) {
  Real best = -rule.tolerance;
  bool found = false;
  for (int k = 0; k < rule.choices; ++k) {
    const Ball candidate{point_in(region, random_unit(random), ball.r), ball.r};
    const Real clearance = grid.clearance(candidate, best);
    if (clearance < best) continue;
    best = clearance;
    ball.x = candidate.x;
    found = true;
  }
  return found;
}

/// Tries each radius once, in turn. Where a ball overlaps what stands there already it will overlap it later too, so
/// many tries are looked at together, by all threads; those that then seem free are looked at again, one after another.
void try_each_once(InsertionGrid& grid, const Region& region, const InsertionRule& rule, Random& random,
                   std::vector<Real>& radii, std::vector<Ball>& placed, int& failed) {
  constexpr std::size_t block = 8192;
  std::vector<Ball> candidate;
  std::vector<char> free;
  std::size_t kept = 0;
  const auto fits = [&](const Ball& ball) { return grid.clearance(ball, -rule.tolerance) >= -rule.tolerance; };
  for (std::size_t begin = 0; begin < radii.size(); begin += block) {
    const std::size_t count = std::min(block, radii.size() - begin);
    candidate.clear();
    for (std::size_t k = 0; k < count; ++k) {
      const Real r = radii[begin + k];
      candidate.push_back({point_in(region, random_unit(random), r), r});
    }
    free.assign(count, 0);
    each_shared(
        count, [&](std::size_t k) { free[k] = fits(candidate[k]); }, block);
    for (std::size_t k = 0; k < count; ++k) {
      rule.pause();
      const bool found = failed < rule.tries && free[k] && fits(candidate[k]);
      if (failed < rule.tries) failed = found ? 0 : failed + 1;
      if (found) {
        grid.add(candidate[k]);
        placed.push_back(candidate[k]);
      } else {
        radii[kept++] = candidate[k].r;
      }
    }
  }
  radii.resize(kept);
}

/// Tries each radius up to `patience` times, in turn.
void try_each(InsertionGrid& grid, const Region& region, const InsertionRule& rule, Random& random,
              std::vector<Real>& radii, std::vector<Ball>& placed, int& failed) {
  std::size_t kept = 0;
  for (const Real r : radii) {
    rule.pause();
    Ball ball{zero<Vec3>(), r};
    bool found = false;
    for (int go = 0; go < rule.patience && !found && failed < rule.tries; ++go) {
      found = find_place(grid, region, rule, random, ball);
      failed = found ? 0 : failed + 1;
    }
    if (found) {
      grid.add(ball);
      placed.push_back(ball);
    } else {
      radii[kept++] = r;
    }
  }
  radii.resize(kept);
}

}  // namespace

void insert_at_random(InsertionGrid& grid, const Region& region, const InsertionRule& rule, Random& random,
                      std::vector<Real>& radii, std::vector<Ball>& placed) {
  // The radii take turns: a large element that finds no room does not hold up the others.
  int failed = 0;
  const bool once = rule.choices == 1 && rule.patience == 1;
  while (!radii.empty() && failed < rule.tries) {
    rule.tell(std::to_string(placed.size()) + " elements placed, " + std::to_string(radii.size()) +
              " still to be placed");
    (once ? try_each_once : try_each)(grid, region, rule, random, radii, placed, failed);
  }
}

}  // namespace beadwork::packing
