#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>

#include "core/packing/balance.hpp"
#include "core/packing/insertion.hpp"
#include "core/packing/packing.hpp"
#include "core/packing/settle.hpp"

namespace beadwork::packing {
namespace {

constexpr Real skin = 0.35;  // of the mean radius
constexpr int most_rounds = 40;
constexpr Real most_overlap = 0.04;  // mean; beyond it elements are no longer spheres that touch

void check(const ForcedFilling& rule) {
  if (!(std::isfinite(rule.coordination) && rule.coordination > 0))
    throw std::invalid_argument("the coordination number must be positive, got " + std::to_string(rule.coordination));
  if (!(rule.tolerance >= 0 && rule.tolerance < 1))
    throw std::invalid_argument("the overlap tolerance must be at least 0 and below 1, got " +
                                std::to_string(rule.tolerance));
}

/// Places as many of the waiting elements as the tolerance lets, each where there is the most room.
std::size_t place_waiting(Packing& packing, Real tolerance, Random& random) {
  const auto largest = [](const std::vector<Real>& r) {
    return r.empty() ? Real(0) : *std::max_element(r.begin(), r.end());
  };
  InsertionGrid grid(packing.region, std::max(largest(packing.radius), largest(packing.waiting)));
  for (std::size_t i = 0; i < packing.position.size(); ++i) grid.add({packing.position[i], packing.radius[i]});
  for (std::size_t k = 0; k < packing.around.position.size(); ++k)
    grid.add_obstacle({packing.around.position[k], packing.around.radius[k]});
  std::sort(packing.waiting.begin(), packing.waiting.end(),
            std::greater<>());  // the large ones need the best places
  std::vector<Ball> placed;
  insert_at_random(grid, packing.region,
                   {.tolerance = tolerance, .choices = 20, .tries = 1000, .pause = packing.pause, .tell = packing.tell},
                   random, packing.waiting, placed);
  for (const Ball& ball : placed) {
    packing.position.push_back(ball.x);
    packing.radius.push_back(ball.r);
  }
  return placed.size();
}

void rearrange(Packing& packing, int steps) {
  std::vector<Index> order;
  Crowd crowd = crowd_of(packing, order);
  Neighbours neighbours(skin);
  settle(crowd, neighbours, steps, 0.1);
  put_back(crowd, order, packing);
}

/// What has been pushed into a crevice between obstacles, which do not give way, waits again for a place elsewhere.
void take_out_lodged(Packing& packing) {
  if (packing.around.position.empty()) return;
  std::vector<Index> order;
  const Crowd crowd = crowd_of(packing, order);
  const std::vector<Real> into = depth_in_obstacles(crowd);
  std::vector<char> lodged(packing.position.size(), 0);
  for (std::size_t k = 0; k < into.size(); ++k) lodged[std::size_t(order[k])] = into[k] > most_into_obstacle;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < lodged.size(); ++i) {
    if (lodged[i]) {
      packing.waiting.push_back(packing.radius[i]);
      continue;
    }
    packing.position[kept] = packing.position[i];
    packing.radius[kept++] = packing.radius[i];
  }
  packing.position.resize(kept);
  packing.radius.resize(kept);
}

[[noreturn]] void refuse_waiting(const Packing& packing, Real tolerance, Real share) {
  std::ostringstream out;
  out << packing.waiting.size() << " of " << packing.waiting.size() + packing.position.size()
      << " elements found no place, also not at " << share << " of their size, with an overlap of at most " << tolerance
      << " (R1 + R2): raise the overlap tolerance, or ask for fewer or smaller elements";
  throw PackingFailure(out.str());
}

/// Puts the waiting elements in as small as need be; returns the radii that they are to have, in the order of their
/// rows.
std::vector<Real> place_small(Packing& packing, Real tolerance, Random& random) {
  constexpr Real smaller = 0.8, smallest = 0.1;
  std::vector<Real> wanted;
  for (Real share = smaller; !packing.waiting.empty(); share *= smaller) {
    if (share < smallest) refuse_waiting(packing, tolerance, share);
    for (Real& r : packing.waiting) r *= share;
    const std::size_t first = packing.radius.size();
    place_waiting(packing, tolerance, random);
    for (std::size_t k = first; k < packing.radius.size(); ++k) wanted.push_back(packing.radius[k] / share);
    for (Real& r : packing.waiting) r /= share;
  }
  return wanted;
}

/// Where small elements stand already there is never a hole for a large one, so it goes in small, and grows while all
/// push each other apart.
void grow_in(Packing& packing, Real tolerance, Random& random) {
  constexpr Real growth = 1.1;
  const std::size_t first = packing.radius.size();
  const std::vector<Real> wanted = place_small(packing, tolerance, random);
  for (bool growing = true; growing;) {
    growing = false;
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      Real& r = packing.radius[first + k];
      r = std::min(wanted[k], growth * r);
      growing = growing || r < wanted[k];
    }
    rearrange(packing, 100);
  }
}

