#pragma once
// The loop over bonds, which every law shares. A law is a small value with
//
//   static constexpr bool turns;           // reads orientations and gives torques
//   template <Pass pass, class At, class T> Wrench<T> act(const At& at, const Ends<T>& ends) const;
//   template <class At, class T> T stored(const At& at, const Ends<T>& ends) const;      // recoverable energy [J]
//   template <class At> auto dissipated(const At& at) const;                              // if it takes any [J]
//   Wrench<Real> ended(const One& at, const Ends<Real>& ends) const;                     // if forces end abruptly
//   Matrix12 stiffness(const One& at, const Ends<Real>& ends, Slope slope) const;         // stiffest and secant
//
// `Ends<T>` has how far the ends are apart. Only a law that says so sees more, and names what it sees: with `turns` it
// takes `TurningEnds<T>`, with
//
//   static constexpr bool moves = true;    // reads velocities, and spins where it turns
//
// `MovingEnds<T>` or `TurningMovingEnds<T>`. The velocities are
// those of the step whose forces are asked for, or, with
//
//   static constexpr bool travels = true;  // instead of `moves`
//
// those half-way of it, by which the ends came here: times the time step they are the way that was made. A law that
// moves says what it takes, and how it damps:
//
//   template <class At, class T> T power(const At& at, const MovingEnds<T>& ends) const;  // that its damping takes [W]
//   Matrix12 damping(const One& at, const MovingEnds<Real>& ends) const;                  // loads = -C rates
//
// `At` stands for the bonds at hand, one or as many as a pack has lanes: at(column) loads their numbers,
// at.store(column, value) writes them, at.flag(mask) tells the loop that something changed for good. The law never
// branches on a T. Numbers of the law itself, the same for all bonds, are Real and become a T where they are used.
// T is a Real, a pack of as many as the processor takes at once, or a number with its slopes (core/mechanics/dual.hpp): by
// that the law gives its own derivative, and states none.
//
// A law that can act in single precision too does so in two strokes: how the second end lies against where the bond at
// rest would have it, found in double, and what follows from that, in which no large number is taken from another
// (docs/decisions/mixed-precision.md):
//
//   template <class At, class T> BeamShift<T> shift(const At& at, const Ends<T>& ends) const;
//   template <Pass pass, class At, class T> Wrench<T> act(const At& at, const BeamShift<T>& shift) const;

#include <algorithm>
#include <vector>

#include "core/base/parallel.hpp"
#include "core/base/sums.hpp"
#include "core/bonds/single.hpp"
#include "core/domain/domain.hpp"

