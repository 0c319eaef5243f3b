// Contacts of Hertz and Mindlin in a plain scalar loop over arrays, which does them and nothing else: the yardstick of a
// whole step of a heap (tests/speed/contacts.sh). Damped, with friction whose history turns with the pair.

#include <benchmark/benchmark.h>

#include <vector>

#include "core/mechanics/collision.hpp"
#include "tests/speed/lattice.hpp"

namespace beadwork {
namespace {

void plain_scalar_loop(benchmark::State& state) {
  const speed::Lattice lattice;
  struct Place {
    Vec3 x;
    Real radius;
  };
  struct Motion {
    Vec3 v, w;
    Real pad[2];
  };
  struct Load {
    Vec3 f, t;
    Real pad[2];
  };
  struct Pair {
    Vec3 held;
    Real stiffness, viscosity, held_stiffness, lost;
  };
  const std::size_t count = lattice.place.size();
  std::vector<Place> place(count);
  std::vector<Motion> motion(count);
  std::vector<Load> load(count);
  std::vector<Pair> pairs(lattice.pairs.size(), Pair{zero<Vec3>(), 1, 0.1, 0, 0});
  for (std::size_t n = 0; n < count; ++n) {
    Quat turn = identity();
    place[n] = {lattice.place[n], 0.505};
    speed::disturb(static_cast<Index>(n), place[n].x, turn);
    motion[n] = {1e-3 * turn.v, 1e-3 * turn.v, {0, 0}};
  }
  constexpr Real dt = 1e-3, friction_coefficient = 0.5, ratio = 0.82;
  for (auto _ : state) {
    for (Load& l : load) l = Load{zero<Vec3>(), zero<Vec3>(), {0, 0}};
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      const auto i = static_cast<std::size_t>(lattice.pairs[p].first),
                 j = static_cast<std::size_t>(lattice.pairs[p].second);
      const Vec3 apart = place[j].x - place[i].x;
      const Real l = std::sqrt(dot(apart, apart)), delta = place[i].radius + place[j].radius - l;
      Pair& pair = pairs[p];
      if (delta <= 0) {
        pair.held = zero<Vec3>();
        pair.held_stiffness = 0;
        continue;
      }
      const Vec3 n = apart / l, rate = motion[j].v - motion[i].v;
      const Real v_n = dot(rate, n), arm1 = l * place[i].radius / (place[i].radius + place[j].radius), arm2 = l - arm1;
      const Real damping = pair.viscosity * HertzContact::damping(pair.stiffness, delta);
      const Real push = std::max(0.0, HertzContact::force(pair.stiffness, delta) - damping * v_n);
      const Vec3 slide = rate - v_n * n - cross<Real>(arm1 * motion[i].w + arm2 * motion[j].w, n);
      const Real k = ratio * HertzContact::slope(pair.stiffness, delta),
                 before = pair.held_stiffness > 0 ? pair.held_stiffness : k;
      const Vec3 carried = carried_across<Real>(n, pair.held, 0.5 * dt * dot<Real>(motion[i].w + motion[j].w, n)),
                 way = dt * slide;
      const Vec3 held = friction<Real>(carried, before, k, way, friction_coefficient * push);
      pair.lost += lost_by_friction<Real>(carried, before, held, k, way) + damping * v_n * v_n * dt;
      pair.held = held;
      pair.held_stiffness = k;
      const Vec3 force = push * n + held, moment = cross<Real>(held, n);
      load[i].f -= force;
      load[j].f += force;
      load[i].t += arm1 * moment;
      load[j].t += arm2 * moment;
    }
    benchmark::DoNotOptimize(load.data());
  }
  state.counters["pairs"] =
      benchmark::Counter(static_cast<double>(pairs.size()), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(plain_scalar_loop)->Unit(benchmark::kMillisecond)->Repetitions(5)->ReportAggregatesOnly();

}  // namespace
}  // namespace beadwork

BENCHMARK_MAIN();
