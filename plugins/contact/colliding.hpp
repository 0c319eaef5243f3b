#pragma once
// What contacts of spheres share, whatever their normal force: damping by restitution, friction with history, and the time
// step by which a collision is resolved.   docs/theory/contact.md

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "core/mechanics/collision.hpp"
#include "core/mechanics/restitution.hpp"
#include "core/plugin/bond_law_of.hpp"

namespace beadwork {

/// Columns of the contacts, null where the deck has no need of them, and numbers that are the same for all.
struct CollidingColumns {
  View<const Real> length, stiffness, viscosity, share;
  View<Vec3> tangential;
  View<Real> damping_force, tangential_stiffness, dissipated;
  View<Real> overlap, normal_force;  // null where nobody reads them
  Real friction, tangential_ratio, expected_overlap, time_step;
};

template <class Normal, bool frictional>
struct CollidingLaw {
  CollidingColumns c;

  static constexpr bool turns = frictional;
  static constexpr bool travels = true;

  template <Pass pass, class At, class Ends>
  [[gnu::always_inline]] auto act(const At& at, const Ends& ends) const {
    using T = typename At::Number;
    const T l = sqrt(dot(ends.apart, ends.apart));
    const Vec<T> n = (T(1) / l) * ends.apart;
    const T delta = max(T(0), at(c.length) - l), k = at(c.stiffness);
    const Vec<T> rate = ends.v2 - ends.v1;
    const T v_n = dot(rate, n), elastic = Normal::force(k, delta);
    T push = elastic, lost(0);
    if (c.viscosity) {
      const T damping = at(c.viscosity) * Normal::damping(k, delta);
      push = select(delta > T(0), max(T(0), elastic - damping * v_n), T(0));
      const T damped = push - elastic;
      // the trapezoid over the way of this step, which is what the scheme gives to the motion
      lost = T(-0.5 * c.time_step) * (at(View<const Real>(c.damping_force)) + damped) * v_n;
      if constexpr (pass.settle) at.store(c.damping_force, damped);
    }
    Vec<T> force = push * n, moment = zero<Vec<T>>();
    const T arm1 = arm(at, l), arm2 = l - arm1;
    if constexpr (frictional) {
      const Drag<T> drag = dragged<pass>(at, ends, n, rate - v_n * n, arm1, arm2, delta, push);
      lost = lost + drag.lost;
      force = force + drag.force;
      moment = cross(drag.force, n);
    }
    if constexpr (pass.settle)
      if (c.dissipated) at.store(c.dissipated, at(View<const Real>(c.dissipated)) + lost);
    if constexpr (pass.sections) {
      if (c.overlap) at.store(c.overlap, delta);
      if (c.normal_force) at.store(c.normal_force, push);
    }
    return Wrench<T>{copy(force), arm1 * moment, arm2 * moment};
  }

  template <class At, class Ends>
  auto stored(const At& at, const Ends& ends) const {
    using T = typename At::Number;
    const T delta = max(T(0), at(c.length) - sqrt(dot(ends.apart, ends.apart))), k = at(c.stiffness);
    T energy = Normal::energy(k, delta);
    if constexpr (frictional) {
      const Vec<T> held = at(View<const Vec3>(c.tangential));
      energy = energy + T(0.5) * dot(held, held) / across(k, delta);
    }
    return energy;
  }

  template <class At>
  auto dissipated(const At& at) const {
    return c.dissipated ? at(View<const Real>(c.dissipated)) : typename At::Number(0);
  }

  /// Stiffest: as if it touched, and held by friction.
  template <class Ends>
  Matrix12 stiffness(const One& at, const Ends& ends, Slope slope) const {
    const Real l = ends.apart.norm();
    const Vec3 n = ends.apart / l;
    Real delta = max(0.0, at(c.length) - l);
    if (slope == Slope::stiffest) {
      const Real smaller = at(c.length) * min(at(c.share), 1 - at(c.share));  // radius
      delta = max(delta, c.expected_overlap * 2 * smaller);
    }
    if (delta <= 0) return Matrix12::Zero();
    const Real along = Normal::slope(at(c.stiffness), delta);
    Matrix12 k = stiffness::between_centres(along * (n * n.transpose()));
    if constexpr (frictional) {
      const Mat3 plane = stiffness::across(n), lever = stiffness::skew(n);
      stiffness::Matrix3x12 slide;
      slide << -plane, arm(at, l) * lever, plane, (l - arm(at, l)) * lever;
      k += c.tangential_ratio * along * stiffness::square(slide);
    }
    return k;
  }

