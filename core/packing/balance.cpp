#include "core/packing/balance.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/packing/blocks.hpp"
#include "core/packing/crowd.hpp"
#include "core/packing/settle.hpp"

namespace beadwork::packing {
namespace {

constexpr Real skin = 0.35;
constexpr int most_rounds = 40, steps_a_round = 100;
constexpr Real most_change = 0.02;  // of a radius in a round
// Recorded: the mean in the bulk of packings of spread .25 without obstacles where they have 6.2 contacts. Of one element
// it is in proportion to its radius: the sum of the forces on a sphere in a medium of one pressure is that times 3 V/R.
constexpr Real wanted_pressing = 0.012;
constexpr int contacts_that_hold = 4;

struct Hold {
  Real pressing = 0;  ///< overlaps over the element's diameter, summed over its contacts, walls included
  int contacts = 0;
};

Hold hold_of(const Crowd& crowd, std::span<const Index> neighbours, std::size_t i) {
  const Ball& a = crowd.ball[i];
  Hold hold;
  const auto meet = [&](Real overlap) {
    if (overlap <= 0) return;
    hold.pressing += overlap / (2 * a.r);
    ++hold.contacts;
  };
  for (const Index j : neighbours) {
    const Ball& b = crowd.ball[std::size_t(j)];
    meet(a.r + b.r - (b.x - a.x).norm());
  }
  for (std::size_t w = 0; w < crowd.walls.size(); ++w) meet(a.r - crowd.walls.view(w, a.x).distance);
  return hold;
}

/// An element of z contacts is pressed by z/2 times the share by which its radius grows.
Real change_for(const Hold& hold, Real wanted) {
  if (hold.contacts < contacts_that_hold && hold.pressing < wanted) return most_change;
  constexpr Real gain = 1.0 / 6;
  return std::clamp(gain * (wanted - hold.pressing), -most_change, most_change);
}

struct Round {
  std::size_t near = 0, loose = 0;  ///< elements near obstacles, and those of them that are not held
  Real most = 0;                    ///< largest change of a radius, over itself
};

Round adapt_radii(Crowd& crowd, const NeighbourList& list, Real spread) {
  const Real mean = mean_radius(crowd), least = (1 - spread) * mean, largest = (1 + spread) * mean;
  const std::vector<char> near = near_obstacles(crowd);
  std::vector<Real> radius(crowd.moving);
  std::vector<char> loose(crowd.moving, 0);
  for_each(crowd.moving, [&](std::size_t i) {
    const Real now = crowd.ball[i].r;
    radius[i] = now;
    if (!near[i]) return;
    const Hold hold = hold_of(crowd, list.of(i), i);
    loose[i] = hold.contacts < contacts_that_hold;
    radius[i] = std::clamp(now * (1 + change_for(hold, wanted_pressing * now / mean)), std::min(now, least),
                           std::max(now, largest));
  });
  Round round;
  for (std::size_t i = 0; i < crowd.moving; ++i) {
    round.near += std::size_t(near[i]);
    round.loose += std::size_t(loose[i]);
    round.most = std::max(round.most, std::abs(radius[i] / crowd.ball[i].r - 1));
    crowd.ball[i].r = radius[i];
  }
  return round;
}

}  // namespace

void balance(Crowd& crowd, Real spread, const Tell& tell) {
  constexpr Real hardly = 1e-3;
  Neighbours neighbours(skin);
  for (int k = 0; k < most_rounds; ++k) {
    const Round round = adapt_radii(crowd, neighbours.of(crowd), spread);
    tell((std::ostringstream() << round.loose << " of " << round.near << " elements near obstacles are held by "
                               << "fewer than " << contacts_that_hold << " others")
             .str());
    if (round.most < hardly) return;
    settle(crowd, neighbours, steps_a_round, 0.03);
  }
}

}  // namespace beadwork::packing
