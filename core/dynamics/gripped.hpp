#pragma once
// What a grip takes hold of, and how it moves it in an explicit scheme: each element of a set along an axis, their
// mean, or the set as a body that turns. Of work and of breaks grips know (grips.hpp); here are places, rates and loads.

#include <vector>

#include "core/domain/constraint.hpp"
#include "core/dynamics/motion.hpp"
#include "core/mechanics/rigid_turn.hpp"

namespace beadwork {

/// What a motion lacks to be as it is prescribed: the force along its axis, or the torque about it; and of a body that
/// turns the sum of forces.
struct Lack {
  Real along = 0;
  Vec3 force = Vec3::Zero();
};

/// From where to where the prescribed motion goes in a step.
struct Way {
  PrescribedMotion from, to;
  Real dt;  ///< [s]
  Real moved() const { return to.displacement - from.displacement; }
};

class Gripped {
 public:
  Gripped(Set set, int axis) : set_(std::move(set)), axis_(axis) {}
  virtual ~Gripped() = default;

  const Set& set() const { return set_; }
  int axis() const { return axis_; }
  /// Whether there is anything to be prescribed: turns only where elements turn.
  virtual bool moves(const Motion& all) const { return axis_ < 3 || all.spin; }
  /// Half of it times the square of the prescribed velocity is the kinetic energy of the prescribed motion.
  virtual Real weight(const Motion& all) const = 0;
  /// What stands in that motion now [J].
  virtual Real kinetic(const Motion& all) const = 0;
  virtual void set_rates(const Motion& all, const PrescribedMotion& now) const = 0;
  /// With the present loads; inertia is larger by 1/beta.
  virtual Lack lacking(const Motion& all, const PrescribedMotion& now, Real beta) const = 0;
  /// Gives the loads what they lack, and tells it.
  virtual Lack impose(const Motion& all, const PrescribedMotion& now, Real beta) const = 0;
  virtual void before_advance(const Motion& all, const Way& way) = 0;
  virtual void after_advance(const Motion& all, const Way& way) const = 0;
  /// What it keeps of sum |F|^2/m from moving a set whose elements are free otherwise [N^2/kg].
  virtual Real held_as_mean(const Motion&) const { return 0; }

 protected:
  // The rates, loads and inertias that its axis is one of.
  View<Vec3> rate(const Motion& all) const { return axis_ < 3 ? all.velocity : all.spin; }
  View<Vec3> load(const Motion& all) const { return axis_ < 3 ? all.force : all.torque; }
  View<const Real> inertia(const Motion& all) const { return axis_ < 3 ? all.mass : all.inertia; }

  template <class F>
  Real sum(const F& f) const {
    Real sum = 0;
    for (const Index row : set_) sum += f(row);
    return sum;
  }
  template <class F>
  Real mean(const F& f) const {
    return sum(f) / static_cast<Real>(set_.size());
  }
  Real kinetic_along_axis(const Motion& all) const {
    const auto v = rate(all);
    const auto m = inertia(all);
    const int axis = axis_ % 3;
    return 0.5 * sum([&](Index row) { return m[row] * v.at(row, axis) * v.at(row, axis); });
  }

  Set set_;
  int axis_;
};

/// Lets the step that comes turn elements about an axis by just the prescribed angle: the constant acceleration that
/// does it is put in the place of the one at its start.
inline void aim_turns(const Motion& all, const Set& set, int axis, const Way& way) {
  const Real alpha = 2 * (way.moved() - way.dt * way.from.velocity) / (way.dt * way.dt);
  for (const Index row : set) all.torque.at(row, axis) = all.inertia[row] * alpha;
}

/// Each element moves alike.
class GrippedEach final : public Gripped {
 public:
  using Gripped::Gripped;

