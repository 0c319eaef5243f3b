#pragma once
// Bond damping: dashpots beside the springs of each bond. They oppose what parts the two ends, and nothing else: a body that
// moves and turns as one is not braked, and both momenta are kept.   docs/theory/verlet.md
//
//   F  = -c_n (v.n) n - c_t s                v = v2 - v1,  s = v - (v.n) n - (w1 + w2)/2 x d     on end 2, the opposite on 1
//   T1 = -d x F/2 + C (w2 - w1)              C = c_b (1 - n n) + c_w n n
//   T2 = -d x F/2 - C (w2 - w1)
//   c = 2 zeta sqrt(k m)                     with the stiffness k and the reduced mass or inertia m of each mode
//
// A pair of elements then swings with the damping ratio zeta along the bond, across it, in bending and in twist. Velocities are
// those of half a step ago, so v.n and s are taken with the chord of half a step ago: a body that spins is not held back.

#include <algorithm>

#include "core/base/parallel.hpp"
#include "core/base/sums.hpp"
#include "core/mechanics/stiffness.hpp"
#include "core/plugin/bond_loop.hpp"

namespace beadwork {

/// What a bond's dashpots are worth.
struct DashpotRates {
  Real along = 0, across = 0;      ///< c_n, c_t [N s/m]
  Real bending = 0, twisting = 0;  ///< c_b, c_w [N m s]
};

/// From the stiffness of a bond (x1, theta1, x2, theta2) with d = x2 - x1, and 1/m1 + 1/m2 [1/kg] and 1/I1 + 1/I2 [1/(kg m^2)],
/// the latter 0 where nothing turns.
inline DashpotRates dashpot_rates(const Matrix12& k, const Vec3& d, Real zeta, Real lightness, Real looseness) {
  const Vec3 n = d.normalized();
  const Mat3 moved = k.block<3, 3>(6, 6);
  const Mat3 turned = 0.25 * (k.block<3, 3>(3, 3) - k.block<3, 3>(3, 9) - k.block<3, 3>(9, 3) + k.block<3, 3>(9, 9));
  const Real along = n.dot(moved * n), twist = n.dot(turned * n);
  const auto rate = [&](Real stiffness, Real mobility) { return 2 * zeta * std::sqrt(std::max(Real(0), stiffness) / mobility); };
  DashpotRates c{rate(along, lightness), 0, 0, 0};
  if (looseness == 0) return c;
  c.across = rate(0.5 * (moved.trace() - along), lightness + 0.25 * d.squaredNorm() * looseness);  // slip moves and turns both ends
  c.bending = rate(0.5 * (turned.trace() - twist), looseness);
  c.twisting = rate(twist, looseness);
  return c;
}

/// The same as a matrix: loads = -C rates, rates (v1, w1, v2, w2).
inline Matrix12 dashpot_matrix(const DashpotRates& c, const Vec3& d) {
  const Vec3 n = d.normalized();
  Eigen::Matrix<Real, 3, 12> parting = Eigen::Matrix<Real, 3, 12>::Zero(), turning = parting;
  parting.block<3, 3>(0, 0) = -Mat3::Identity();
  parting.block<3, 3>(0, 6) = Mat3::Identity();
  parting.block<3, 3>(0, 3) = parting.block<3, 3>(0, 9) = 0.5 * stiffness::skew(d);  // -(w x d)/2 = (d x w)/2
  turning.block<3, 3>(0, 3) = -Mat3::Identity();
  turning.block<3, 3>(0, 9) = Mat3::Identity();
  const Mat3 weight = c.along * n * n.transpose() + c.across * stiffness::across(n);
  const Mat3 twist = c.twisting * n * n.transpose() + c.bending * stiffness::across(n);
  return parting.transpose() * weight * parting + turning.transpose() * twist * turning;
}

/// `turning`: elements have spins; otherwise only the central dashpot acts, which alone needs no torques.
template <bool turning>
struct DashpotLaw {
  View<const Real> along, across, bending, twisting;
  Real half_step;  ///< since the velocities [s]
  static constexpr bool turns = turning;
  static constexpr bool moves = true;

