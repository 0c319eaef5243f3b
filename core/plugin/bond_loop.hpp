#pragma once
// The loop over bonds, which every law shares. A law is a small value with
//
//   static constexpr bool turns;           // reads orientations and gives torques
//   template <Pass pass, class At, class T> Wrench<T> act(const At& at, const Ends<T>& ends) const;
//   template <class At, class T> T stored(const At& at, const Ends<T>& ends) const;      // recoverable energy [J]
//   template <class At> auto dissipated(const At& at) const;                              // if it takes any [J]
// if forces end abruptly (BondLaw::end)
//   Wrench<Real> ended(const One& at, const Ends<Real>& ends) const;
//
// `Ends<T>` has how far the ends are apart. Only a law that says so sees more, and names what it sees: with `turns` it
// takes `TurningEnds<T>`, with
//
//   static constexpr bool moves = true;    // reads velocities, and spins where it turns
//
// `MovingEnds<T>` or `TurningMovingEnds<T>`. The velocities are those of the step whose forces are asked for. Such a
// law says what it takes:
//
//   template <class At, class T> T power(const At& at, const MovingEnds<T>& ends) const;  // that its damping takes [W]
//
// `At` stands for the bonds at hand, one or as many as a pack has lanes: at(column) loads their numbers,
// at.store(column, value) writes them, at.flag(mask) tells the loop that something changed for good. The law never
// branches on a T. Numbers of the law itself, the same for all bonds, are Real and become a T where they are used.
//
// A law that can act in single precision too does so in two strokes: how the second end lies against where the bond at
// rest would have it, found in double, and what follows from that, in which no large number is taken from another
// (docs/decisions/mixed-precision.md):
//
//   template <class At, class T> BeamShift<T> shift(const At& at, const Ends<T>& ends) const;
//   template <Pass pass, class At, class T> Wrench<T> act(const At& at, const BeamShift<T>& shift) const;

#include <algorithm>
#include <variant>
#include <vector>

#include "core/base/parallel.hpp"
#include "core/base/sums.hpp"
#include "core/plugin/bond_single.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork {

namespace bond_loop {

/// Bonds whose second ends are fetched while those before them are worked on: first ends come in order, second ends do
/// not, and a processor does not see as far ahead as the next pack.
inline constexpr Index ahead = 32;

/// The bonds of a chunk, in packs as far as they fill them.
template <Pass pass, class Law>
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
      e.add<Law::turns, W>(first + b, target + b,
                           l.template act<pass>(Several<W>{b, &flagged}, e.ends<Law, W>(first + b, second + b)));
    }
  }
  for (; b < chunk.live_end; ++b)
    e.add<Law::turns>(first[b], target[b], l.template act<pass>(One{b, &flagged}, e.ends<Law>(first[b], second[b])));
  return flagged;
}

/// The same with forces in single precision. Each bond is rounded by itself, so the bits do not depend on packs.
template <Pass pass, class Law>
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
      const auto shift = narrow(l.shift(low, e.ends<Law, W>(first + b, second + b)),
                                l.shift(high, e.ends<Law, W>(first + b + W, second + b + W)));
      const auto wrench = l.template act<pass>(SeveralSingle<W>{low, high}, shift);
      e.add<Law::turns, W>(first + b, target + b, widen<false>(wrench));
      e.add<Law::turns, W>(first + b + W, target + b + W, widen<true>(wrench));
    }
  }
  for (; b < chunk.live_end; ++b) {
    const One one{b, &flagged};
    e.add<Law::turns>(
        first[b], target[b],
        widen(l.template act<pass>(OneSingle{one}, narrow(l.shift(one, e.ends<Law>(first[b], second[b]))))));
  }
  return flagged;
}

