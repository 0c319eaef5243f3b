#pragma once
// Prescribed motions inside an explicit scheme: rows (element, axis) = value(t), each element by itself or their mean.

#include <vector>

#include "core/plugin/kinds.hpp"

namespace beadwork {

class Grips {
 public:
  Grips() = default;
  Grips(const Domain& domain, const std::vector<Constraint>& constraints) : held_(static_cast<std::size_t>(domain.size()), 0) {
    for (const Constraint& c : constraints) {
      sets_.push_back(&domain.set(c.set));
      means_.push_back(0);
      for (const Index row : *sets_.back()) held_[static_cast<std::size_t>(row)] |= static_cast<unsigned char>(1 << c.axis);
    }
  }

  bool holds(Index row, int axis) const { return held_[static_cast<std::size_t>(row)] >> axis & 1; }

  /// Notes where what is gripped stands; to be called before places advance.
  void before_advance(Workings& w, const View<Vec3>& position) {
    for (std::size_t k = 0; k < sets_.size(); ++k) {
      const Constraint& c = w.constraints()[k];
      if (c.grip == Grip::mean) means_[k] = mean(*sets_[k], [&](Index row) { return position.at(row, c.axis); });
    }
    if (places_.empty())
      for (const Set* set : sets_) places_.emplace_back(set->size());
    for (std::size_t k = 0; k < sets_.size(); ++k) {
      const Constraint& c = w.constraints()[k];
      if (c.grip != Grip::each) continue;
      for (std::size_t n = 0; n < sets_[k]->size(); ++n) places_[k][n] = position.at((*sets_[k])[n], c.axis);
    }
  }

  /// Puts what is gripped where it has to be at the end of the step, and does the work of the old reaction's half.
  void after_advance(Workings& w, const View<Vec3>& position, const View<const Real>& mass) {
    const Moment& now = w.moment();
    for (std::size_t k = 0; k < sets_.size(); ++k) {
      Constraint& c = w.constraints()[k];
      const Real moved = travel(c, now, now.time + now.time_step) - travel(c, now, now.time);
      c.work += 0.5 * c.reaction * moved;
      if (c.grip == Grip::each) {
        for (std::size_t n = 0; n < sets_[k]->size(); ++n) position.at((*sets_[k])[n], c.axis) = places_[k][n] + moved;
        continue;
      }
      const Real reached = mean(*sets_[k], [&](Index row) { return position.at(row, c.axis); });
      shift(*sets_[k], means_[k] + moved - reached, position, c.axis, mass);
    }
  }

  /// Replaces the force on what is gripped by the one that gives the prescribed acceleration; the difference is the
  /// reaction, and does its half of the work of the step that has just been made.
  void react(Workings& w, const View<const Real>& mass, const View<Vec3>& force, Real beta) {
    const Moment& now = w.moment();
    for (std::size_t k = 0; k < sets_.size(); ++k) {
      Constraint& c = w.constraints()[k];
      const Set& set = *sets_[k];
      const Real a = c.motion(now.time - now.stage_start).acceleration / beta;
      Real sum = 0;
      if (c.grip == Grip::each) {
        for (const Index row : set) {
          Real& f = force.at(row, c.axis);
          sum += mass[row] * a - f;
          f = mass[row] * a;
        }
      } else {
        const Real free = mean(set, [&](Index row) { return force.at(row, c.axis) / mass[row]; });
        const Real more = (a - free) / mean(set, [&](Index row) { return 1 / mass[row]; });
        for (const Index row : set) force.at(row, c.axis) += more;
        sum = more * static_cast<Real>(set.size());
      }
      c.reaction = sum;
      if (now.step == now.stage_step) continue;
      c.work += 0.5 * sum * (travel(c, now, now.time) - travel(c, now, now.time - now.time_step));
    }
  }

  void after_correct(Workings& w, const View<Vec3>& velocity, const View<const Real>& mass) {
    const Moment& now = w.moment();
    for (std::size_t k = 0; k < sets_.size(); ++k) {
      const Constraint& c = w.constraints()[k];
      const Real v = c.motion(now.time - now.stage_start).velocity;
      if (c.grip == Grip::each) {
        for (const Index row : *sets_[k]) velocity.at(row, c.axis) = v;
        continue;
      }
      const Real reached = mean(*sets_[k], [&](Index row) { return velocity.at(row, c.axis); });
      shift(*sets_[k], v - reached, velocity, c.axis, mass);
    }
  }

 private:
  static Real travel(const Constraint& c, const Moment& now, Real time) { return c.motion(time - now.stage_start).displacement; }

  template <class F>
  static Real mean(const Set& set, const F& f) {
    Real sum = 0;
    for (const Index row : set) sum += f(row);
    return sum / static_cast<Real>(set.size());
  }

  // Changes the mean by `by` as a force shared equally would: light elements give way more.
  static void shift(const Set& set, Real by, const View<Vec3>& of, int axis, const View<const Real>& mass) {
    const Real scale = by / mean(set, [&](Index row) { return 1 / mass[row]; });
    for (const Index row : set) of.at(row, axis) += scale / mass[row];
  }

  std::vector<const Set*> sets_;
  std::vector<Real> means_;
  std::vector<std::vector<Real>> places_;
  std::vector<unsigned char> held_;
};

}  // namespace beadwork
