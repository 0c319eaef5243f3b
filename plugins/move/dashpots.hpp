#pragma once
// Bond damping: dashpots beside the springs of each bond. They oppose what parts the two ends, and nothing else: a body that
// moves and turns as one is not braked, and both momenta are kept.   docs/theory/verlet.md
//
//   F  = -c_n (v.n) n - c_t s       v = v2 - v1,  s = v - (v.n) n - (w1 + w2)/2 x d     on end 2, the opposite on end 1
//   T1 = -d x F/2 + c_r (w2 - w1)   T2 = -d x F/2 - c_r (w2 - w1)
//   c = 2 zeta sqrt(k m_eff)        with the stiffness k of each mode and the reduced mass or inertia of the two ends
//
// A pair of elements then swings with the damping ratio zeta.

#include <algorithm>

#include "core/base/sums.hpp"
#include "core/mechanics/stiffness.hpp"
#include "core/plugin/bond_loop.hpp"

namespace beadwork {

/// What a bond's dashpots are worth.
struct DashpotRates {
  Real along = 0, across = 0;  ///< c_n, c_t [N s/m]
  Real turning = 0;            ///< c_r [N m s]
};

/// From the stiffness of a bond (x1, theta1, x2, theta2) that points along n, and the reduced mass [kg] and inertia [kg m^2].
inline DashpotRates dashpot_rates(const Matrix12& k, const Vec3& n, Real zeta, Real mass, Real inertia) {
  const Mat3 moved = k.block<3, 3>(6, 6);
  const Mat3 turned = 0.25 * (k.block<3, 3>(3, 3) - k.block<3, 3>(3, 9) - k.block<3, 3>(9, 3) + k.block<3, 3>(9, 9));
  const Real along = n.dot(moved * n);
  const auto rate = [&](Real stiffness, Real of) { return 2 * zeta * std::sqrt(std::max(Real(0), stiffness) * of); };
  return {rate(along, mass), rate(0.5 * (moved.trace() - along), mass), rate(turned.trace() / 3, inertia)};
}

/// The same as a matrix: loads = -C rates, rates (v1, w1, v2, w2). `d` = x2 - x1.
inline Matrix12 dashpot_matrix(const DashpotRates& c, const Vec3& d) {
  const Vec3 n = d.normalized();
  Eigen::Matrix<Real, 3, 12> parting = Eigen::Matrix<Real, 3, 12>::Zero(), turning = parting;
  parting.block<3, 3>(0, 0) = -Mat3::Identity();
  parting.block<3, 3>(0, 6) = Mat3::Identity();
  parting.block<3, 3>(0, 3) = parting.block<3, 3>(0, 9) = 0.5 * stiffness::skew(d);  // -(w x d)/2 = (d x w)/2
  turning.block<3, 3>(0, 3) = -Mat3::Identity();
  turning.block<3, 3>(0, 9) = Mat3::Identity();
  const Mat3 weight = c.along * n * n.transpose() + c.across * stiffness::across(n);
  return parting.transpose() * weight * parting + c.turning * turning.transpose() * turning;
}

/// `turning`: elements have spins; otherwise only the central dashpot acts, which alone needs no torques.
template <bool turning>
struct DashpotLaw {
  View<const Real> along, across, turn;
  static constexpr bool turns = turning;
  static constexpr bool moves = true;

