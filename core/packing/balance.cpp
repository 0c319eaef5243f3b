#include "core/packing/balance.hpp"

#include <algorithm>
#include <sstream>

#include "core/packing/blocks.hpp"
#include "core/packing/crowd.hpp"
#include "core/packing/settle.hpp"

namespace beadwork::packing {
namespace {

constexpr Real skin = 0.35;
constexpr int most_rounds = 40, steps_a_round = 100;
constexpr Real most_change = 0.02;  // of a radius in a round
// Recorded: the mean in the bulk of packings of spread .25 without obstacles where they have 6.2 contacts.
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
Real change_for(const Hold& hold) {
  if (hold.contacts < contacts_that_hold) return most_change;
  constexpr Real gain = 1.0 / 6;
  return std::clamp(gain * (wanted_pressing - hold.pressing), -most_change, most_change);
}

std::size_t adapt_radii(Crowd& crowd, const NeighbourList& list, Real least, Real largest) {
  std::vector<Real> radius(crowd.moving);
  std::vector<char> loose(crowd.moving);
  for_each(crowd.moving, [&](std::size_t i) {
    const Hold hold = hold_of(crowd, list.of(i), i);
    const Real now = crowd.ball[i].r;
    loose[i] = hold.contacts < contacts_that_hold;
    radius[i] = std::clamp(now * (1 + change_for(hold)), std::min(now, least), std::max(now, largest));
  });
  for (std::size_t i = 0; i < crowd.moving; ++i) crowd.ball[i].r = radius[i];
  return std::size_t(std::count(loose.begin(), loose.end(), 1));
}

}  // namespace

void balance(Crowd& crowd, Real spread, const Tell& tell) {
  const Real mean = mean_radius(crowd);
  Neighbours neighbours(skin);
  for (int round = 0; round < most_rounds; ++round) {
    const std::size_t loose = adapt_radii(crowd, neighbours.of(crowd), (1 - spread) * mean, (1 + spread) * mean);
    tell((std::ostringstream() << loose << " of " << crowd.moving << " elements are held by fewer than "
                               << contacts_that_hold << " others")
             .str());
    settle(crowd, neighbours, steps_a_round, 0.03);
  }
}

}  // namespace beadwork::packing
