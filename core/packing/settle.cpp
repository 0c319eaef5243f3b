#include "core/packing/settle.hpp"

#include <algorithm>
#include <cmath>

#include "core/packing/blocks.hpp"

namespace beadwork::packing {
namespace {

struct Sums {
  Real power = 0, force2 = 0, speed2 = 0, load = 0, contacts = 0;
  void operator+=(const Sums& o) {
    power += o.power;
    force2 += o.force2;
    speed2 += o.speed2;
    load += o.load;
    contacts += o.contacts;
  }
};

/// Force on element i from all it overlaps.
Vec3 push_on(const Crowd& crowd, std::span<const Index> neighbours, std::size_t i, Sums& sums) {
  const Ball a = crowd.ball[i];
  Vec3 force = zero<Vec3>();
  for (const Index j : neighbours) {
    const Ball& b = crowd.ball[j];
    const Vec3 d = b.x - a.x;
    const Real sum = a.r + b.r;
    const Real d2 = d.squaredNorm();
    if (d2 >= sum * sum || d2 == 0) continue;
    const Real distance = std::sqrt(d2);
    force -= (sum - distance) / distance * d;
    sums.load += sum - distance;
    sums.contacts += 1;
  }
  for (std::size_t w = 0; w < crowd.walls.size(); ++w) {
    const WallView wall = crowd.walls.view(w, a.x);
    if (wall.distance >= a.r) continue;
    force += (a.r - wall.distance) * wall.inward;
    sums.load += a.r - wall.distance;
    sums.contacts += 1;
  }
  return force;
}

/// The velocity rule of FIRE: run downhill, turn towards the force, stop when it goes uphill.
class Fire {
 public:
  void judge(const Sums& sums) {
    uphill_ = sums.power < 0;
    if (uphill_) {
      downhill_steps_ = 0;
      step_ = std::max(step_ * 0.5, 0.02);
      mixing_ = 0.1;
    } else if (++downhill_steps_ > 5) {
      step_ = std::min(step_ * 1.1, 0.45);  // the stiffest pile of unit springs is stable up to about 0.5
      mixing_ *= 0.99;
    }
    turn_ = !uphill_ && sums.force2 > 0 ? mixing_ * std::sqrt(sums.speed2 / sums.force2) : 0;
    keep_ = uphill_ ? 0 : 1 - mixing_;
  }
  void move(Vec3& x, Vec3& v, const Vec3& force) const {
    if (force.isZero(0)) v = zero<Vec3>();  // a loose element would fly about in its cage and spoil the neighbour lists
    if (uphill_) x -= 0.5 * step_ * v;
    v = keep_ * v + (turn_ + step_) * force;
    x += step_ * v;
  }

 private:
  Real step_ = 0.1, mixing_ = 0.1, turn_ = 0, keep_ = 1;
  int downhill_steps_ = 0;
  bool uphill_ = false;
};

}  // namespace

void settle(Crowd& crowd, Neighbours& neighbours, int max_steps, Real residual, Real pressure) {
  std::vector<Vec3> velocity(crowd.moving, zero<Vec3>());
  std::vector<Vec3> force(crowd.moving);
  Fire fire;
  const NeighbourList* list = &neighbours.of(crowd);
  for (int step = 0; step < max_steps; ++step) {
    crowd.pause();
    const Sums sums = sum_in_blocks<Sums>(crowd.moving, [&](std::size_t begin, std::size_t end, Sums& s) {
      for (std::size_t i = begin; i < end; ++i) {
        force[i] = push_on(crowd, list->of(i), i, s);
        s.power += force[i].dot(velocity[i]);
        s.force2 += force[i].squaredNorm();
        s.speed2 += velocity[i].squaredNorm();
      }
    });
    const Real left = sums.load > 0 ? std::sqrt(sums.force2 / Real(crowd.moving)) / (sums.load / sums.contacts) : 0;
    if (left <= residual || sums.load / Real(crowd.moving) <= pressure) return;
    fire.judge(sums);
    const Largest worst = sum_in_blocks<Largest>(crowd.moving, [&](std::size_t begin, std::size_t end, Largest& w) {
      for (std::size_t i = begin; i < end; ++i) {
        fire.move(crowd.ball[i].x, velocity[i], force[i]);
        w.value = std::max(w.value, neighbours.change(crowd, i));
      }
    });
    list = &neighbours.after(crowd, worst.value);
  }
}

}  // namespace beadwork::packing
