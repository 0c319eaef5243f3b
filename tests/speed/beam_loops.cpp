// The beam in a plain scalar loop over arrays, which does the beam and nothing else: the yardstick of the whole step
// (tests/speed/compare.sh). And the same through the core's loop, with its chunks and halo rows.

#include <benchmark/benchmark.h>

#include <vector>

#include "tests/speed/lattice.hpp"

namespace beadwork {
namespace {

using speed::Lattice;

void plain_scalar_loop(benchmark::State& state) {
  const Lattice lattice;
  struct Pose {
    Vec3 x;
    Quat q;
    Real pad;
  };
  struct Load {
    Vec3 f, t;
    Real pad[2];
  };
  std::vector<Pose> pose(lattice.place.size());
  std::vector<Load> load(lattice.place.size());
  std::vector<BeamRest<Real>> rest;
  for (std::size_t n = 0; n < pose.size(); ++n) {
    pose[n].x = lattice.place[n];
    speed::disturb(static_cast<Index>(n), pose[n].x, pose[n].q);
  }
  for (const auto& [i, j] : lattice.pairs) rest.push_back(lattice.rest(i, j));
  for (auto _ : state) {
    for (Load& l : load) l = Load{zero<Vec3>(), zero<Vec3>(), {0, 0}};
    for (std::size_t b = 0; b < rest.size(); ++b) {
      const auto i = static_cast<std::size_t>(lattice.pairs[b].first);
      const auto j = static_cast<std::size_t>(lattice.pairs[b].second);
      const Wrench<Real> w = beam_wrench<Real>(rest[b], pose[j].x - pose[i].x, pose[i].q, pose[j].q);
      load[i].f -= w.force;
      load[j].f += w.force;
      load[i].t += w.torque1;
      load[j].t += w.torque2;
    }
    benchmark::DoNotOptimize(load.data());
  }
  state.counters["bonds"] =
      benchmark::Counter(static_cast<double>(rest.size()), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(plain_scalar_loop)->Unit(benchmark::kMillisecond)->Repetitions(5)->ReportAggregatesOnly();

void core_loop(benchmark::State& state) {
  use_threads(static_cast<int>(state.range(0)));
  speed::Scene scene;
  for (auto _ : state) {
    bond_loop::run<Pass{}>(scene.law, *scene.table, speed::lines_of(scene.domain), scene.domain.size(), true);
    scene.domain.gather();
  }
  state.counters["bonds"] =
      benchmark::Counter(static_cast<double>(scene.table->size()), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(core_loop)
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Repetitions(5)
    ->ReportAggregatesOnly();

}  // namespace
}  // namespace beadwork

BENCHMARK_MAIN();
