// Three ways to bring the forces of bonds to the elements, each with bits that do not depend on the number of threads,
// measured with the same packs and the same law (docs/decisions/sums-in-chunks.md):
//
//   chunks     as the core does it: each chunk of bonds adds to its own elements, and to halo rows that are added afterwards
//   stored     forces of each bond are stored, then each element gathers those of its bonds
//   both_ends  each bond is computed twice, once for either end, so that an element's bonds stand together
//
// And chunks_without_law, which fetches the ends and adds something to them: what a bond costs besides its law.

#include <benchmark/benchmark.h>

#include <array>

#include "core/base/parallel.hpp"
#include "tests/speed/lattice.hpp"

namespace beadwork::speed {
namespace {

constexpr int W = pack_width;
static_assert(W > 1, "compiled for an instruction set with vectors");

template <class Column>
Real* base(const Column& column) {
  return &column.at(0, 0);
}

void report(benchmark::State& state, const Scene& scene) {
  state.counters["bonds"] =
      benchmark::Counter(static_cast<double>(scene.table->size()), benchmark::Counter::kIsIterationInvariantRate);
}

void chunks(benchmark::State& state) {
  use_threads(static_cast<int>(state.range(0)));
  Scene scene;
  for (auto _ : state) {
    bond_loop::run<Pass{}>(scene.law, *scene.table, lines_of(scene.domain), scene.domain.size(), true);
    scene.domain.gather();
  }
  report(state, scene);
}

struct NoLaw {
  static constexpr bool turns = true;
  template <Pass pass, class At, class T>
  [[gnu::always_inline]] Wrench<T> act(const At&, const TurningEnds<T>& ends) const {
    return {copy(ends.apart), copy(ends.q1.v), copy(ends.q2.v)};
  }
};

void chunks_without_law(benchmark::State& state) {
  use_threads(static_cast<int>(state.range(0)));
  Scene scene;
  for (auto _ : state) bond_loop::run<Pass{}>(NoLaw{}, *scene.table, lines_of(scene.domain), scene.domain.size(), true);
  report(state, scene);
}

/// Two lines of eight numbers for each lane: what the bond does to its first and to its second element.
struct Lines {
  std::array<Quad, W> low1, high1, low2, high2;
  explicit Lines(const Wrench<Pack<W>>& w) {
    const Vec<Pack<W>>& f = w.force;
    const Pack<W> none(0);
    low1 = pack::rows<W>({-f[0], -f[1], -f[2], w.torque1[0]});
    high1 = pack::rows<W>({w.torque1[1], w.torque1[2], none, none});
    low2 = pack::rows<W>({f[0], f[1], f[2], w.torque2[0]});
    high2 = pack::rows<W>({w.torque2[1], w.torque2[2], none, none});
  }
};

void stored(benchmark::State& state) {
  use_threads(static_cast<int>(state.range(0)));
  Scene scene;
  const BondTable& table = *scene.table;
  const auto bonds = static_cast<std::size_t>(table.size() / W * W);  // what fills no pack is left out
  std::vector<Real> lines(16 * bonds);
  std::vector<std::vector<std::size_t>> of(static_cast<std::size_t>(scene.domain.size()));
  for (std::size_t b = 0; b < bonds; ++b) {
    of[static_cast<std::size_t>(table.first()[static_cast<Index>(b)])].push_back(2 * b);
    of[static_cast<std::size_t>(table.second()[static_cast<Index>(b)])].push_back(2 * b + 1);
  }
  std::vector<std::size_t> begin{0}, line;
  for (const auto& list : of) {
    line.insert(line.end(), list.begin(), list.end());
    begin.push_back(line.size());
  }
  const ElementLines elements = lines_of(scene.domain);
  Real* sums = base(scene.domain.elements().column("force").view<Vec3>());
  const Index *first = &table.first()[0], *second = &table.second()[0];
  for (auto _ : state) {
    each_shared(bonds / W, [&](std::size_t pack) {
      const std::size_t b = pack * W;
      bool ignored = false;
      const auto row = static_cast<Index>(b);
      const Lines out(
          scene.law.act<Pass{}>(Several<W>{row, &ignored}, elements.ends<Beams, W>(first + row, second + row)));
      for (std::size_t lane = 0; lane < W; ++lane) {
        Real* to = &lines[16 * (b + lane)];
        out.low1[lane].store(to);
        out.high1[lane].store(to + 4);
        out.low2[lane].store(to + 8);
        out.high2[lane].store(to + 12);
      }
    });
    each_shared(of.size(), [&](std::size_t n) {
      Quad low(0), high(0);
      for (std::size_t k = begin[n]; k < begin[n + 1]; ++k) {
        low = low + Quad::load(&lines[8 * line[k]]);
        high = high + Quad::load(&lines[8 * line[k] + 4]);
      }
      low.store(sums + 8 * n);
      high.store(sums + 8 * n + 4);
    });
  }
  report(state, scene);
}

/// Half-bonds by their element; those of the second end run backwards, with the axis of the rest turned round.
struct Halves {
  std::vector<Index> own, other;
  std::vector<Real> axis, length, axial, bending;
  std::vector<Index> cuts;  ///< first half-bond of each block of elements, and the end; what fills no pack is left out