 private:
  template <class T>
  struct Drag {
    Vec<T> force;  ///< of friction, on end 2 [N]
    T lost;        ///< by it in this step [J]
  };

  /// Tangential stiffness; never quite nothing, by which something is divided.
  template <class T>
  [[gnu::always_inline]] T across(const T& k, const T& delta) const {
    return T(c.tangential_ratio) * max(Normal::slope(k, delta), T(1e-12) * k);
  }
  /// From the first centre to the contact: the distance is divided as the radii do.
  template <class At, class T>
  [[gnu::always_inline]] T arm(const At& at, const T& l) const {
    return l * at(c.share);
  }

  template <Pass pass, class At, class Ends, class T>
  [[gnu::always_inline]] Drag<T> dragged(const At& at, const Ends& ends, const Vec<T>& n, const Vec<T>& rate,
                                         const T& arm1, const T& arm2, const T& delta, const T& push) const {
    const auto touches = delta > T(0);
    const Vec<T> slide = rate - cross(arm1 * ends.w1 + arm2 * ends.w2, n);
    const T k = across(at(c.stiffness), delta);
    T before = k;
    if constexpr (!Normal::even) {
      const T kept = at(View<const Real>(c.tangential_stiffness));
      before = select(kept > T(0), kept, k);
    }
    const Vec<T> old = at(View<const Vec3>(c.tangential));
    const T turn = T(0.5 * c.time_step) * dot(ends.w1 + ends.w2, n);
    const Vec<T> carried = carried_across<T>(n, old, turn), way = T(c.time_step) * slide;
    const Vec<T> held = select(touches, T(1), T(0)) * friction<T>(carried, before, k, way, T(c.friction) * push);
    const Drag<T> drag{copy(held), lost_by_friction<T>(carried, before, held, k, way)};
    if constexpr (pass.settle) {
      at.store(c.tangential, drag.force);
      if constexpr (!Normal::even) at.store(c.tangential_stiffness, select(touches, k, T(0)));
    }
    return drag;
  }
};

/// Contacts of spheres with one normal law.
template <class Normal>
class Colliding : public ContactLawOf<CollidingLaw<Normal, false>, CollidingLaw<Normal, true>> {
  using Base = ContactLawOf<CollidingLaw<Normal, false>, CollidingLaw<Normal, true>>;

 public:
  Param<Real> friction{this,
                       {.name = "friction",
                        .range = not_negative,
                        .doc = "Coulomb's coefficient mu; 0: no friction, and nothing of it is kept or found",
                        .fallback = "0"}};
  Param<Real> restitution{this,
                          {.name = "restitution",
                           .range = {0.01, 1},
                           .doc = "Speed after over speed before a head-on collision of two; 1: nothing is damped",
                           .fallback = "1"}};
  Param<Real> steps{this,
                    {.name = "steps",
                     .range = {3, 1000},
                     .doc = "Time steps in the shortest collision of two: the more, the nearer to what the law says",
                     .fallback = "20"}};
  Reads<Real> mass{this, field::mass};
  Keeps<Real> stiffness{this, {"contact-stiffness", On::bonds, Normal::unit, "Of the normal force, by its law"}};
  Keeps<Real> viscosity{
      this, {"contact-viscosity", On::bonds, Normal::damping_unit, "Of the damping of the normal force, by its law"}};
  Keeps<Real> share{this, {"contact-share", On::bonds, "1", "Radius of the first over the sum of both"}};
  Keeps<Vec3> tangential{this, {"tangential-force", On::bonds, "N", "Friction on the second element"}};
  Keeps<Real> tangential_stiffness{this, {"tangential-stiffness", On::bonds, "N/m", "At the last step"}};
  Keeps<Real> damping_force{this,
                            {"damping-force", On::bonds, "N", "Of the normal force, what damps, at the last step"}};
  Keeps<Real> dissipated{
      this, {"contact-dissipation", On::bonds, "J", "By friction and damping, while the pair is followed"}};
  Keeps<Real> lost{this, {"lost", On::scene, "J", "By friction and damping, of pairs that are followed no longer"}};
  Writes<Real> overlap{this, {"overlap", On::bonds, "m", "By how much two elements overlap"}};
  Writes<Real> normal_force{this, {"normal-force", On::bonds, "N", "By which two elements push one another apart"}};

