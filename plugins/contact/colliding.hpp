#pragma once
// What contacts share, whatever their normal force: damping by restitution, friction with history, and the time
// step by which a collision is resolved.   docs/theory/contact.md

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "core/base/failure.hpp"
#include "core/mechanics/collision.hpp"
#include "core/mechanics/restitution.hpp"
#include "core/plugin/bond_law_of.hpp"
#include "plugins/contact/meeting.hpp"

namespace beadwork {

/// Columns of the contacts, null where the deck has no need of them, and numbers that are the same for all.
struct CollidingColumns {
  MeetingColumns meeting;
  View<const Real> stiffness, viscosity;
  View<Vec3> tangential;
  View<Real> damping_force, tangential_stiffness, dissipated;
  View<Real> overlap, normal_force;  // null where nobody reads them
  Real friction, tangential_ratio, expected_overlap, time_step;
};

template <class Normal, class Meeting, bool frictional>
struct CollidingLaw {
  CollidingColumns c;

  static constexpr bool turns = frictional || Meeting::turns;
  static constexpr bool travels = true;

  template <Pass pass, class At, class Ends>
  [[gnu::always_inline]] auto act(const At& at, const Ends& ends) const {
    using T = typename At::Number;
    const auto touch = Meeting::find(c.meeting, at, ends);
    const Vec<T> n = touch.n;
    const T delta = touch.delta, k = at(c.stiffness);
    const Vec<T> rate = touch.rate(ends, 0.5 * c.time_step);
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
    Vec<T> force = push * n, drag = zero<Vec<T>>();
    if constexpr (frictional) {
      const Drag<T> dragging = dragged<pass>(at, ends, n, touch.slide(ends, rate, v_n), delta, push);
      lost = lost + dragging.lost;
      drag = dragging.force;
      force = force + drag;
    }
    if constexpr (pass.settle)
      if (c.dissipated) at.store(c.dissipated, at(View<const Real>(c.dissipated)) + lost);
    if constexpr (pass.sections) {
      if (c.overlap) at.store(c.overlap, delta);
      if (c.normal_force) at.store(c.normal_force, push);
    }
    if constexpr (frictional)
      return touch.wrench(force, drag);
    else
      return touch.wrench(force);
  }