  template <Pass, class At, class T>
  [[gnu::always_inline]] Wrench<T> act(const At& at, const Ends<T>& ends) const {
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
      return {copy(force), half + couple, half - couple};
    } else {
      return {-central, zero<Vec<T>>(), zero<Vec<T>>()};
    }
  }
};

/// The dashpots of all families whose bonds either hold or are broken. Contacts that soften have none: they would make the
/// interface tougher than its law says.
class Dashpots {
 public:
  /// Finds the rates at the present state, or those that were kept where the run was resumed.
  void prepare(Workings& w, Real zeta, const View<const Real>& mass, const View<const Real>& inertia, bool resumed) {
    families_.clear();
    for (const auto& [law, table] : w.laws()) {
      if (law->acts_when_broken()) continue;
      for (const Field* field : {&along, &across, &bending, &twisting}) table->rows().add(*field).keep();
      table->rebind();
      const auto rate = [&, rows = &table->rows()](const Field& field) { return rows->column(field.name).view<Real>(); };
      families_.push_back({table, rate(along), rate(across), rate(bending), rate(twisting)});
      if (!resumed) fill(w.domain(), *law, families_.back(), zeta, mass, inertia);
    }
  }

  bool any() const { return !families_.empty(); }

  /// The bonds' part in what limits the step: K grows by 2/dt C.   docs/theory/verlet.md
  Matrix12 stiffening(const BondTable& table, Index row, const Vec3& d, Real dt) const {
    for (const Family& f : families_)
      if (f.table == &table) return (2 / dt) * dashpot_matrix({f.along[row], f.across[row], f.bending[row], f.twisting[row]}, d);
    return Matrix12::Zero();
  }

  /// Adds their forces to those that are there; what they added is remembered for `power`.
  void act(Domain& domain, const View<Vec3>& force, const View<Vec3>& torque, Real half_step) {
    pushed_.resize(static_cast<std::size_t>(domain.size()));
    turned_.resize(torque ? pushed_.size() : 0);
    each_shared(domain.size(), [&](Index i) {
      pushed_[static_cast<std::size_t>(i)] = force[i];
      if (torque) turned_[static_cast<std::size_t>(i)] = torque[i];
    }, few);
    domain.clear_halo();
    for (const Family& f : families_) {
      if (torque)
        bond_loop::run<Pass{}>(DashpotLaw<true>{f.along, f.across, f.bending, f.twisting, half_step}, *f.table, domain, false);
      else
        bond_loop::run<Pass{}>(DashpotLaw<false>{f.along, f.across, f.bending, f.twisting, half_step}, *f.table, domain, false);
    }
    domain.gather();
    each_shared(domain.size(), [&](Index i) {
      pushed_[static_cast<std::size_t>(i)] = force[i] - pushed_[static_cast<std::size_t>(i)];
      if (torque) turned_[static_cast<std::size_t>(i)] = torque[i] - turned_[static_cast<std::size_t>(i)];
    }, few);
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

  static void fill(const Domain& domain, const BondLaw& law, const Family& family, Real zeta, const View<const Real>& mass,
                   const View<const Real>& inertia) {
    const auto position = domain.elements().column("position").view<Vec3>();
    const BondTable& table = *family.table;
    for (const Chunk& chunk : table.chunks())
      for (Index b = chunk.begin; b < chunk.live_end; ++b) {
        const Index i = table.first()[b], j = table.second()[b];
        const DashpotRates c = dashpot_rates(law.tangent(domain, table, b), position[j] - position[i], zeta, 1 / mass[i] + 1 / mass[j],
                                             inertia ? 1 / inertia[i] + 1 / inertia[j] : 0);
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
