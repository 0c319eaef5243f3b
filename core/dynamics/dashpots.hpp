#pragma once
// Bond damping: dashpots beside the springs of each bond. They oppose what parts the two ends, and nothing else: a body
// that moves and turns as one is not braked, and both momenta are kept. docs/theory/verlet.md
//
//   F  = -c_n (v.n) n - c_t s                v = v2 - v1,  s = v - (v.n) n - (w1 + w2)/2 x d     on end 2, and back on 1
//   T1 = -d x F/2 + C (w2 - w1)              C = c_b (1 - n n) + c_w n n
//   T2 = -d x F/2 - C (w2 - w1)
//   c = 2 zeta sqrt(k m)                     with the stiffness k and the reduced mass or inertia m of each mode
//
// A pair of elements then swings with the damping ratio zeta along the bond, across it, in bending and in twist.
// Velocities are those of half a step ago, so v.n and s are taken with the chord of half a step ago: a body that spins
// is not held back.

#include "core/base/parallel.hpp"
#include "core/base/sums.hpp"
#include "core/dynamics/motion.hpp"
#include "core/mechanics/dashpot.hpp"
#include "core/plugin/blame.hpp"
#include "core/plugin/bond_law_of.hpp"

namespace beadwork {

/// `turning`: elements have spins; otherwise only the central dashpot acts, which alone needs no torques.
template <bool turning>
struct DashpotLaw {
  View<const Real> along, across, bending, twisting;
  Real half_step;  ///< since the velocities [s]
  static constexpr bool turns = turning;
  static constexpr bool moves = true;

  template <Pass, class At, class Both>
  [[gnu::always_inline]] auto act(const At& at, const Both& ends) const {
    using T = typename At::Number;
    const Vec<T>& d = ends.apart;
    const Vec<T> v = ends.v2 - ends.v1;
    const Vec<T> then = d - T(half_step) * v;
    const T parting = dot(v, then) / dot(then, then);  // rate of the length over the length
    const Vec<T> central = (at(along) * parting) * d;
    if constexpr (turning) {
      const Vec<T> slip = v - parting * then - T(0.5) * cross(ends.w1 + ends.w2, then);
      const Vec<T> force = -central - at(across) * slip;
      const Vec<T> half = T(0.5) * cross(force, d);
      const Vec<T> turn = ends.w2 - ends.w1;
      const T b = at(bending);
      const Vec<T> couple = b * turn + ((at(twisting) - b) * dot(turn, d) / dot(d, d)) * d;
      return Wrench<T>{copy(force), half + couple, half - couple};
    } else {
      return Wrench<T>{-central, zero<Vec<T>>(), zero<Vec<T>>()};
    }
  }
};

/// The dashpots of all families whose bonds either hold or are broken. Contacts that soften have none: they would make
/// the interface tougher than its law says.
class Dashpots {
 public:
  /// Finds the rates at the present state, or those that were kept where the run was resumed.
  void prepare(Workings& w, Real zeta, const View<const Real>& mass, const View<const Real>& inertia, bool resumed) {
    families_.clear();
    pushed_.clear();
    for (const auto& [law, table] : w.laws()) {
      if (law->acts_when_broken()) continue;
      for (const Field* field : {&along, &across, &bending, &twisting}) table->rows().add(*field).keep();
      table->rebind();
      const auto rate = [&, rows = &table->rows()](const Field& field) {
        return rows->column(field.name).view<Real>();
      };
      families_.push_back({table, rate(along), rate(across), rate(bending), rate(twisting)});
      if (!resumed) fill(w.domain(), *law, families_.back(), zeta, mass, inertia);
    }
  }

  bool any() const { return !families_.empty(); }

  /// The bonds' part in what limits the step: K grows by 2/dt C.   docs/theory/verlet.md
  Matrix12 stiffening(const BondTable& table, Index row, const Vec3& d, Real dt) const {
    for (const Family& f : families_)
      if (f.table == &table)
        return (2 / dt) * dashpot_matrix({f.along[row], f.across[row], f.bending[row], f.twisting[row]}, d);
    return Matrix12::Zero();
  }