  template <class At, class Ends>
  auto stored(const At& at, const Ends& ends) const {
    using T = typename At::Number;
    const T delta = Meeting::overlap(c.meeting, at, ends), k = at(c.stiffness);
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
    const auto touch = Meeting::find(c.meeting, at, ends);
    Real delta = touch.delta;
    if (slope == Slope::stiffest) delta = max(delta, c.expected_overlap * Meeting::shortest(c.meeting, at));
    if (delta <= 0) return Matrix12::Zero();
    const Real along = Normal::slope(at(c.stiffness), delta);
    const Mat3 normal = along * (touch.n * touch.n.transpose());
    if constexpr (!turns) return stiffness::between_centres(normal);
    const Mat3 all = frictional ? Mat3(normal + c.tangential_ratio * along * stiffness::across(touch.n)) : normal;
    const auto [arm1, arm2] = touch.arms();
    stiffness::Matrix3x12 way;  // of the second past the first, at the contact
    way << -Mat3::Identity(), stiffness::skew(arm1), Mat3::Identity(), -stiffness::skew(arm2);
    return way.transpose() * all * way;
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
  template <Pass pass, class At, class Ends, class T>
  [[gnu::always_inline]] Drag<T> dragged(const At& at, const Ends& ends, const Vec<T>& n, const Vec<T>& slide,
                                         const T& delta, const T& push) const {
    const auto touches = delta > T(0);
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

/// Contacts with one normal law.
template <class Normal>
class Colliding
    : public ContactLawOf<CollidingLaw<Normal, OfSpheres, false>, CollidingLaw<Normal, OfSpheres, true>,
                          CollidingLaw<Normal, WithWall<false>, false>, CollidingLaw<Normal, WithWall<true>, false>,
                          CollidingLaw<Normal, WithWall<true>, true>> {
  using Base = ContactLawOf<CollidingLaw<Normal, OfSpheres, false>, CollidingLaw<Normal, OfSpheres, true>,
                            CollidingLaw<Normal, WithWall<false>, false>, CollidingLaw<Normal, WithWall<true>, false>,
                            CollidingLaw<Normal, WithWall<true>, true>>;

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
    share.want(!this->faces_walls());
    tangential.want(slides());
    tangential_stiffness.want(slides() && !Normal::even);
    dissipated.want(damps() || slides());
    lost.want(damps() || slides());
    zeta_ = damps() ? damping_for(Normal::exponent, *restitution) : 0;
  }

  void meet(const Domain& domain, const BondTable& table, Index row) override {
    const Index i = table.first()[row], j = table.second()[row];
    const bool with_wall = this->faces_walls();
    stiffness[row] =
        with_wall ? stiffness_at(domain, table.near(row)) : stiffness_between(this->radius[i], this->radius[j]);
    if (share) share[row] = this->radius[i] / (this->radius[i] + this->radius[j]);
    const bool alone =
        with_wall && !domain.walls().moved_by_forces(j);  // a wall that only loads move does not give way
    const Real reduced = alone ? mass[i] : mass[i] * mass[j] / (mass[i] + mass[j]);
    if (viscosity) viscosity[row] = 2 * zeta_ * std::sqrt(reduced * (Normal::even ? stiffness[row] : 1));
  }
  void part(const BondTable&, Index row) override {
    if (dissipated) lost[0] += dissipated[row];
  }
  void energy(EnergySink& sink) const override {
    if (lost) sink.dissipated(this->family(), lost[0]);
  }

  Real longest_step(const Domain& domain) const override { return shortest_collision(domain) / *steps; }

  // The error of a collision falls with the square of the step; with 20 a restitution of 0.5 is met within 0.02.
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
  virtual Real stiffness_between(Real r1, Real r2) const = 0;
  /// The same for one radius at a rigid plane.
  virtual Real stiffness_at_plane(Real r) const = 0;
  /// Tangential over normal stiffness.
  virtual Real tangential_ratio() const = 0;
  /// Overlap over the distance of the centres that the time step is made for.
  virtual Real expected_overlap() const { return 1e-3; }

  typename Base::AnyLaw law() const override {
    const CollidingColumns c{{this->length.view(), share.view(), this->facet.view(), this->facets()},
                             stiffness.view(),
                             viscosity.view(),
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
    if (!this->faces_walls()) {
      if (slides()) return CollidingLaw<Normal, OfSpheres, true>{c};
      return CollidingLaw<Normal, OfSpheres, false>{c};
    }
    if (slides()) return CollidingLaw<Normal, WithWall<true>, true>{c};
    if (this->faces_walls_that_turn()) return CollidingLaw<Normal, WithWall<true>, false>{c};
    return CollidingLaw<Normal, WithWall<false>, false>{c};
  }

 private:
  // Half a period, as if the stiffness were even, of the elements that are the quickest: of two alike, or of one at a wall.
  Real shortest_collision(const Domain& domain) const {
    const Real wall = this->faces_walls() ? lightest_wall(domain) : 0;
    Real shortest = std::numeric_limits<Real>::infinity();
    for (const std::string& set : *this->between)
      for (const Index i : domain.set(set)) {
        const Real r = this->radius[i], m = mass[i];
        if (!(r > 0)) continue;
        const Real k = this->faces_walls() ? Normal::slope(stiffness_at_plane(r), expected_overlap() * r)
                                           : Normal::slope(stiffness_between(r, r), expected_overlap() * 2 * r);
        const Real reduced = this->faces_walls() ? m / (1 + m / wall) : 0.5 * m;
        shortest = std::min(shortest, std::numbers::pi * std::sqrt(reduced / k));
      }
    return shortest;
  }
  // What one contact has of the walls that forces move: of all that touch it now, each has its share; where it may turn it is
  // the lighter the farther out it is struck.
  Real lightest_wall(const Domain& domain) const {
    const Walls& walls = domain.walls();
    const BondTable& table = *domain.find_family(this->family());
    const Column* turning = domain.elements().find("inertia");
    Real lightest = std::numeric_limits<Real>::infinity();
    for (Index k = 0; k < walls.size(); ++k) {
      const Index row = walls.element(k);
      if (!walls.moved_by_forces(row)) continue;
      Real contacts = 1;
      for (Index pair = 0; pair < table.size(); ++pair) contacts += table.second()[pair] == row;
      const Real lever = walls.lever(k, 0), inertia = turning ? turning->view<Real>()[row] : 0;
      const Real inverse = 1 / mass[row] + (inertia > no_mass ? lever * lever / inertia : 0);
      lightest = std::min(lightest, 1 / (inverse * contacts));
    }
    return lightest;
  }
  bool damps() const { return *restitution < 1; }
  bool slides() const { return *friction > 0; }
  Real stiffness_at(const Domain& domain, const Near& pair) const {
    const Real r = this->radius[pair.first];
    const Pose wall = domain.pose(pair.second);
    const Vec3 place = rotate_back(wall.orientation, Vec3(domain.pose(pair.first).position - wall.position));
    const Real blunt = effective_radius(this->facets(), pair.facet, r, place);
    if (!(blunt > 0))
      refuse(this->between.at(),
             fmt::format("element {} of radius {:.6g} m does not fit into the hollow wall: make that wider, or leave the "
                         "element out of the set",
                         domain.elements().column("id").view<Index>()[pair.first], r));
    return stiffness_at_plane(blunt);
  }
  Real zeta_ = 0;
};

}  // namespace beadwork