/// Runs the law over all live bonds; the chunks in which it flagged something, ascending.
template <Pass pass, class Law>
std::vector<Index> run(const Law& law, const BondTable& table, Domain& domain, bool clear) {
  const ElementLines e = ElementLines::of(domain);
  e.require<Law>();
  const auto chunks = static_cast<Index>(table.chunks().size());
  const Index length = block_length(domain.size());
  std::vector<char> flagged(static_cast<std::size_t>(chunks), 0);
  each_shared(chunks, [&](Index c) {
    const Chunk& chunk = table.chunks()[static_cast<std::size_t>(c)];
    if (clear) e.clear(c * length, std::min((c + 1) * length, domain.size()));
    e.clear(chunk.halo_begin, chunk.halo_end);
    if constexpr (pass.single)
      flagged[static_cast<std::size_t>(c)] = run_chunk_single<pass>(law, table, e, chunk);
    else
      flagged[static_cast<std::size_t>(c)] = run_chunk<pass>(law, table, e, chunk);
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

/// A law that reads velocities has to say how they damp, or it is no class of which there can be objects.
class MovingBondLaw : public BondLaw {
 public:
  Matrix12 damping(const Domain& domain, const BondTable& table, Index row) const override = 0;
};

/// A bond law whose loop is the core's. The plugin builds the law as a value, with its columns, in `law()`; where the
/// deck chooses among several laws, each is a loop of its own.
template <class... Laws>
class BondLawOf : public std::conditional_t<(beadwork::moves<Laws>() || ...), MovingBondLaw, BondLaw> {
 public:
  using AnyLaw = std::variant<Laws...>;

  void act(Domain& domain, BondTable& table, const Evaluation& how) final {
    const auto flagged = std::visit(
        [&](const auto& value) {
          if (how.settle)
            return how.sections ? run<true, true>(value, table, domain, how)
                                : run<true, false>(value, table, domain, how);
          return how.sections ? run<false, true>(value, table, domain, how)
                              : run<false, false>(value, table, domain, how);
        },
        law());
    events_.clear();
    if (how.settle && !flagged.empty()) note_changes(table, flagged, events_);
  }
  std::span<const BondEvent> events() const final { return events_; }

  void withdraw(Domain& domain, const BondTable& table, Index row) final {
    std::visit(
        [&]<class Law>(const Law& value) {
          const auto e = ElementLines::of(domain);
          const Index i = table.first()[row];
          const Index j = table.second()[row];
          bool ignored = false;
          e.add<Law::turns>(i, j, value.template act<Pass{}>(One{row, &ignored}, e.ends<Law>(i, j)), -1);
        },
        law());
  }

  void end(Domain& domain, BondTable& table, Index row) override {
    std::visit(
        [&]<class Law>(const Law& value) {
          if constexpr (requires { &Law::ended; }) {
            const auto e = ElementLines::of(domain);
            const Index i = table.first()[row];
            const Index j = table.second()[row];
            e.add<Law::turns>(i, j, value.ended(One{row, nullptr}, e.ends<Law>(i, j)), -1);
          }
        },
        law());
  }

  Real stored_energy(const Domain& domain, const BondTable& table, Index row) const final {
    return std::visit([&](const auto& value) { return stored_by(value, ElementLines::of(domain), table, row); }, law());
  }
  Real stored_energy(const Domain& domain, const BondTable& table) const final {
    return std::visit(
        [&](const auto& value) {
          const auto lines = ElementLines::of(domain);
          return bond_loop::sum(table, [&](Index row) { return stored_by(value, lines, table, row); });
        },
        law());
  }
  Real dissipated_energy(const Domain&, const BondTable& table) const final {
    return std::visit(
        [&](const auto& value) -> Real {
          if constexpr (requires { value.dissipated(One{}); })
            return bond_loop::sum(table, [&](Index row) { return value.dissipated(One{row, nullptr}); });
          else
            return 0;
        },
        law());
  }
  bool turns() const override {
    return std::visit([]<class Law>(const Law&) { return Law::turns; }, law());
  }
  bool moves() const final {
    return std::visit([]<class Law>(const Law&) { return beadwork::moves<Law>(); }, law());
  }
  Real power(const Domain& domain, const BondTable& table) const final {
    return std::visit([&](const auto& value) { return power_of(value, domain, table); }, law());
  }
  bool can_be_single() const final {
    return std::visit([]<class Law>(const Law&) { return has_shift<Law>(); }, law());
  }

 protected:
  virtual AnyLaw law() const = 0;
  /// Looks through the flagged chunks for bonds that changed for good, sets their state, and says so.
  virtual void note_changes(BondTable&, std::span<const Index>, std::vector<BondEvent>&) {}

 private:
  template <bool settle, bool sections, class Law>
  static std::vector<Index> run(const Law& value, const BondTable& table, Domain& domain, const Evaluation& how) {
    if constexpr (has_shift<Law>())
      if (how.single) return bond_loop::run<Pass{settle, sections, true}>(value, table, domain, how.clear);
    return bond_loop::run<Pass{settle, sections, false}>(value, table, domain, how.clear);
  }
  template <class Law>
  static Real power_of(const Law& value, const Domain& domain, const BondTable& table) {
    if constexpr (beadwork::moves<Law>()) {
      const auto lines = ElementLines::of(domain);
      return bond_loop::sum(table, [&](Index row) {
        bool ignored = false;
        return value.power(One{row, &ignored}, lines.template ends<Law>(table.first()[row], table.second()[row]));
      });
    } else {
      return 0;
    }
  }
  template <class Law>
  static Real stored_by(const Law& value, const ElementLines& lines, const BondTable& table, Index row) {
    bool ignored = false;
    return value.stored(One{row, &ignored}, lines.template ends<Law>(table.first()[row], table.second()[row]));
  }
  std::vector<BondEvent> events_;
};

}  // namespace beadwork