  /// Adds their forces to those that are there; what they added is remembered for `power`.
  void act(Domain& domain, const Motion& all, Real half_step) {
    pushed_.resize(static_cast<std::size_t>(all.count));
    turned_.resize(all.torque ? pushed_.size() : 0);
    each_shared(
        all.count,
        [&](Index i) {
          pushed_[static_cast<std::size_t>(i)] = all.force[i];
          if (all.torque) turned_[static_cast<std::size_t>(i)] = all.torque[i];
        },
        few);
    domain.clear_halo();
    const ElementLines lines(
        {all.place, all.orientation, all.velocity, all.spin, all.force, all.torque, {}, {}, all.count});
    for (const Family& f : families_) {
      if (all.torque)
        bond_loop::run<Pass{}>(DashpotLaw<true>{f.along, f.across, f.bending, f.twisting, half_step}, *f.table, lines,
                               all.count, false);
      else
        bond_loop::run<Pass{}>(DashpotLaw<false>{f.along, f.across, f.bending, f.twisting, half_step}, *f.table, lines,
                               all.count, false);
    }
    domain.gather();
    each_shared(
        all.count,
        [&](Index i) {
          pushed_[static_cast<std::size_t>(i)] = all.force[i] - pushed_[static_cast<std::size_t>(i)];
          if (all.torque) turned_[static_cast<std::size_t>(i)] = all.torque[i] - turned_[static_cast<std::size_t>(i)];
        },
        few);
  }

  /// Power that they took at these velocities and spins [W]; 0 where there are none.
  Real power(const View<Vec3>& velocity, const View<Vec3>& spin) const {
    if (!any()) return 0;
    return -fixed_sum(static_cast<Index>(pushed_.size()), [&](Index i) {
      Real power = pushed_[static_cast<std::size_t>(i)].dot(velocity[i]);
      if (spin) power += turned_[static_cast<std::size_t>(i)].dot(spin[i]);
      return power;
    });
  }

  /// By how much the energy that is booked for them lags behind what they took: dt^2/4 of their force times the
  /// acceleration [J].
  Real lag(const Motion& all, Real dt) const {
    if (pushed_.empty()) return 0;
    return dt * dt / 4 * fixed_sum(all.count, [&](Index i) {
             Real sum = pushed_[static_cast<std::size_t>(i)].dot(all.force[i]) / all.mass[i];
             if (all.spin) sum += turned_[static_cast<std::size_t>(i)].dot(all.torque[i]) / all.inertia[i];
             return sum;
           });
  }

 private:
  static constexpr Index few = 256;  ///< elements from which on they are shared among the threads

  static inline const Field along{"damping-along", On::bonds, Type::real, "N.s/m", "Dashpot along the bond", ""};
  static inline const Field across{"damping-across", On::bonds, Type::real, "N.s/m", "Dashpot across the bond", ""};
  static inline const Field bending{"damping-bending", On::bonds, Type::real, "N.m.s", "Dashpot against bending", ""};
  static inline const Field twisting{"damping-twisting", On::bonds, Type::real, "N.m.s", "Dashpot against twist", ""};

  struct Family {
    BondTable* table;
    View<Real> along, across, bending, twisting;
  };

  static void fill(const Domain& domain, const PairLaw& law, const Family& family, Real zeta,
                   const View<const Real>& mass, const View<const Real>& inertia) {
    const auto position = domain.elements().column("position").view<Vec3>();
    const BondTable& table = *family.table;
    for (const Chunk& chunk : table.chunks())
      for (Index b = chunk.begin; b < chunk.live_end; ++b) {
        const Index i = table.first()[b], j = table.second()[b];
        const DashpotRates c = dashpot_rates(
            blaming(law, "tangent", [&] { return law.tangent(domain, table, b, Slope::stiffest); }),
            position[j] - position[i], zeta, 1 / mass[i] + 1 / mass[j], inertia ? 1 / inertia[i] + 1 / inertia[j] : 0);
        family.along[b] = c.along;
        family.across[b] = c.across;
        family.bending[b] = c.bending;
        family.twisting[b] = c.twisting;
      }
  }

  std::vector<Family> families_;
  std::vector<Vec3> pushed_, turned_;  // what the dashpots added to each element's load
};

}  // namespace beadwork