  template <Pass, class At, class T>
  [[gnu::always_inline]] Wrench<T> act(const At& at, const Ends<T>& ends) const {
    const Vec<T>& d = ends.apart;
    const Vec<T> v = ends.v2 - ends.v1;
    const Vec<T> central = (dot(v, d) / dot(d, d)) * d;
    if constexpr (turning) {
      const Vec<T> slip = v - central - T(0.5) * cross(ends.w1 + ends.w2, d);
      const Vec<T> force = -(at(along) * central) - at(across) * slip;
      const Vec<T> half = T(0.5) * cross(force, d);
      const Vec<T> twist = at(turn) * (ends.w2 - ends.w1);
      return {copy(force), half + twist, half - twist};
    } else {
      return {-(at(along) * central), zero<Vec<T>>(), zero<Vec<T>>()};
    }
  }
};

/// The dashpots of all families whose bonds either hold or are broken. Contacts that soften have none: they would make the
/// interface tougher than its law says.
class Dashpots {
 public:
  /// Finds the rates at the present state, or those that were kept where the run was resumed.
  void prepare(Workings& w, Real zeta, const View<const Real>& mass, const View<const Real>& inertia, bool resumed) {
    tables_.clear();
    for (const auto& [law, table] : w.laws()) {
      if (law->acts_when_broken()) continue;
      for (const Field& field : {along, across, turning}) table->rows().add(field).keep();
      table->rebind();
      tables_.push_back(table);
      if (!resumed) fill(w.domain(), *law, *table, zeta, mass, inertia);
    }
  }

  bool any() const { return !tables_.empty(); }

  /// The bonds' part in what limits the step: K grows by 2/dt C.   docs/theory/verlet.md
  Matrix12 stiffening(const BondTable& table, Index row, const Vec3& d, Real dt) const {
    if (std::find(tables_.begin(), tables_.end(), &table) == tables_.end()) return Matrix12::Zero();
    const auto value = [&](const Field& field) { return table.rows().column(field.name).view<Real>()[row]; };
    return (2 / dt) * dashpot_matrix({value(along), value(across), value(turning)}, d);
  }

  /// Adds their forces to those that are there; what they added is remembered for `power`.
  void act(Domain& domain, const View<Vec3>& force, const View<Vec3>& torque) {
    const auto count = static_cast<std::size_t>(domain.size());
    pushed_.resize(count);
    turned_.resize(torque ? count : 0);
    for (std::size_t i = 0; i < count; ++i) {
      pushed_[i] = force[static_cast<Index>(i)];
      if (torque) turned_[i] = torque[static_cast<Index>(i)];
    }
    domain.clear_halo();
    for (BondTable* table : tables_) {
      const auto rate = [&](const Field& field) { return table->rows().column(field.name).view<Real>(); };
      if (torque)
        bond_loop::run<Pass{}>(DashpotLaw<true>{rate(along), rate(across), rate(turning)}, *table, domain, false);
      else
        bond_loop::run<Pass{}>(DashpotLaw<false>{rate(along), rate(across), rate(turning)}, *table, domain, false);
    }
    domain.gather();
    for (std::size_t i = 0; i < count; ++i) {
      pushed_[i] = force[static_cast<Index>(i)] - pushed_[i];
      if (torque) turned_[i] = torque[static_cast<Index>(i)] - turned_[i];
    }
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
  static inline const Field along{"damping-along", On::bonds, Type::real, "N.s/m", "Dashpot along the bond", ""};
  static inline const Field across{"damping-across", On::bonds, Type::real, "N.s/m", "Dashpot across the bond", ""};
  static inline const Field turning{"damping-turning", On::bonds, Type::real, "N.m.s", "Dashpot between the turns of the two ends", ""};

  static void fill(const Domain& domain, const BondLaw& law, const BondTable& table, Real zeta, const View<const Real>& mass,
                   const View<const Real>& inertia) {
    const auto position = domain.elements().column("position").view<Vec3>();
    const auto column = [&](const Field& field) { return table.rows().column(field.name).view<Real>(); };
    for (const Chunk& chunk : table.chunks())
      for (Index b = chunk.begin; b < chunk.live_end; ++b) {
        const Index i = table.first()[b], j = table.second()[b];
        const auto reduced = [&](const View<const Real>& of) { return of ? of[i] * of[j] / (of[i] + of[j]) : 0; };
        const DashpotRates c = dashpot_rates(law.tangent(domain, table, b), (position[j] - position[i]).normalized(), zeta,
                                             reduced(mass), reduced(inertia));
        column(along)[b] = c.along;
        column(across)[b] = c.across;
        column(turning)[b] = c.turning;
      }
  }

  std::vector<BondTable*> tables_;
  std::vector<Vec3> pushed_, turned_;  // what the dashpots added to each element's load
};

}  // namespace beadwork
