#include "core/packing/order_measure.hpp"

#include <cmath>

#include "core/packing/blocks.hpp"

namespace beadwork::packing {
namespace {

Real legendre6(Real c) {
  const Real q = c * c;
  return (((231 * q - 315) * q + 105) * q - 5) / 16;
}

using Directions = std::vector<Vec3>;

constexpr Real most_neighbours = 60;  // on average; twelve equal spheres touch one

Real mean_product(const Directions& a, const Directions& b) {
  Real sum = 0;
  for (const Vec3& m : a)
    for (const Vec3& n : b) sum += legendre6(m.dot(n));
  return sum / Real(a.size() * b.size());
}

struct Count {
  Real pairs = 0, correlation = 0, crystalline = 0;
  void operator+=(const Count& o) {
    pairs += o.pairs;
    correlation += o.correlation;
    crystalline += o.crystalline;
  }
};

}  // namespace

Order bond_order(const Crowd& crowd) {
  // The first shell: up to the first minimum of the pair correlation, about 1.4 diameters.
  const auto pairs = near_pairs(crowd, 0.8);
  if (Real(pairs.size()) > most_neighbours / 2 * Real(crowd.moving)) return {};
  const NeighbourList list = neighbours_of(pairs, crowd.ball.size());
  std::vector<Directions> directions(crowd.moving);
  std::vector<Real> own(crowd.moving, 0);
  for_each(
      crowd.moving,
      [&](std::size_t i) {
        for (const Index j : list.of(i)) {
          const Vec3 d = crowd.ball[std::size_t(j)].x - crowd.ball[i].x;
          if (std::size_t(j) < crowd.moving && d.norm() > 0) directions[i].push_back(d.normalized());
        }
        if (!directions[i].empty()) own[i] = mean_product(directions[i], directions[i]);
      },
      crowd.pause);
  std::vector<Count> counts(crowd.moving);
  for_each(
      crowd.moving,
      [&](std::size_t i) {
        int alike = 0;
        for (const Index j : list.of(i)) {
          if (std::size_t(j) >= crowd.moving || !(own[i] > 0 && own[j] > 0)) continue;
          const Real correlation = mean_product(directions[i], directions[j]) / std::sqrt(own[i] * own[j]);
          counts[i].pairs += 1;
          counts[i].correlation += correlation;
          alike += correlation > 0.7;
        }
        counts[i].crystalline += alike >= 7;
      },
      crowd.pause);
  const Count count = sum_in_blocks<Count>(crowd.moving, [&](std::size_t begin, std::size_t end, Count& c) {
    for (std::size_t i = begin; i < end; ++i) c += counts[i];
  });
  return {count.pairs > 0 ? count.correlation / count.pairs : 0,
          crowd.moving > 0 ? count.crystalline / Real(crowd.moving) : 0};
}

}  // namespace beadwork::packing