void place_all(Packing& packing, Real tolerance) {
  Random random(packing.seed, 3);
  for (int round = 0; !packing.waiting.empty(); ++round) {
    const std::size_t placed = place_waiting(packing, tolerance, random);
    if (packing.waiting.empty() && packing.around.position.empty()) return;
    if (round == most_rounds || (placed == 0 && round > 5)) return grow_in(packing, tolerance, random);
    rearrange(packing, 100);
    take_out_lodged(packing);
  }
}

[[noreturn]] void refuse_coordination(const Crowd& crowd, Real asked, bool bulk, Real reached, Real overlap) {
  std::ostringstream out;
  out << "a coordination number of " << asked << (bulk ? " in the bulk" : "") << " cannot be reached with "
      << crowd.moving << (crowd.moving == 1 ? " element" : " elements") << ": it is " << reached
      << " where they overlap by " << 100 * overlap << " % of R1 + R2 on average; ask for a lower coordination number"
      << (crowd.moving < 1000 ? ", or for more elements (those at the walls have fewer contacts)" : "");
  throw PackingFailure(out.str());
}

/// Of those that count.
Real coordination(const Crowd& crowd, Neighbours& neighbours, bool bulk) {
  if (!bulk) return coordination(crowd, neighbours);
  const std::vector<char> inside = bulk_of(crowd);
  if (std::find(inside.begin(), inside.end(), 1) == inside.end())
    throw PackingFailure(
        "no element is in the bulk, farther than 3 mean radii from walls and obstacles, so their contacts cannot be "
        "counted: count those of all elements, or ask for more elements");
  return coordination(crowd, neighbours, inside);
}

/// Radii grow or shrink together until the coordination number is that asked, or a little above; or until
/// elements hardly overlap any more: a packing that holds has a coordination number below which it cannot go.
void reach_coordination(Crowd& crowd, Real asked, bool bulk, const Tell& tell) {
  constexpr Real band = 0.03;
  constexpr Real slope = 90;     // recorded: dZ / d(ln R) near Z = 6.2
  constexpr Real hardly = 3e-4;  // mean overlap / (R1 + R2)
  Neighbours neighbours(skin);
  Real gain = 1, before = 0, Z = 0, overlap = 0;
  for (int round = 0; round < most_rounds; ++round) {
    settle(crowd, neighbours, round == 0 ? 600 : 300, 0.03);
    Z = coordination(crowd, neighbours, bulk);
    overlap = mean_overlap(crowd, neighbours);
    tell((std::ostringstream() << "coordination " << Z << " of " << asked).str());
    if (Z >= asked && (Z <= asked + band || overlap < hardly)) return;
    if (overlap > most_overlap) break;
    const Real missing = asked + band / 2 - Z;
    if (missing * before < 0) gain /= 2;  // it went past: the steps become shorter
    before = missing;
    // Never down past the point where they come apart, which is about 1.7 times the mean overlap away.
    scale_radii(crowd, 1 + std::clamp(gain * missing / slope, -std::min(0.01, 1.3 * overlap), 0.01));
  }
  if (Z < asked) refuse_coordination(crowd, asked, bulk, Z, overlap);
}

/// The mean of a few elements' contacts says nothing, and the others are pressed as they are to be.
bool is_nearly_all_balanced(const Crowd& crowd, Packing& packing) {
  constexpr long few = 100;
  const std::vector<char> inside = bulk_of(crowd);
  const long count = std::count(inside.begin(), inside.end(), 1);
  if (count >= few || packing.around.position.empty()) return false;
  packing.warnings.push_back("only " + std::to_string(count) +
                             " elements are in the bulk, too few to count their contacts: radii were balanced, and no "
                             "coordination number was looked for");
  return true;
}

}  // namespace

void forced_filling(Packing& packing, const ForcedFilling& rule) {
  const auto start = std::chrono::steady_clock::now();
  check(rule);
  if (packing.position.empty() && packing.waiting.empty())
    throw std::invalid_argument("there are no elements to fill with: free filling comes first");
  if (rule.balanced && packing.dispersion.spread == 0)
    throw std::invalid_argument("radii cannot be balanced where they may not differ: give them a spread");
  if (rule.balanced && packing.around.position.empty())
    packing.warnings.emplace_back("there are no obstacles near which radii could be balanced: they stay as drawn");
  place_all(packing, rule.tolerance);
  std::vector<Index> order;
  Crowd crowd = crowd_of(packing, order);
  if (rule.balanced) balance(crowd, packing.dispersion.spread, packing.tell);
  if (!(rule.balanced && is_nearly_all_balanced(crowd, packing)))
    reach_coordination(crowd, rule.coordination, rule.bulk, packing.tell);
  put_back(crowd, order, packing);
  packing.seconds += std::chrono::duration<Real>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace beadwork::packing