  Real weight(const Motion& all) const override {
    const auto m = inertia(all);
    return static_cast<Real>(set_.size()) * mean([&](Index row) { return m[row]; });
  }
  Real kinetic(const Motion& all) const override { return kinetic_along_axis(all); }
  void set_rates(const Motion& all, const PrescribedMotion& now) const override {
    const auto v = rate(all);
    for (const Index row : set_) v.at(row, axis_ % 3) = now.velocity;
  }
  Lack lacking(const Motion& all, const PrescribedMotion& now, Real beta) const override {
    const Real a = now.acceleration / beta;
    const auto f = load(all);
    const auto m = inertia(all);
    return {sum([&](Index row) { return m[row] * a - f.at(row, axis_ % 3); })};
  }
  Lack impose(const Motion& all, const PrescribedMotion& now, Real beta) const override {
    const Lack lack = lacking(all, now, beta);
    const Real a = now.acceleration / beta;
    const auto f = load(all);
    const auto m = inertia(all);
    for (const Index row : set_) f.at(row, axis_ % 3) = m[row] * a;
    return lack;
  }
  void before_advance(const Motion& all, const Way& way) override {
    if (axis_ >= 3) return aim_turns(all, set_, axis_ - 3, way);
    places_.resize(set_.size());
    for (std::size_t n = 0; n < set_.size(); ++n) places_[n] = all.place.at(set_[n], axis_);
  }
  void after_advance(const Motion& all, const Way& way) const override {
    if (axis_ >= 3) return;
    const Real moved = way.moved();
    for (std::size_t n = 0; n < set_.size(); ++n) all.place.at(set_[n], axis_) = places_[n] + moved;
  }

 private:
  std::vector<Real> places_;  // when the step began
};

/// Only the mean is prescribed. It is changed as by a force shared equally: light elements give way more.
class GrippedMean final : public Gripped {
 public:
  using Gripped::Gripped;

  Real weight(const Motion& all) const override { return static_cast<Real>(set_.size()) / mean_mobility(all); }
  Real kinetic(const Motion& all) const override { return kinetic_along_axis(all); }
  void set_rates(const Motion& all, const PrescribedMotion& now) const override {
    const auto v = rate(all);
    shift(all, now.velocity - mean([&](Index row) { return v.at(row, axis_ % 3); }), v);
  }
  Lack lacking(const Motion& all, const PrescribedMotion& now, Real beta) const override {
    return {missing(all, now.acceleration / beta) * static_cast<Real>(set_.size())};
  }
  Lack impose(const Motion& all, const PrescribedMotion& now, Real beta) const override {
    const Real missing = this->missing(all, now.acceleration / beta);
    const auto f = load(all);
    for (const Index row : set_) f.at(row, axis_ % 3) += missing;
    return {missing * static_cast<Real>(set_.size())};
  }
  void before_advance(const Motion& all, const Way&) override {
    if (axis_ < 3) place_ = mean([&](Index row) { return all.place.at(row, axis_); });
  }
  void after_advance(const Motion& all, const Way& way) const override {
    if (axis_ >= 3) return;
    const Real reached = mean([&](Index row) { return all.place.at(row, axis_); });
    shift(all, place_ + way.moved() - reached, all.place);
  }
  Real held_as_mean(const Motion& all) const override {
    if (set_.empty()) return 0;
    const auto f = load(all);
    const auto m = inertia(all);
    Real pull = 0, weight = 0;
    for (const Index row : set_) {
      pull += f.at(row, axis_ % 3) / m[row];
      weight += 1 / m[row];
    }
    return pull * pull / weight;
  }

 private:
  Real mean_mobility(const Motion& all) const {
    const auto m = inertia(all);
    return mean([&](Index row) { return 1 / m[row]; });
  }
  // What each load lacks for the mean to have the acceleration `a`.
  Real missing(const Motion& all, Real a) const {
    const auto f = load(all);
    const auto m = inertia(all);
    const Real free = mean([&](Index row) { return f.at(row, axis_ % 3) / m[row]; });
    return (a - free) / mean_mobility(all);
  }
  void shift(const Motion& all, Real by, const View<Vec3>& of) const {
    const auto m = inertia(all);
    const Real scale = by / mean_mobility(all);
    for (const Index row : set_) of.at(row, axis_ % 3) += scale / m[row];
  }

