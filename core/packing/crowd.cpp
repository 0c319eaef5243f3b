#include "core/packing/crowd.hpp"

#include <algorithm>
#include <cmath>

#include "core/domain/order.hpp"
#include "core/packing/blocks.hpp"

namespace beadwork::packing {

Crowd crowd_of(const Packing& packing, std::vector<Index>& order) {
  Crowd crowd;
  crowd.pause = packing.pause;
  crowd.origin = centre(packing.region);
  Real sum = 0;
  for (const Real r : packing.radius) sum += r;
  crowd.unit = packing.radius.empty() ? inradius(packing.region) : sum / Real(packing.radius.size());
  crowd.walls = Walls(rescaled(packing.region, crowd.origin, crowd.unit));
  crowd.moving = packing.position.size();
  crowd.ball.reserve(crowd.moving + packing.around.position.size());
  order = hilbert_order(packing.position);
  const auto add = [&](const Vec3& x, Real r) {
    crowd.ball.push_back({(x - crowd.origin) / crowd.unit, r / crowd.unit});
  };
  for (const Index i : order) add(packing.position[i], packing.radius[i]);
  for (std::size_t k = 0; k < packing.around.position.size(); ++k)
    add(packing.around.position[k], packing.around.radius[k]);
  return crowd;
}

void put_back(const Crowd& crowd, const std::vector<Index>& order, Packing& packing) {
  for (std::size_t k = 0; k < crowd.moving; ++k) {
    packing.position[order[k]] = crowd.origin + crowd.unit * crowd.ball[k].x;
    packing.radius[order[k]] = crowd.unit * crowd.ball[k].r;
  }
}

std::vector<Pair> near_pairs(const Crowd& crowd, Real gap) {
  std::vector<Vec3> position(crowd.ball.size());
  std::vector<Real> radius(crowd.ball.size());
  for (std::size_t i = 0; i < crowd.ball.size(); ++i) {
    position[i] = crowd.ball[i].x;
    radius[i] = crowd.ball[i].r;
  }
  return find_pairs_around(position, radius, crowd.moving, 0, gap, crowd.pause);
}

Real mean_radius(const Crowd& crowd) {
  Real sum = 0;
  for (std::size_t i = 0; i < crowd.moving; ++i) sum += crowd.ball[i].r;
  return sum / Real(crowd.moving);
}

void scale_radii(Crowd& crowd, Real factor) {
  for (std::size_t i = 0; i < crowd.moving; ++i) crowd.ball[i].r *= factor;
}

void Neighbours::build(const Crowd& crowd) {
  list_ = neighbours_of(near_pairs(crowd, skin_), crowd.ball.size());
  built_for_ = crowd.ball;
}

const NeighbourList& Neighbours::after(const Crowd& crowd, Real worst) {
  // Two elements come nearer by what each moved and grew: the worst two together must stay within the skin.
  if (!(2 * worst <= skin_)) build(crowd);
  return list_;
}

const NeighbourList& Neighbours::of(const Crowd& crowd) {
  if (built_for_.size() != crowd.ball.size()) {
    build(crowd);
    return list_;
  }
  const Largest worst = sum_in_blocks<Largest>(crowd.moving, [&](std::size_t begin, std::size_t end, Largest& largest) {
    for (std::size_t i = begin; i < end; ++i) largest.value = std::max(largest.value, change(crowd, i));
  });
  return after(crowd, worst.value);
}

namespace {
struct Tally {
  Real contacts = 0, overlap = 0;
  void operator+=(const Tally& o) {
    contacts += o.contacts;
    overlap += o.overlap;
  }
};

Tally tally(const Crowd& crowd, const NeighbourList& list) {
  return sum_in_blocks<Tally>(crowd.moving, [&](std::size_t begin, std::size_t end, Tally& t) {
    for (std::size_t i = begin; i < end; ++i) {
      const Ball& a = crowd.ball[i];
      for (const Index j : list.of(i)) {
        const Ball& b = crowd.ball[j];
        const Real share = 1 - (b.x - a.x).norm() / (a.r + b.r);
        if (share <= 0) continue;
        t.contacts += 1;
        t.overlap += share;
      }
    }
  });
}
}  // namespace

std::vector<char> near_obstacles(const Crowd& crowd) {
  const Real margin = bulk_margin * mean_radius(crowd);
  std::vector<char> near(crowd.moving, 0);
  if (crowd.ball.size() == crowd.moving) return near;
  for (const Pair& p : near_pairs(crowd, margin))
    if (std::size_t(p.j) >= crowd.moving) {
      const Ball &a = crowd.ball[std::size_t(p.i)], &b = crowd.ball[std::size_t(p.j)];
      if ((b.x - a.x).norm() - b.r <= margin) near[std::size_t(p.i)] = 1;
    }
  return near;
}

std::vector<char> bulk_of(const Crowd& crowd) {
  const Real margin = bulk_margin * mean_radius(crowd);
  std::vector<char> bulk = near_obstacles(crowd);
  for (std::size_t i = 0; i < crowd.moving; ++i) bulk[i] = !bulk[i] && crowd.walls.distance(crowd.ball[i].x) > margin;
  return bulk;
}

std::vector<Real> depth_in_obstacles(const Crowd& crowd) {
  std::vector<Real> depth(crowd.moving, 0);
  if (crowd.ball.size() == crowd.moving) return depth;
  for (const Pair& p : near_pairs(crowd, 0)) {
    if (std::size_t(p.j) < crowd.moving) continue;
    const Ball &a = crowd.ball[std::size_t(p.i)], &b = crowd.ball[std::size_t(p.j)];
    Real& deepest = depth[std::size_t(p.i)];
    deepest = std::max(deepest, (a.r + b.r - (b.x - a.x).norm()) / a.r);
  }
  return depth;
}

Real coordination(const Crowd& crowd, Neighbours& neighbours) {
  return tally(crowd, neighbours.of(crowd)).contacts / Real(crowd.moving);
}

Real coordination(const Crowd& crowd, Neighbours& neighbours, const std::vector<char>& counts) {
  const NeighbourList& list = neighbours.of(crowd);
  std::size_t contacts = 0, elements = 0;
  for (std::size_t i = 0; i < crowd.moving; ++i) {
    if (!counts[i]) continue;
    ++elements;
    const Ball& a = crowd.ball[i];
    for (const Index j : list.of(i)) contacts += (crowd.ball[j].x - a.x).norm() < a.r + crowd.ball[j].r;
  }
  return elements ? Real(contacts) / Real(elements) : 0;
}

Real mean_overlap(const Crowd& crowd, Neighbours& neighbours) {
  const Tally t = tally(crowd, neighbours.of(crowd));
  return t.contacts > 0 ? t.overlap / t.contacts : 0;
}

}  // namespace beadwork::packing