  void choose() override {
    Base::choose();
    viscosity.want(damps());
    damping_force.want(damps());
    share.want(true);
    tangential.want(slides());
    tangential_stiffness.want(slides() && !Normal::even);
    dissipated.want(damps() || slides());
    lost.want(damps() || slides());
    zeta_ = damps() ? damping_for(Normal::exponent, *restitution) : 0;
  }

  void meet(const Domain&, const BondTable& table, Index row) override {
    const Index i = table.first()[row], j = table.second()[row];
    const Real r1 = this->radius[i], r2 = this->radius[j], reduced = mass[i] * mass[j] / (mass[i] + mass[j]);
    stiffness[row] = hardness(r1, r2);
    share[row] = r1 / (r1 + r2);
    if (viscosity) viscosity[row] = 2 * zeta_ * std::sqrt(reduced * (Normal::even ? stiffness[row] : 1));
  }
  void part(const BondTable&, Index row) override {
    if (dissipated) lost[0] += dissipated[row];
  }
  void energy(EnergySink& sink) const override {
    if (lost) sink.dissipated(this->family(), lost[0]);
  }

  Real longest_step(const Domain& domain) const override { return shortest_collision(domain) / *steps; }

  // The error of a collision falls with the square of the step: with 20 it is some thousandths.
  std::string suspect(const Domain& domain, Real time_step) const override {
    const Real made = shortest_collision(domain) / time_step;
    return made > 15 ? ""
                     : fmt::format(
                           "contacts '{}' have {:.2g} time steps in their shortest collision, which is few: "
                           "raise their 'steps', or leave 'time-step' out",
                           this->family(), made);
  }

 protected:
  /// k of the law for two radii.
  virtual Real hardness(Real r1, Real r2) const = 0;
  /// Tangential over normal stiffness.
  virtual Real tangential_ratio() const = 0;
  /// Overlap over the distance of the centres that the time step is made for.
  virtual Real expected_overlap() const { return 1e-3; }

  typename Base::AnyLaw law() const override {
    const CollidingColumns c{this->length.view(),
                             stiffness.view(),
                             viscosity.view(),
                             share.view(),
                             tangential.view(),
                             damping_force.view(),
                             tangential_stiffness.view(),
                             dissipated.view(),
                             overlap.view(),
                             normal_force.view(),
                             *friction,
                             tangential_ratio(),
                             expected_overlap(),
                             this->time_step()};
    if (slides()) return CollidingLaw<Normal, true>{c};
    return CollidingLaw<Normal, false>{c};
  }

 private:
  // Half a period of two alike, as if their stiffness were even, of the elements that are the quickest.
  Real shortest_collision(const Domain& domain) const {
    Real shortest = std::numeric_limits<Real>::infinity();
    for (const std::string& set : *this->between)
      for (const Index i : domain.set(set)) {
        const Real r = this->radius[i], k = Normal::slope(hardness(r, r), expected_overlap() * 2 * r);
        shortest = std::min(shortest, std::numbers::pi * std::sqrt(0.5 * mass[i] / k));
      }
    return shortest;
  }
  bool damps() const { return *restitution < 1; }
  bool slides() const { return *friction > 0; }
  Real zeta_ = 0;
};

}  // namespace beadwork