namespace beadwork {

namespace bond_loop {

/// Bonds whose second ends are fetched while those before them are worked on: first ends come in order, second ends do
/// not, and a processor does not see as far ahead as the next pack.
inline constexpr Index ahead = 32;

/// The bonds of a chunk, in packs as far as they fill them; `sums`: somebody reads sums beside those of the forces.
template <Pass pass, bool sums, class Law>
bool run_chunk(const Law& law, const BondTable& table, const ElementLines& elements, const Chunk& chunk) {
  const Index* first = &table.first()[0];
  const Index* second = &table.second()[0];
  const Index* target = &table.target()[0];
  const Law l = law;
  const ElementLines e = elements;
  bool flagged = false;
  Index b = chunk.begin;
  if constexpr (pack_width > 1) {
    constexpr int W = pack_width;
    for (; b + W <= chunk.live_end; b += W) {
      if (e.far() && b + ahead + W <= chunk.live_end) e.prefetch<W>(second + b + ahead);
      if constexpr (sums) {
        const auto ends = e.ends<Law, W>(first + b, second + b);
        const auto wrench = l.template act<pass>(Several<W>{b, &flagged}, ends);
        e.add<Law::turns, W>(first + b, target + b, wrench);
        e.add_virial<W>(first + b, target + b, ends.apart, wrench.force);
      } else {  // without names g++ keeps it all in registers (measured: an eighth of the instructions)
        e.add<Law::turns, W>(first + b, target + b,
                             l.template act<pass>(Several<W>{b, &flagged}, e.ends<Law, W>(first + b, second + b)));
      }
    }
  }
  for (; b < chunk.live_end; ++b) {
    const auto ends = e.ends<Law>(first[b], second[b]);
    const auto wrench = l.template act<pass>(One{b, &flagged}, ends);
    e.add<Law::turns>(first[b], target[b], wrench);
    if constexpr (sums) e.add_virial<1>(first + b, target + b, ends.apart, wrench.force);
  }
  return flagged;
}

/// The same with forces in single precision. Each bond is rounded by itself, so the bits do not depend on packs.
template <Pass pass, bool sums, class Law>
bool run_chunk_single(const Law& law, const BondTable& table, const ElementLines& elements, const Chunk& chunk) {
  const Index* first = &table.first()[0];
  const Index* second = &table.second()[0];
  const Index* target = &table.target()[0];
  const Law l = law;
  const ElementLines e = elements;
  [[maybe_unused]] const FlushTiny flush;
  bool flagged = false;
  Index b = chunk.begin;
  if constexpr (pack_width > 1) {
    constexpr int W = pack_width;
    for (; b + 2 * W <= chunk.live_end; b += 2 * W) {
      const Several<W> low{b, &flagged}, high{b + W, &flagged};
      if (e.far() && b + ahead + 2 * W <= chunk.live_end) e.prefetch<2 * W>(second + b + ahead);
      if constexpr (sums) {
        const auto near_ends = e.ends<Law, W>(first + b, second + b);
        const auto far_ends = e.ends<Law, W>(first + b + W, second + b + W);
        const auto wrench =
            l.template act<pass>(SeveralSingle<W>{low, high}, narrow(l.shift(low, near_ends), l.shift(high, far_ends)));
        const auto near_wrench = widen<false>(wrench), far_wrench = widen<true>(wrench);
        e.add<Law::turns, W>(first + b, target + b, near_wrench);
        e.add_virial<W>(first + b, target + b, near_ends.apart, near_wrench.force);
        e.add<Law::turns, W>(first + b + W, target + b + W, far_wrench);
        e.add_virial<W>(first + b + W, target + b + W, far_ends.apart, far_wrench.force);
      } else {
        const auto shift = narrow(l.shift(low, e.ends<Law, W>(first + b, second + b)),
                                  l.shift(high, e.ends<Law, W>(first + b + W, second + b + W)));
        const auto wrench = l.template act<pass>(SeveralSingle<W>{low, high}, shift);
        e.add<Law::turns, W>(first + b, target + b, widen<false>(wrench));
        e.add<Law::turns, W>(first + b + W, target + b + W, widen<true>(wrench));
      }
    }
  }
  for (; b < chunk.live_end; ++b) {
    const One one{b, &flagged};
    const auto ends = e.ends<Law>(first[b], second[b]);
    const auto wrench = widen(l.template act<pass>(OneSingle{one}, narrow(l.shift(one, ends))));
    e.add<Law::turns>(first[b], target[b], wrench);
    if constexpr (sums) e.add_virial<1>(first + b, target + b, ends.apart, wrench.force);
  }
  return flagged;
}

/// Runs the law over all live bonds; the chunks in which it flagged something, ascending.
template <Pass pass, class Law>
std::vector<Index> run(const Law& law, const BondTable& table, const ElementLines& e, Index elements, bool clear) {
  const auto chunks = static_cast<Index>(table.chunks().size());
  const Index length = block_length(elements);
  std::vector<char> flagged(static_cast<std::size_t>(chunks), 0);
  each_shared(chunks, [&](Index c) {
    const Chunk& chunk = table.chunks()[static_cast<std::size_t>(c)];
    if (clear) e.clear(c * length, std::min((c + 1) * length, elements));
    e.clear(chunk.halo_begin, chunk.halo_end);
    const auto go = [&]<bool sums>() {
      if constexpr (pass.single)
        return run_chunk_single<pass, sums>(law, table, e, chunk);
      else
        return run_chunk<pass, sums>(law, table, e, chunk);
    };
    if constexpr (pass.sections)
      flagged[static_cast<std::size_t>(c)] =
          e.sums() ? go.template operator()<true>() : go.template operator()<false>();
    else
      flagged[static_cast<std::size_t>(c)] = go.template operator()<false>();
  });
  std::vector<Index> list;
  for (Index c = 0; c < chunks; ++c)
    if (flagged[static_cast<std::size_t>(c)]) list.push_back(c);
  return list;
}

/// Sum of f(row) over the live bonds: each chunk in order, then the chunks in order.
template <class F>
Real sum(const BondTable& table, const F& f) {
  return sum_of_blocks(static_cast<Index>(table.chunks().size()), [&](Index c) {
    const Chunk& chunk = table.chunks()[static_cast<std::size_t>(c)];
    Real total = 0;
    for (Index b = chunk.begin; b < chunk.live_end; ++b) total += f(b);
    return total;
  });
}

}  // namespace bond_loop

}  // namespace beadwork
