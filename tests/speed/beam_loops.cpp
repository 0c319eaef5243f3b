// The beam in a plain scalar loop over arrays, which does the beam and nothing else: the yardstick of the whole step
// (tests/speed/compare.sh). And the same through the core's loop, with its chunks and halo rows.

#include <benchmark/benchmark.h>
#include <omp.h>

#include <vector>

#include "core/domain/domain.hpp"
#include "core/domain/vocabulary.hpp"
#include "core/mechanics/beam.hpp"
#include "core/plugin/bond_loop.hpp"

namespace beadwork {
namespace {

// A simple cubic lattice about as large as the bar of xml-cases/speed, bonded along axes and one face diagonal, so that
// there are about 3.1 bonds an element.
struct Lattice {
  static constexpr Index nx = 112, ny = 14, nz = 26;
  std::vector<Vec3> place;
  std::vector<std::pair<Index, Index>> pairs;

  Lattice() {
    for (Index i = 0; i < nx; ++i)
      for (Index j = 0; j < ny; ++j)
        for (Index k = 0; k < nz; ++k) {
          const Index here = row(i, j, k);
          place.emplace_back(i, j, k);
          if (k + 1 < nz) pairs.emplace_back(here, row(i, j, k + 1));
          if (j + 1 < ny) pairs.emplace_back(here, row(i, j + 1, k));
          if (i + 1 < nx) pairs.emplace_back(here, row(i + 1, j, k));
          if ((i + j + k) % 4 == 0 && i + 1 < nx && j + 1 < ny) pairs.emplace_back(here, row(i + 1, j + 1, k));
        }
  }
  static Index row(Index i, Index j, Index k) { return (i * ny + j) * nz + k; }
};

// Slightly moved and turned, so that no term of the law is zero.
void disturb(Index n, Vec3& x, Quat& q) {
  const Real a = 1e-3 * static_cast<Real>(n % 17 - 8);
  const Real b = 1e-3 * static_cast<Real>(n % 13 - 6);
  x += Vec3(a, b, -a);
  q = normalise(Quat{1, Vec3(b, -a, b)});
}

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
    disturb(static_cast<Index>(n), pose[n].x, pose[n].q);
  }
  for (const auto& [i, j] : lattice.pairs)
    rest.push_back(round_beam(lattice.place[static_cast<std::size_t>(j)] - lattice.place[static_cast<std::size_t>(i)], 1, 0.3, 0.25));
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
  state.counters["bonds"] = benchmark::Counter(static_cast<double>(rest.size()), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(plain_scalar_loop)->Unit(benchmark::kMillisecond)->Repetitions(5)->ReportAggregatesOnly();

struct BeamColumns {
  View<const Vec3> axis;
  View<const Real> length, axial, bending;
  static constexpr bool turns = true;

  template <Pass pass, class At, class T>
  [[gnu::always_inline]] Wrench<T> act(const At& at, const Ends<T>& ends) const {
    const T b = at(bending);
    return beam_wrench<T>({at(axis), at(length), at(axial), b, T(0.4) * b}, ends.apart, ends.q1, ends.q2);
  }
};

void core_loop(benchmark::State& state) {
  omp_set_num_threads(static_cast<int>(state.range(0)));
  const Lattice lattice;
  Domain domain;
  domain.elements().add(field::orientation);
  domain.elements().add(field::force);
  domain.elements().add(field::torque);
  domain.add_elements(static_cast<Index>(lattice.place.size()));
  const auto x = domain.elements().column("position").view<Vec3>();
  const auto q = domain.elements().column("orientation").view<Quat>();
  BondTable& table = domain.add_family("beam");
  const auto column = [&](const char* name, Type type) -> Column& { return table.rows().add({name, On::bonds, type, "1", "", ""}); };
  column("axis", Type::vec3), column("length", Type::real), column("axial", Type::real), column("bending", Type::real);
  table.create(lattice.pairs, 0);
  domain.cut_families();
  const auto axis = table.rows().column("axis").view<Vec3>();
  const auto length = table.rows().column("length").view<Real>();
  const auto axial = table.rows().column("axial").view<Real>();
  const auto bending = table.rows().column("bending").view<Real>();
  for (Index b = 0; b < table.size(); ++b) {
    const auto rest = round_beam(lattice.place[static_cast<std::size_t>(table.second()[b])] -
                                     lattice.place[static_cast<std::size_t>(table.first()[b])],
                                 1, 0.3, 0.25);
    axis.set(b, rest.axis);
    length[b] = rest.length;
    axial[b] = rest.axial;
    bending[b] = rest.bending;
  }
  for (Index n = 0; n < domain.size(); ++n) {
    Vec3 place = lattice.place[static_cast<std::size_t>(n)];
    Quat turn = identity();
    disturb(n, place, turn);
    x.set(n, place);
    q.set(n, turn);
  }
  const BeamColumns law{axis, length, axial, bending};
  for (auto _ : state) {
    bond_loop::run<Pass{}>(law, table, domain, true);
    domain.gather();
  }
  state.counters["bonds"] = benchmark::Counter(static_cast<double>(table.size()), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(core_loop)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime()->Repetitions(5)->ReportAggregatesOnly();

}  // namespace
}  // namespace beadwork

BENCHMARK_MAIN();
