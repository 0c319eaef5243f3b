#include "core/packing/projection.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/packing/blocks.hpp"
#include "core/packing/equations.hpp"

namespace beadwork::packing {
namespace {

constexpr int most_rounds = 60;
// The first rounds go half the way, so that contacts that come up are met one by one.
constexpr int gentle_rounds = 3;
constexpr Real gentle_share = 0.5;
constexpr Damping damping{.overlapping = 1e-3, .open = 2e-3};
constexpr Real radius_compliance = 0.2;  // radii give way less than places; recorded: the least iterations near 0.1-0.3

/// A pair of elements, or an element and -1 - wall.
struct Key {
  Index i, j;
  friend auto operator<=>(const Key&, const Key&) = default;
};

Contact contact_of(const Crowd& crowd, const Key& key) {
  const Ball& a = crowd.ball[std::size_t(key.i)];
  if (key.j < 0) {
    const WallView wall = crowd.walls.view(std::size_t(-1 - key.j), a.x);
    return {key.i, key.j, -wall.inward, wall.distance - a.r};
  }
  const Ball& b = crowd.ball[std::size_t(key.j)];
  const Vec3 d = b.x - a.x;
  const Real distance = d.norm();
  return {key.i, key.j, distance > 0 ? Vec3(d / distance) : Vec3(Vec3::UnitX()), distance - a.r - b.r};
}

Real reach_of(const Crowd& crowd, const Key& key) {
  return crowd.ball[std::size_t(key.i)].r + (key.j < 0 ? 0 : crowd.ball[std::size_t(key.j)].r);
}

struct Found {
  std::vector<Key> keys;
  Real largest = 0;
  void operator+=(const Found& other) {
    keys.insert(keys.end(), other.keys.begin(), other.keys.end());
    largest = std::max(largest, other.largest);
  }
};

/// Pairs and walls that overlap, sorted.
Found overlapping(const Crowd& crowd, const NeighbourList& list) {
  return sum_in_blocks<Found>(crowd.moving, [&](std::size_t begin, std::size_t end, Found& found) {
    const auto look = [&](const Key& key) {
      const Real overlap = -contact_of(crowd, key).gap / reach_of(crowd, key);
      if (overlap > 0) found.keys.push_back(key);
      found.largest = std::max(found.largest, overlap);
    };
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t w = crowd.walls.size(); w-- > 0;) look({Index(i), -1 - Index(w)});
      for (const Index j : list.of(i))
        if (std::size_t(j) > i) look({Index(i), j});
    }
  });
}

/// Radii as they were drawn, and how far each may still go.
class Allowance {
 public:
  Allowance(const Crowd& crowd, const RadiusBounds& bounds) : bounds_(bounds), compliance_(crowd.moving) {
    for (std::size_t i = 0; i < crowd.moving; ++i) drawn_.push_back(crowd.ball[i].r);
    drawn_mean_ = mean_radius(crowd);
    apply(crowd.ball, mean_radius(crowd), nullptr);
  }

  const std::vector<Real>& compliance() const { return compliance_; }

  /// Puts radii that left their bounds back on them. The nearer a radius has come to the change it is
  /// allowed, the less it gives way in the next round; one at the end of the law's range is held.
  void apply(Crowd& crowd) { apply(crowd.ball, mean_radius(crowd), crowd.ball.data()); }

 private:
  void apply(const std::vector<Ball>& ball, Real mean, Ball* clipped) {
    for_each(compliance_.size(), [&](std::size_t i) {
      const Real own = drawn_[i] / drawn_mean_ * mean;
      const Real low = std::max(own * (1 - bounds_.change), std::min(own, bounds_.low * mean));
      const Real high = std::min(own * (1 + bounds_.change), std::max(own, bounds_.high * mean));
      const Real r = ball[i].r;
      const Real used = (r / own - 1) / bounds_.change;
      compliance_[i] = r < low || r > high ? 0 : radius_compliance * (1 - used * used);
      if (clipped) clipped[i].r = std::clamp(r, low, high);
    });
  }
  RadiusBounds bounds_;
  std::vector<Real> drawn_;
  Real drawn_mean_;
  std::vector<Real> compliance_;
};

void add(const std::vector<Change>& change, Real share, Crowd& crowd) {
  for_each(crowd.moving, [&](std::size_t i) {
    // Half a radius at most: a round that goes astray must not throw elements out of the region.
    const Vec3 u = share * change[i].u;
    const Real length = u.norm(), most = crowd.ball[i].r / 2;
    crowd.ball[i].x += length > most ? Vec3(most / length * u) : u;
    crowd.ball[i].r = std::max(crowd.ball[i].r + share * change[i].r, crowd.ball[i].r / 2);
  });
}

Real rms_gap(const std::vector<Contact>& contacts) {
  Real sum = 0;
  for (const Contact& c : contacts) sum += c.gap * c.gap;
  return contacts.empty() ? 0 : std::sqrt(sum / Real(contacts.size()));
}

/// Keeps the contacts that the linear equations could close.
std::vector<Key> closable(const std::vector<Contact>& contacts, const std::vector<Real>& remaining) {
  const Real limit = 2 * rms_gap(contacts);
  std::vector<Key> kept;
  for (std::size_t e = 0; e < contacts.size(); ++e)
    if (remaining[e] <= limit) kept.push_back({contacts[e].i, contacts[e].j});
  return kept;
}

}  // namespace

void project(Crowd& crowd, Neighbours& neighbours, const RadiusBounds& bounds, Real overlap,
             const std::function<void(Real)>& told) {
  std::vector<Key> known = overlapping(crowd, neighbours.of(crowd)).keys;
  std::sort(known.begin(), known.end());
  scale_radii(crowd, 1 - mean_overlap(crowd, neighbours));  // what all must give is not for some to give
  Allowance allowance(crowd, bounds);
  for (int rounds = 0;; ++rounds) {
    crowd.pause();
    Found found = overlapping(crowd, neighbours.of(crowd));
    told(found.largest);
    if (found.largest <= overlap || rounds == most_rounds) return;
    std::sort(found.keys.begin(), found.keys.end());
    std::vector<Key> keys;
    std::set_union(known.begin(), known.end(), found.keys.begin(), found.keys.end(), std::back_inserter(keys));
    std::vector<Contact> contacts(keys.size());
    for_each(keys.size(), [&](std::size_t e) { contacts[e] = contact_of(crowd, keys[e]); });
    ContactEquations equations(crowd.moving, contacts, allowance.compliance());
    equations.solve(damping, 1e-3, 400, crowd.pause);
    const bool gently = rounds < gentle_rounds;
    add(equations.change(), gently ? gentle_share : 1, crowd);
    known = gently ? std::move(keys) : closable(contacts, equations.remaining());
    allowance.apply(crowd);
  }
}

}  // namespace beadwork::packing