  Real place_ = 0;  // mean when the step began
};

/// The set turns about an axis as one body.
class GrippedBody final : public Gripped {
 public:
  /// `from`: places when the turn began.
  GrippedBody(Set set, const Constraint& c, View<const Vec3> from)
      : Gripped(std::move(set), c.axis), circles_(c.axis - 3, c.body->about), places_(c.prescribes()), from_(from) {}

  bool moves(const Motion&) const override { return true; }
  Real weight(const Motion& all) const override {
    return sum([&](Index row) {
      return all.mass[row] * circles_.arm(from_[row]).squaredNorm() + (all.spin ? all.inertia[row] : 0);
    });
  }
  Real kinetic(const Motion& all) const override {
    return 0.5 * sum([&](Index row) {
             return all.mass[row] * prescribed(all.velocity[row]).squaredNorm() +
                    (all.spin ? all.inertia[row] * all.spin[row].squaredNorm() : 0);
           });
  }
  void set_rates(const Motion& all, const PrescribedMotion& now) const override {
    for (const Index row : set_) {
      set(all.velocity, row, circles_.velocity(circles_.arm(all.place[row]), now.velocity));
      if (all.spin) all.spin.set(row, now.velocity * Vec3::Unit(circles_.axis()));
    }
  }
  Lack lacking(const Motion& all, const PrescribedMotion& now, Real beta) const override {
    Lack lack;
    for (const Index row : set_) {
      const Vec3 arm = circles_.arm(all.place[row]);
      const Vec3 force = prescribed(wanted(all, row, arm, now, beta) - all.force[row]);
      lack.force += force;
      lack.along += circles_.torque(arm, force);
      if (all.spin) lack.along += couple(all, row, now, beta) - all.torque.at(row, circles_.axis());
    }
    return lack;
  }
  Lack impose(const Motion& all, const PrescribedMotion& now, Real beta) const override {
    const Lack lack = lacking(all, now, beta);
    for (const Index row : set_) {
      set(all.force, row, wanted(all, row, circles_.arm(all.place[row]), now, beta));
      if (all.spin) all.torque.set(row, couple(all, row, now, beta) * Vec3::Unit(circles_.axis()));
    }
    return lack;
  }
  void before_advance(const Motion& all, const Way& way) override {
    if (!all.spin) return;
    for (const Index row : set_) all.torque.set(row, Vec3::Zero());
    aim_turns(all, set_, circles_.axis(), way);
  }
  void after_advance(const Motion& all, const Way& way) const override {
    const Turned by = turned(way.to.displacement);
    for (const Index row : set_) set(all.place, row, circles_.place(from_[row], by));
  }

 private:
  Vec3 prescribed(Vec3 value) const {
    for (int axis = 0; axis < 3; ++axis)
      if (!(places_ >> axis & 1)) value[axis] = 0;
    return value;
  }
  void set(const View<Vec3>& of, Index row, const Vec3& value) const {
    for (int axis = 0; axis < 3; ++axis)
      if (places_ >> axis & 1) of.at(row, axis) = value[axis];
  }
  Vec3 wanted(const Motion& all, Index row, const Vec3& arm, const PrescribedMotion& now, Real beta) const {
    return all.mass[row] / beta * circles_.acceleration(arm, now.velocity, now.acceleration);
  }
  static Real couple(const Motion& all, Index row, const PrescribedMotion& now, Real beta) {
    return all.inertia[row] * now.acceleration / beta;
  }

  Circles circles_;
  unsigned places_;  // bits of the axes along which places are prescribed
  View<const Vec3> from_;
};

}  // namespace beadwork
