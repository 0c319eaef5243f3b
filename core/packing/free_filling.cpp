#include <algorithm>
#include <chrono>

#include "core/packing/insertion.hpp"
#include "core/packing/packing.hpp"
#include "core/packing/sizing.hpp"

namespace beadwork::packing {
namespace {
// Above it the largest elements go first: they would find no room between small ones.
constexpr Real wide_spread = 0.5;
}  // namespace

Packing free_filling(const Request& request) {
  const auto start = std::chrono::steady_clock::now();
  const Sizing sizing = sizing_of(request);
  Packing packing{.region = request.region,
                  .dispersion = request.dispersion,
                  .around = request.around,
                  .seed = request.seed,
                  .position = {},
                  .radius = {},
                  .waiting = draw_radii(request.dispersion, sizing.count, request.seed, request.pause),
                  .seconds = 0,
                  .warnings = {},
                  .pause = request.pause,
                  .tell = request.tell};
  for (Real& r : packing.waiting) r *= sizing.mean_radius;

  InsertionRule rule{.tries = request.tries, .pause = request.pause, .tell = request.tell};
  if (request.dispersion.spread > wide_spread) {
    std::sort(packing.waiting.begin(), packing.waiting.end(), std::greater<>());
    rule.patience = 100;
  }
  InsertionGrid grid(request.region, *std::max_element(packing.waiting.begin(), packing.waiting.end()));
  for (std::size_t k = 0; k < request.around.position.size(); ++k)
    grid.add_obstacle({request.around.position[k], request.around.radius[k]});
  Random random(request.seed, 2);
  std::vector<Ball> placed;
  insert_at_random(grid, request.region, rule, random, packing.waiting, placed);
  if (placed.empty())
    throw PackingFailure("no element found a place in " + std::to_string(request.tries) +
                         " tries: the obstacles fill the region; remove some, or ask for smaller elements");
  for (const Ball& ball : placed) {
    packing.position.push_back(ball.x);
    packing.radius.push_back(ball.r);
  }
  packing.seconds = std::chrono::duration<Real>(std::chrono::steady_clock::now() - start).count();
  return packing;
}

}  // namespace beadwork::packing
