#pragma once
// The loop over bonds, which every law shares. A law is a small value with
//
//   static constexpr bool turns;           // reads orientations and gives torques
//   template <Pass pass, class At, class T> Wrench<T> act(const At& at, const Ends<T>& ends) const;
//   template <class At, class T> T stored(const At& at, const Ends<T>& ends) const;      // recoverable energy [J]
//   template <class At> auto dissipated(const At& at) const;                              // if it takes any [J]
//   static constexpr bool moves = true;    // if it reads velocities, and spins where it turns
//
// `At` stands for the bonds at hand, one or as many as a pack has lanes: at(column) loads their numbers, at.store(column,
// value) writes them, at.flag(mask) tells the loop that something changed for good. The law never branches on a T. Numbers
// of the law itself, the same for all bonds, are Real and become a T where they are used.
//
// A law that can act in single precision too does so in two strokes: how the second end lies against where the bond at rest would
// have it, found in double, and what follows from that, in which no large number is taken from another
// (docs/decisions/mixed-precision.md):
//
//   template <class At, class T> BeamShift<T> shift(const At& at, const Ends<T>& ends) const;
//   template <Pass pass, class At, class T> Wrench<T> act(const At& at, const BeamShift<T>& shift) const;

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <variant>
#include <vector>

#include "core/base/pack.hpp"
#include "core/base/parallel.hpp"
#include "core/base/sums.hpp"
#include "core/mechanics/beam.hpp"
#include "core/mechanics/lane.hpp"
#include "core/mechanics/wrench.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork {

template <class T>
struct Ends {
  Vec<T> apart;           ///< x2 - x1 [m]
  Quaternion<T> q1, q2;   ///< where the law turns
  Vec<T> v1, v2, w1, w2;  ///< velocities and spins, where the law reads them
};

template <class Law>
constexpr bool moves() {
  if constexpr (requires { Law::moves; }) return Law::moves;
  return false;
}

struct Pass {
  bool settle = false;
  bool sections = false;
  bool single = false;
};

/// One bond. Columns of a bond table lie plane by plane, so a row's number stands at a fixed distance from the base.
struct One {
  using Number = Real;
  Index row = 0;
  bool* flagged = nullptr;

  [[gnu::always_inline]] Real operator()(const View<const Real>& column) const { return number(column.base()); }
  [[gnu::always_inline]] Vec3 operator()(const View<const Vec3>& column) const {
    const std::byte* base = column.base();
    return {number(base), number(base + column.plane()), number(base + 2 * column.plane())};
  }
  [[gnu::always_inline]] Quat operator()(const View<const Quat>& column) const {
    const std::byte* base = column.base();
    const std::size_t plane = column.plane();
    return {number(base), Vec3(number(base + plane), number(base + 2 * plane), number(base + 3 * plane))};
  }
  [[gnu::always_inline]] void store(const View<Real>& column, Real value) const { column[row] = value; }
  void store(const View<Vec3>& column, const Vec3& value) const { column.set(row, value); }
  [[gnu::always_inline]] void flag(bool mask) const { *flagged |= mask; }

 private:
  [[gnu::always_inline]] Real number(const std::byte* base) const { return reinterpret_cast<const Real*>(base)[row]; }
};

/// As many bonds as a pack has lanes: rows `row`, row + 1, ...
template <int W>
struct Several {
  using Number = Pack<W>;
  Index row = 0;
  bool* flagged = nullptr;

  [[gnu::always_inline]] Pack<W> operator()(const View<const Real>& column) const { return numbers(column.base()); }
  [[gnu::always_inline]] Vec<Pack<W>> operator()(const View<const Vec3>& column) const {
    const std::byte* base = column.base();
    return {numbers(base), numbers(base + column.plane()), numbers(base + 2 * column.plane())};
  }
  [[gnu::always_inline]] Quaternion<Pack<W>> operator()(const View<const Quat>& column) const {
    const std::byte* base = column.base();
    const std::size_t plane = column.plane();
    return {numbers(base), {numbers(base + plane), numbers(base + 2 * plane), numbers(base + 3 * plane)}};
  }
  [[gnu::always_inline]] void store(const View<Real>& column, const Pack<W>& value) const { value.store(&column[row]); }
  [[gnu::always_inline]] void store(const View<Vec3>& column, const Vec<Pack<W>>& value) const {
    for (int c = 0; c < 3; ++c) value[c].store(&column.at(row, c));
  }
  template <class M>
  [[gnu::always_inline]] void flag(const M& mask) const {
    *flagged |= any(mask);
  }

