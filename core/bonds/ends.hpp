#pragma once
// What a law sees of the bonds at hand: the numbers of their columns, and their two ends, read from the lines of the
// elements, to which their forces are added.

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <type_traits>

#include "core/base/pack.hpp"
#include "core/domain/domain.hpp"
#include "core/mechanics/lane.hpp"
#include "core/mechanics/rotation.hpp"
#include "core/mechanics/virial.hpp"
#include "core/mechanics/wrench.hpp"

namespace beadwork {

/// What every law sees. Each says what it reads beyond that, and sees no more: what is not read is not there.
template <class T>
struct Ends {
  Vec<T> apart;  ///< x2 - x1 [m]
};
/// For a law with `turns`.
template <class T>
struct TurningEnds : Ends<T> {
  Quaternion<T> q1, q2;  ///< orientations
};
/// For a law with `moves`.
template <class T>
struct MovingEnds : Ends<T> {
  Vec<T> v1, v2;  ///< velocities [m/s]
};
/// For a law with both.
template <class T>
struct TurningMovingEnds : TurningEnds<T> {
  Vec<T> v1, v2;  ///< velocities [m/s]
  Vec<T> w1, w2;  ///< spins [rad/s]
};

template <class Law>
constexpr bool moves() {
  if constexpr (requires { Law::moves; }) return Law::moves;
  return false;
}

/// A law with `travels` sees by which velocities its ends came here: those half-way of the step that has just been made.
template <class Law>
constexpr bool travels() {
  if constexpr (requires { Law::travels; }) return Law::travels;
  return false;
}
template <class Law>
constexpr bool sees_rates() {
  return moves<Law>() || travels<Law>();
}

template <class Law, class T>
using EndsOf =
    std::conditional_t<sees_rates<Law>(), std::conditional_t<Law::turns, TurningMovingEnds<T>, MovingEnds<T>>,
                       std::conditional_t<Law::turns, TurningEnds<T>, Ends<T>>>;

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
  [[gnu::always_inline]] Pack<W> numbers(const std::byte* base) const {
    return Pack<W>::load(reinterpret_cast<const Real*>(base) + row);
  }
};

/// What a law reads of the elements and adds to, as its plugin declares it; null where it does not.
struct ElementViews {
  View<const Vec3> position;
  View<const Quat> orientation;
  View<const Vec3> velocity, spin;
  View<Vec3> force, torque;
  View<Sym3> virial;  ///< sums that somebody reads at this evaluation
  View<Real> virial_trace;
  Index count = 0;  ///< of the elements
};

/// The lines of the elements that the loop reads and adds to: position and orientation share one, velocity and spin
/// another, force and torque a third.
class ElementLines {
 public:
  /// Throws std::logic_error if what shares a line does not lie side by side.
  explicit ElementLines(const ElementViews& of)
      : position_(of.position.base()),
        orientation_(of.orientation.base()),
        velocity_(of.velocity.base()),
        force_(of.force.base()),
        torque_(of.torque.base()),
        virial_(of.virial),
        virial_trace_(of.virial_trace),
        pose_(of.position.stride()),
        motion_(of.velocity.stride()),
        load_(of.force.stride()),
        far_(static_cast<std::size_t>(of.count) * pose_ > near) {
    const auto beside = [](const std::byte* first, const std::byte* second) {
      return !second || (first && second == first + 3 * sizeof(Real));
    };
    if (!beside(position_, orientation_) || !beside(force_, torque_) || !beside(velocity_, of.spin.base()))
      throw std::logic_error(
          "what shares a line of the elements lies side by side: position and orientation, velocity and spin, force "
          "and torque");
  }