  explicit Halves(const Scene& scene) {
    const BondTable& table = *scene.table;
    std::vector<std::vector<std::pair<Index, Index>>> of(
        static_cast<std::size_t>(scene.domain.size()));  // (bond, other end)
    for (Index b = 0; b < table.size(); ++b) {
      of[static_cast<std::size_t>(table.first()[b])].emplace_back(b, table.second()[b]);
      of[static_cast<std::size_t>(table.second()[b])].emplace_back(b, table.first()[b]);
    }
    std::vector<Vec3> axes;
    const Index block = block_length(scene.domain.size());
    for (std::size_t n = 0; n < of.size(); ++n) {
      if (n % static_cast<std::size_t>(block) == 0) {
        while (own.size() % W != 0) drop_last(axes);
        cuts.push_back(static_cast<Index>(own.size()));
      }
      for (const auto& [b, to] : of[n]) {
        own.push_back(static_cast<Index>(n));
        other.push_back(to);
        const Vec3 along = scene.law.axis[b];
        axes.push_back(table.first()[b] == static_cast<Index>(n) ? along : Vec3(-along));
        length.push_back(scene.law.length[b]);
        axial.push_back(scene.law.axial[b]);
        bending.push_back(scene.law.bending[b]);
      }
    }
    while (own.size() % W != 0) drop_last(axes);
    cuts.push_back(static_cast<Index>(own.size()));
    for (int c = 0; c < 3; ++c)
      for (const Vec3& a : axes) axis.push_back(a[c]);
  }

  void drop_last(std::vector<Vec3>& axes) {
    own.pop_back(), other.pop_back(), axes.pop_back();
    length.pop_back(), axial.pop_back(), bending.pop_back();
  }

  Beams law() const {
    const auto number = [](const std::vector<Real>& of) {
      return View<const Real>(reinterpret_cast<const std::byte*>(of.data()), sizeof(Real), 0);
    };
    return {{reinterpret_cast<const std::byte*>(axis.data()), sizeof(Real), own.size() * sizeof(Real)},
            number(length),
            number(axial),
            number(bending)};
  }
};

void both_ends(benchmark::State& state) {
  use_threads(static_cast<int>(state.range(0)));
  Scene scene;
  const Halves halves(scene);
  const Beams law = halves.law();
  const ElementLines elements = lines_of(scene.domain);
  Real* sums = base(scene.domain.elements().column("force").view<Vec3>());
  const Index length = block_length(scene.domain.size());
  const std::size_t blocks = halves.cuts.size() - 1;
  for (auto _ : state) {
    each_shared(blocks, [&](std::size_t c) {
      elements.clear(static_cast<Index>(c) * length, std::min(static_cast<Index>(c + 1) * length, scene.domain.size()));
      for (Index h = halves.cuts[c]; h < halves.cuts[c + 1]; h += W) {
        bool ignored = false;
        const Lines out(law.act<Pass{}>(Several<W>{h, &ignored},
                                        elements.ends<Beams, W>(&halves.own[static_cast<std::size_t>(h)],
                                                                &halves.other[static_cast<std::size_t>(h)])));
        for (std::size_t lane = 0; lane < W; ++lane) {
          Real* to = sums + 8 * static_cast<std::size_t>(halves.own[static_cast<std::size_t>(h) + lane]);
          (Quad::load(to) + out.low1[lane]).store(to);
          (Quad::load(to + 4) + out.high1[lane]).store(to + 4);
        }
      }
    });
  }
  report(state, scene);
}

BENCHMARK(chunks)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime()->Repetitions(5)->ReportAggregatesOnly();
BENCHMARK(chunks_without_law)
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Repetitions(5)
    ->ReportAggregatesOnly();
BENCHMARK(stored)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime()->Repetitions(5)->ReportAggregatesOnly();
BENCHMARK(both_ends)
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Repetitions(5)
    ->ReportAggregatesOnly();

}  // namespace
}  // namespace beadwork::speed

BENCHMARK_MAIN();