 private:
  [[gnu::always_inline]] Pack<W> numbers(const std::byte* base) const { return Pack<W>::load(reinterpret_cast<const Real*>(base) + row); }
};

template <class Law>
constexpr bool has_shift() {
  return requires(const Law& law, const One& at, const Ends<Real>& ends) { law.shift(at, ends); };
}

/// One bond, and as many as two packs hold, in single precision. Columns stay in double.
struct OneSingle {
  using Number = float;
  One one;

  [[gnu::always_inline]] float operator()(const View<const Real>& column) const { return static_cast<float>(one(column)); }
  [[gnu::always_inline]] Vec<float> operator()(const View<const Vec3>& column) const { return one(column).cast<float>(); }
  [[gnu::always_inline]] void store(const View<Real>& column, float value) const { one.store(column, value); }
  [[gnu::always_inline]] void flag(bool mask) const { one.flag(mask); }
};
template <int W>
struct SeveralSingle {
  using Number = Pack<2 * W, float>;
  Several<W> low, high;

  [[gnu::always_inline]] Number operator()(const View<const Real>& column) const { return pack::narrow(low(column), high(column)); }
  [[gnu::always_inline]] Vec<Number> operator()(const View<const Vec3>& column) const {
    const Vec<Pack<W>> a = low(column), b = high(column);
    return {pack::narrow(a[0], b[0]), pack::narrow(a[1], b[1]), pack::narrow(a[2], b[2])};
  }
  [[gnu::always_inline]] void store(const View<Real>& column, const Number& value) const {
    low.store(column, pack::widen<false>(value));
    high.store(column, pack::widen<true>(value));
  }
  template <class M>
  [[gnu::always_inline]] void flag(const M& mask) const {
    low.flag(mask);
  }
};

[[gnu::always_inline]] inline BeamShift<float> narrow(const BeamShift<Real>& s) {
  return {s.moved.cast<float>(), s.normal.cast<float>(), {static_cast<float>(s.turn.w), s.turn.v.cast<float>()}};
}
template <int W>
[[gnu::always_inline]] inline BeamShift<Pack<2 * W, float>> narrow(const BeamShift<Pack<W>>& a, const BeamShift<Pack<W>>& b) {
  const auto vector = [](const Vec<Pack<W>>& u, const Vec<Pack<W>>& v) __attribute__((always_inline)) {
    return Vec<Pack<2 * W, float>>{pack::narrow(u[0], v[0]), pack::narrow(u[1], v[1]), pack::narrow(u[2], v[2])};
  };
  return {vector(a.moved, b.moved), vector(a.normal, b.normal), {pack::narrow(a.turn.w, b.turn.w), vector(a.turn.v, b.turn.v)}};
}
inline Wrench<Real> widen(const Wrench<float>& w) { return {w.force.cast<Real>(), w.torque1.cast<Real>(), w.torque2.cast<Real>()}; }
template <bool upper, int W>
[[gnu::always_inline]] inline Wrench<Pack<W / 2>> widen(const Wrench<Pack<W, float>>& w) {
  const auto vector = [](const Vec<Pack<W, float>>& u) __attribute__((always_inline)) {
    return Vec<Pack<W / 2>>{pack::widen<upper>(u[0]), pack::widen<upper>(u[1]), pack::widen<upper>(u[2])};
  };
  return {vector(w.force), vector(w.torque1), vector(w.torque2)};
}

/// The lines of the elements that the loop reads and adds to: position and orientation share one, velocity and spin another,
/// force and torque a third.
class ElementLines {
 public:
  static ElementLines of(const Domain& domain) {
    const auto base = [&](const char* name) {
      const Column* column = domain.elements().find(name);
      return column ? column->base() : nullptr;
    };
    ElementLines lines;
    lines.position_ = base("position");
    lines.orientation_ = base("orientation");
    lines.force_ = base("force");
    lines.torque_ = base("torque");
    lines.velocity_ = base("velocity");
    lines.spin_ = base("spin");
    if (const Column* velocity = domain.elements().find("velocity")) lines.motion_ = velocity->stride();
    lines.pose_ = domain.elements().column("position").stride();
    if (const Column* force = domain.elements().find("force")) lines.load_ = force->stride();
    lines.far_ = static_cast<std::size_t>(domain.size()) * (lines.pose_ + lines.load_) > near;
    return lines;
  }