  template <class Law>
  [[gnu::always_inline]] EndsOf<Law, Real> ends(Index i, Index j) const {
    const Real *x1 = at(position_, i, pose_), *x2 = at(position_, j, pose_);
    EndsOf<Law, Real> ends;
    ends.apart = {x2[0] - x1[0], x2[1] - x1[1], x2[2] - x1[2]};
    if constexpr (Law::turns) {
      const Real *q1 = at(orientation_, i, pose_), *q2 = at(orientation_, j, pose_);
      ends.q1 = {q1[0], {q1[1], q1[2], q1[3]}};
      ends.q2 = {q2[0], {q2[1], q2[2], q2[3]}};
    }
    if constexpr (sees_rates<Law>()) {
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
  [[gnu::always_inline]] EndsOf<Law, Pack<W>> ends(const Index* i, const Index* j) const {
    const auto line = [](const std::byte* base, std::size_t stride, const Index* of, int half) {
      return pack::fetch<W>([=](int lane) { return at(base, of[lane], stride) + 4 * half; });
    };
    EndsOf<Law, Pack<W>> ends;
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
    if constexpr (sees_rates<Law>()) {  // vx vy vz wx | wy wz
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

  /// From some 2 MB of places on it pays to ask for them early (measured: docs/performance.md).
  bool far() const { return far_; }
  /// Asks for the places of j[0], j[1], ...
  template <int W>
  [[gnu::always_inline]] void prefetch(const Index* j) const {
    for (int lane = 0; lane < W; ++lane) __builtin_prefetch(at(position_, j[lane], pose_));
  }

  /// Lane by lane, in the order of the bonds: each sum takes its terms as the scalar loop adds them.
  template <bool turns, int W>
  [[gnu::always_inline]] void add(const Index* i, const Index* k, const Wrench<Pack<W>>& w) const {
    const Vec<Pack<W>>& f = w.force;
    if constexpr (turns && W == 8) {  // whole lines: fx fy fz tx ty tz - -
      const Pack<W> nothing(-0.0);    // x + (-0.0) is x, whatever the sign of a zero
      const auto line1 =
          pack::rows_of_eight<W>({-f[0], -f[1], -f[2], w.torque1[0], w.torque1[1], w.torque1[2], nothing, nothing});
      const auto line2 =
          pack::rows_of_eight<W>({f[0], f[1], f[2], w.torque2[0], w.torque2[1], w.torque2[2], nothing, nothing});
      for (std::size_t lane = 0; lane < W; ++lane) {
        add_to(at(force_, i[lane], load_), line1[lane]);
        add_to(at(force_, k[lane], load_), line2[lane]);
      }
    } else if constexpr (turns) {  // fx fy fz tx | ty tz - -
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

  /// Whether somebody reads sums beside those of the forces.
  [[gnu::always_inline]] bool sums() const { return virial_ || virial_trace_; }
  /// Adds what a bond gives to the virials of its ends, at the rows of the force line; lane by lane in the order of the bonds.
  template <int W, class T>
  [[gnu::always_inline]] void add_virial(const Index* i, const Index* k, const Vec<T>& apart,
                                         const Vec<T>& force) const {
    if (virial_trace_) {
      const T trace = bond_virial_trace(apart, force);
      for (std::size_t lane = 0; lane < W; ++lane) {
        virial_trace_[i[lane]] += lane_of(trace, lane);
        virial_trace_[k[lane]] += lane_of(trace, lane);
      }
    }
    if (virial_) {
      const Symmetric<T> v = bond_virial(apart, force);
      for (std::size_t lane = 0; lane < W; ++lane) {
        const Real terms[] = {lane_of(v.xx, lane), lane_of(v.xy, lane), lane_of(v.xz, lane),
                              lane_of(v.yy, lane), lane_of(v.yz, lane), lane_of(v.zz, lane)};
        for (int c = 0; c < 6; ++c) {
          virial_.at(i[lane], c) += terms[c];
          virial_.at(k[lane], c) += terms[c];
        }
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
  [[gnu::always_inline]] static const Real* at(const std::byte* base, Index row, std::size_t stride) {
    return reinterpret_cast<const Real*>(base + static_cast<std::size_t>(row) * stride);
  }
  template <class T>
  [[gnu::always_inline]] static Real lane_of(const T& value, std::size_t lane) {
    if constexpr (std::is_same_v<T, Real>)
      return value;
    else
      return value.v[lane];
  }
  /// x2 - x1 where nothing else of the two lines is wanted: subtracted before it is transposed, so that one
  /// transposition does.
  template <int W>
  [[gnu::always_inline]] Vec<Pack<W>> apart(const Index* i, const Index* j) const {
    const auto lane = [&](int k) {
      return Quad::load(at(position_, j[k], pose_)) - Quad::load(at(position_, i[k], pose_));
    };
    std::array<Pack<W>, 4> rows;
    for (int k = 0; k < 4; ++k)
      rows[static_cast<std::size_t>(k)] = pack::join<W>(lane(k), W == 4 ? Quad(0) : lane(k + 4));
    const auto d = pack::transpose<W>(rows);
    return {d[0], d[1], d[2]};
  }

  template <int W>
  [[gnu::always_inline]] static void add_to(Real* line, const Pack<W>& low) {
    (Pack<W>::load(line) + low).store(line);
  }
  [[gnu::always_inline]] static void take_from(Real* line, const Quad& low) { (Quad::load(line) - low).store(line); }
  [[gnu::always_inline]] static void add_to(Real* line, const Quad& low, const Quad& high) {
    add_to(line, low);
    add_to(line + 4, high);
  }

  static constexpr std::size_t near = std::size_t{1} << 21;
  const std::byte *position_, *orientation_, *velocity_;
  std::byte *force_, *torque_;
  View<Sym3> virial_;
  View<Real> virial_trace_;
  std::size_t pose_, motion_, load_;
  bool far_;
};

}  // namespace beadwork