  /// What a law says of itself must fit what its plugin asked for. Throws std::logic_error.
  template <class Law>
  void require() const {
    const auto beside = [](const std::byte* first, const std::byte* second) { return first && second == first + 3 * sizeof(Real); };
    if (!position_ || !force_) throw std::logic_error("a bond law reads position and adds to force");
    if (Law::turns && !(beside(position_, orientation_) && beside(force_, torque_)))
      throw std::logic_error("a bond law that turns reads orientation and adds to torque");
    if (moves<Law>() && !(velocity_ && (!Law::turns || beside(velocity_, spin_))))
      throw std::logic_error("a bond law that moves reads velocity, and spin where it turns");
  }

  template <class Law>
  [[gnu::always_inline]] Ends<Real> ends(Index i, Index j) const {
    const Real *x1 = at(position_, i, pose_), *x2 = at(position_, j, pose_);
    Ends<Real> ends;
    ends.apart = {x2[0] - x1[0], x2[1] - x1[1], x2[2] - x1[2]};
    if constexpr (Law::turns) {
      const Real *q1 = at(orientation_, i, pose_), *q2 = at(orientation_, j, pose_);
      ends.q1 = {q1[0], {q1[1], q1[2], q1[3]}};
      ends.q2 = {q2[0], {q2[1], q2[2], q2[3]}};
    }
    if constexpr (moves<Law>()) {
      const Real *v1 = at(velocity_, i, motion_), *v2 = at(velocity_, j, motion_);
      ends.v1 = {v1[0], v1[1], v1[2]};
      ends.v2 = {v2[0], v2[1], v2[2]};
      if constexpr (Law::turns) {
        ends.w1 = {v1[3], v1[4], v1[5]};
        ends.w2 = {v2[3], v2[4], v2[5]};
      }
    }
    return ends;
  }

  /// Adds the wrench, or takes it off again (`sign` -1), at the rows of the force line of its two ends.
  template <bool turns>
  [[gnu::always_inline]] void add(Index i, Index k, const Wrench<Real>& w, Real sign = 1) const {
    const std::size_t at_i = static_cast<std::size_t>(i) * load_;
    const std::size_t at_k = static_cast<std::size_t>(k) * load_;
    add_to(force_ + at_i, w.force, -sign);
    add_to(force_ + at_k, w.force, sign);
    if constexpr (turns) {
      add_to(torque_ + at_i, w.torque1, sign);
      add_to(torque_ + at_k, w.torque2, sign);
    }
  }

  /// As above for the bonds of several lanes, whose ends stand at i[0], i[1], ... and j[0], j[1], ...
  template <class Law, int W>
  [[gnu::always_inline]] Ends<Pack<W>> ends(const Index* i, const Index* j) const {
    const auto line = [](std::byte* base, std::size_t stride, const Index* of, int half) {
      return pack::fetch<W>([=](int lane) { return at(base, of[lane], stride) + 4 * half; });
    };
    Ends<Pack<W>> ends;
    if constexpr (!Law::turns) {
      ends.apart = apart<W>(i, j);
    } else {  // x y z qw | qx qy qz
      const auto a = line(position_, pose_, i, 0);
      const auto b = line(position_, pose_, j, 0);
      ends.apart = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
      const auto c = line(position_, pose_, i, 1);
      const auto d = line(position_, pose_, j, 1);
      ends.q1 = {a[3], {c[0], c[1], c[2]}};
      ends.q2 = {b[3], {d[0], d[1], d[2]}};
    }
    if constexpr (moves<Law>()) {  // vx vy vz wx | wy wz
      const auto v = line(velocity_, motion_, i, 0);
      const auto u = line(velocity_, motion_, j, 0);
      ends.v1 = {v[0], v[1], v[2]};
      ends.v2 = {u[0], u[1], u[2]};
      if constexpr (Law::turns) {
        const auto w = line(velocity_, motion_, i, 1);
        const auto z = line(velocity_, motion_, j, 1);
        ends.w1 = {v[3], w[0], w[1]};
        ends.w2 = {u[3], z[0], z[1]};
      }
    }
    return ends;
  }

  /// Lines that are more than a cache holds are worth to be asked for early.
  bool far() const { return far_; }
  template <int W>
  [[gnu::always_inline]] void prefetch(const Index* j, const Index* k) const {
    for (int lane = 0; lane < W; ++lane) {
      __builtin_prefetch(at(position_, j[lane], pose_));
      __builtin_prefetch(at(force_, k[lane], load_), 1);
    }
  }

  /// Lane by lane, in the order of the bonds: each sum takes its terms as the scalar loop adds them.
  template <bool turns, int W>
  [[gnu::always_inline]] void add(const Index* i, const Index* k, const Wrench<Pack<W>>& w) const {
    const Vec<Pack<W>>& f = w.force;
    if constexpr (turns && W == 8) {  // whole lines: fx fy fz tx ty tz - -
      const Pack<W> nothing(-0.0);    // x + (-0.0) is x, whatever the sign of a zero
      const auto line1 = pack::rows_of_eight<W>({-f[0], -f[1], -f[2], w.torque1[0], w.torque1[1], w.torque1[2], nothing, nothing});
      const auto line2 = pack::rows_of_eight<W>({f[0], f[1], f[2], w.torque2[0], w.torque2[1], w.torque2[2], nothing, nothing});
      for (std::size_t lane = 0; lane < W; ++lane) {
        add_to(at(force_, i[lane], load_), line1[lane]);
        add_to(at(force_, k[lane], load_), line2[lane]);
      }
    } else if constexpr (turns) {   // fx fy fz tx | ty tz - -
      const Pack<W> nothing(-0.0);
      const auto low1 = pack::rows<W>({-f[0], -f[1], -f[2], w.torque1[0]});
      const auto low2 = pack::rows<W>({f[0], f[1], f[2], w.torque2[0]});
      const auto high1 = pack::rows<W>({w.torque1[1], w.torque1[2], nothing, nothing});
      const auto high2 = pack::rows<W>({w.torque2[1], w.torque2[2], nothing, nothing});
      for (std::size_t lane = 0; lane < W; ++lane) {
        add_to(at(force_, i[lane], load_), low1[lane], high1[lane]);
        add_to(at(force_, k[lane], load_), low2[lane], high2[lane]);
      }
    } else {
      const auto low = pack::rows<W>({f[0], f[1], f[2], Pack<W>(0)});
      for (std::size_t lane = 0; lane < W; ++lane) {
        take_from(at(force_, i[lane], load_), low[lane]);
        add_to(at(force_, k[lane], load_), low[lane]);
      }
    }
  }

  /// Lines whole, as nothing but sums of forces and torques stands in them.
  void clear(Index begin, Index end) const {
    std::memset(force_ + static_cast<std::size_t>(begin) * load_, 0, static_cast<std::size_t>(end - begin) * load_);
  }

 private:
  [[gnu::always_inline]] static void add_to(std::byte* base, const Vec3& v, Real sign) {
    Real* sum = reinterpret_cast<Real*>(base);
    sum[0] += sign * v[0];
    sum[1] += sign * v[1];
    sum[2] += sign * v[2];
  }

  [[gnu::always_inline]] static Real* at(std::byte* base, Index row, std::size_t stride) {
    return reinterpret_cast<Real*>(base + static_cast<std::size_t>(row) * stride);
  }
  /// x2 - x1 where nothing else of the two lines is wanted: subtracted before it is transposed, so that one transposition does.
  template <int W>
  [[gnu::always_inline]] Vec<Pack<W>> apart(const Index* i, const Index* j) const {
    const auto lane = [&](int k) { return Quad::load(at(position_, j[k], pose_)) - Quad::load(at(position_, i[k], pose_)); };
    std::array<Pack<W>, 4> rows;
    for (int k = 0; k < 4; ++k) rows[static_cast<std::size_t>(k)] = pack::join<W>(lane(k), W == 4 ? Quad(0) : lane(k + 4));
    const auto d = pack::transpose<W>(rows);
    return {d[0], d[1], d[2]};
  }

  template <int W>
  [[gnu::always_inline]] static void add_to(Real* line, const Pack<W>& low) { (Pack<W>::load(line) + low).store(line); }
  [[gnu::always_inline]] static void take_from(Real* line, const Quad& low) { (Quad::load(line) - low).store(line); }
  [[gnu::always_inline]] static void add_to(Real* line, const Quad& low, const Quad& high) {
    add_to(line, low);
    add_to(line + 4, high);
  }

  std::byte *position_ = nullptr, *orientation_ = nullptr, *velocity_ = nullptr, *spin_ = nullptr, *force_ = nullptr, *torque_ = nullptr;
  std::size_t pose_ = 0, motion_ = 0, load_ = 0;
  bool far_ = false;
  static constexpr std::size_t near = 16 << 20;
};

namespace bond_loop {

/// Bonds whose second ends are fetched while those before them are worked on: first ends come in order, second ends do not.
inline constexpr Index ahead = 24;

/// Numbers that single precision cannot hold with all their digits are zero while this lives: squares of small turns are such,
/// and processors are slow with them.
class FlushTiny {
#if defined(__SSE2__)
 public:
  FlushTiny() : before_(_mm_getcsr()) { _mm_setcsr(before_ | 0x8040); }
  ~FlushTiny() { _mm_setcsr(before_); }
  FlushTiny(const FlushTiny&) = delete;
  FlushTiny& operator=(const FlushTiny&) = delete;

 private:
  unsigned before_;
#endif
};

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
      if (e.far() && b + ahead + W <= chunk.live_end) e.prefetch<W>(second + b + ahead, target + b + ahead);
      e.add<Law::turns, W>(first + b, target + b, l.template act<pass>(Several<W>{b, &flagged}, e.ends<Law, W>(first + b, second + b)));
    }
  }
  for (; b < chunk.live_end; ++b) e.add<Law::turns>(first[b], target[b], l.template act<pass>(One{b, &flagged}, e.ends<Law>(first[b], second[b])));
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
  const FlushTiny flush;
  bool flagged = false;
  Index b = chunk.begin;
  if constexpr (pack_width > 1) {
    constexpr int W = pack_width;
    for (; b + 2 * W <= chunk.live_end; b += 2 * W) {
      const Several<W> low{b, &flagged}, high{b + W, &flagged};
      if (e.far() && b + ahead + 2 * W <= chunk.live_end) e.prefetch<2 * W>(second + b + ahead, target + b + ahead);
      const auto shift = narrow(l.shift(low, e.ends<Law, W>(first + b, second + b)), l.shift(high, e.ends<Law, W>(first + b + W, second + b + W)));
      const auto wrench = l.template act<pass>(SeveralSingle<W>{low, high}, shift);
      e.add<Law::turns, W>(first + b, target + b, widen<false>(wrench));
      e.add<Law::turns, W>(first + b + W, target + b + W, widen<true>(wrench));
    }
  }
  for (; b < chunk.live_end; ++b) {
    const One one{b, &flagged};
    e.add<Law::turns>(first[b], target[b], widen(l.template act<pass>(OneSingle{one}, narrow(l.shift(one, e.ends<Law>(first[b], second[b]))))));
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

/// A bond law whose loop is the core's. The plugin builds the law as a value, with its columns, in `law()`; where the deck
/// chooses among several laws, each is a loop of its own.
template <class... Laws>
class BondLawOf : public BondLaw {
 public:
  using AnyLaw = std::variant<Laws...>;

  void act(Domain& domain, BondTable& table, const Evaluation& how) final {
    const auto flagged = std::visit(
        [&](const auto& value) {
          if (how.settle) return how.sections ? run<true, true>(value, table, domain, how) : run<true, false>(value, table, domain, how);
          return how.sections ? run<false, true>(value, table, domain, how) : run<false, false>(value, table, domain, how);
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
  static Real stored_by(const Law& value, const ElementLines& lines, const BondTable& table, Index row) {
    bool ignored = false;
    return value.stored(One{row, &ignored}, lines.template ends<Law>(table.first()[row], table.second()[row]));
  }
  std::vector<BondEvent> events_;
};

}  // namespace beadwork
