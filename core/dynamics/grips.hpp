#pragma once
// Prescribed motions inside an explicit scheme: rows (element, axis) = value(t), each element by itself or their mean.
// Axes 0..2 are places, 3..5 are turns: those are held still, which spins and torques alone see to.
//
// Work of a step: the inertia of what is gripped takes just the change of its kinetic energy, which prescribed
// velocities tell whatever kinks they have. The rest of the reaction does that of the trapezoid, between what it is
// after the bonds of the last step have broken and what it is before those of this step do: of second order in the
// step. docs/theory/verlet.md
//
// A mean leaves out debris. A loose element, which no bond holds, would take its share of the force and fly away, and
// the mean would follow it instead of the specimen. What breaks loose later is left out from then on.

#include <algorithm>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "core/domain/bodies.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork {

/// What grips take hold of along one kind of axis: rates, the loads that change them, and the inertia in between.
struct Gripped {
  View<Vec3> rate, load;     ///< velocity and force, or spin and torque; null where nothing turns
  View<const Real> inertia;  ///< mass, or moment of inertia
};

class Grips {
 public:
  Grips() = default;
  /// Takes hold of the sets, with the bonds that stood after step `when`.
  Grips(Workings& w, std::int64_t when) : held_(static_cast<std::size_t>(w.domain().size()), 0), driven_(held_) {
    std::vector<const BondTable*> tables;
    for (const auto& [law, table] : w.laws()) tables.push_back(table);
    std::vector<Index> body;
    std::vector<char> averaged(held_.size(), 0);
    for (const Constraint& c : w.constraints()) {
      const Set& all = w.domain().set(c.set);
      if (c.grip == Grip::mean && body.empty()) body = bodies(w.domain(), tables, when);
      sets_.push_back(c.grip == Grip::mean ? without_debris(all, body) : all);
      if (sets_.back().size() < all.size())
        w.log().say_once("mean of " + c.set, fmt::format("{} of the {} elements of '{}' have no bond left, or belong "
                                                         "to a small fragment, and are left out of its mean",
                                                         all.size() - sets_.back().size(), all.size(), c.set));
      axes_.push_back(c.axis);
      averages_.push_back(c.grip == Grip::mean);
      means_.push_back(0);
      weights_.push_back(c.axis < 3 ? weight(c.grip, sets_.back(), w.domain().elements().column("mass").view<Real>())
                                    : 0);
      for (const Index row : sets_.back()) {
        const auto bit = static_cast<unsigned char>(1 << c.axis);
        held_[static_cast<std::size_t>(row)] |= bit;
        if (c.grip == Grip::each) driven_[static_cast<std::size_t>(row)] |= bit;
        if (c.grip == Grip::mean) averaged[static_cast<std::size_t>(row)] = 1;
      }
    }
    for (Index row = 0; row < w.domain().size(); ++row)
      if (held(row) != 0) rows_.push_back(row);
    if (!body.empty()) note_bonds(w.domain(), tables, averaged);
  }

  /// Whether one of these breaks, from number `first` on, may have set free a part of what a mean holds.
  bool loosened(const std::vector<Break>& breaks, std::size_t first) const {
    for (std::size_t k = first; k < breaks.size(); ++k)
      if (bonds_of_means_.contains({breaks[k].family, breaks[k].bond})) return true;
    return false;
  }

  /// Rates that jump at the start of a stage: an impulse of the grip, whose work is the kinetic energy it brings.
  void seize(Workings& w, const Gripped& places, const Gripped& turns, Real beta) {
    for (std::size_t k = 0; k < sets_.size(); ++k) {
      Constraint& c = w.constraints()[k];
      const Gripped& of = c.axis < 3 ? places : turns;
      if (!of.rate) continue;
      const Real before = kinetic(sets_[k], of, c.axis % 3);
      set_rate(c, sets_[k], c.at(w.moment().time).velocity, of);
      c.work += (kinetic(sets_[k], of, c.axis % 3) - before) / beta;
    }
  }

  /// What a mean keeps from moving its set: of sum |F|^2/m the part of the set's mean, (sum F/m)^2 / sum 1/m, over all
  /// means [N^2/kg].
  Real held_by_means(const Gripped& places, const Gripped& turns) const {
    Real all = 0;
    for (std::size_t k = 0; k < sets_.size(); ++k) {
      const Gripped& of = axes_[k] < 3 ? places : turns;
      if (!averages_[k] || !of.load || sets_[k].empty()) continue;
      Real pull = 0, weight = 0;
      for (const Index row : sets_[k]) {
        pull += of.load.at(row, axes_[k] % 3) / of.inertia[row];
        weight += 1 / of.inertia[row];
      }
      all += pull * pull / weight;
    }
    return all;
  }

  /// Rows of which something prescribes an axis, ascending.
  const std::vector<Index>& rows() const { return rows_; }
  /// Bit `axis` of the axes that something prescribes on this row.
  unsigned held(Index row) const { return held_[static_cast<std::size_t>(row)]; }
  bool holds_any(Index row, int count) const {
    unsigned any = 0;
    for (int k = 0; k < count; ++k) any |= held(row + k);
    return any != 0;
  }
  /// Whether the motion of this very element is prescribed, not only that of a mean.
  bool drives(Index row, int axis) const { return driven(row) >> axis & 1; }
  unsigned driven(Index row) const { return driven_[static_cast<std::size_t>(row)]; }

  /// Once bonds have broken at the end of a step: the reactions for the half step to come are those of the forces that
  /// are left. The forces themselves stay as they are, for places and rates that are prescribed follow from no force.
  void bonds_broke(Workings& w, const Gripped& places, const Gripped& turns, Real beta) const {
    each_grip(w, places, turns, [&](std::size_t k, Constraint& c, const Gripped& of) {
      const Real lacking = missing(c, sets_[k], of, c.at(w.moment().time).acceleration / beta);
      c.reaction += c.grip == Grip::each ? lacking : lacking * static_cast<Real>(sets_[k].size());
    });
  }

  /// Members that these grips, made anew after breaks, have let go still carry their share of the reaction in the half
  /// step to come. Rates are those of the full step.
  void take_over(Workings& w, const Grips& before, const Gripped& places, const Gripped& turns) const {
    const Real dt = w.moment().time_step;
    each_grip(w, places, turns, [&](std::size_t k, Constraint& c, const Gripped& of) {
      const Set& all = before.sets_[k];
      if (c.axis >= 3 || all.size() == sets_[k].size()) return;
      const Real share = c.reaction / static_cast<Real>(all.size());
      for (const Index row : all)
        if (!(held(row) >> c.axis & 1))
          c.work += 0.5 * share * dt * (of.rate.at(row, c.axis) + 0.5 * dt * of.load.at(row, c.axis) / of.inertia[row]);
      c.reaction = share * static_cast<Real>(sets_[k].size());
    });
  }

  /// Notes where what is gripped stands; to be called before places advance.
  void before_advance(Workings& w, const View<Vec3>& position) {
    for (std::size_t k = 0; k < sets_.size(); ++k) {
      const Constraint& c = w.constraints()[k];
      if (c.axis < 3 && c.grip == Grip::mean)
        means_[k] = mean(sets_[k], [&](Index row) { return position.at(row, c.axis); });
    }
    if (places_.empty())
      for (const Set& set : sets_) places_.emplace_back(set.size());
    for (std::size_t k = 0; k < sets_.size(); ++k) {
      const Constraint& c = w.constraints()[k];
      if (c.axis >= 3 || c.grip != Grip::each) continue;
      for (std::size_t n = 0; n < sets_[k].size(); ++n) places_[k][n] = position.at(sets_[k][n], c.axis);
    }
  }

  /// Puts what is gripped where it has to be at the end of the step, and does the work of the old reaction's half.
  void after_advance(Workings& w, const View<Vec3>& position, const View<const Real>& mass, Real beta) {
    const Moment& now = w.moment();
    for (std::size_t k = 0; k < sets_.size(); ++k) {
      Constraint& c = w.constraints()[k];
      if (c.axis >= 3) continue;
      const PrescribedMotion here = c.at(now.time);
      const Real moved = c.at(now.time + now.time_step).displacement - here.displacement;
      c.work += 0.5 * (c.reaction - weights_[k] * here.acceleration / beta) * moved;
      if (c.grip == Grip::each) {
        for (std::size_t n = 0; n < sets_[k].size(); ++n) position.at(sets_[k][n], c.axis) = places_[k][n] + moved;
        continue;
      }
      const Real reached = mean(sets_[k], [&](Index row) { return position.at(row, c.axis); });
      shift(sets_[k], means_[k] + moved - reached, position, c.axis, mass);
    }
  }

  /// Replaces the force on what is gripped by the one that gives the prescribed acceleration; the difference is the
  /// reaction, and does its half of the work of the step that has just been made.
  void react(Workings& w, const Gripped& places, const Gripped& turns, Real beta) {
    const Moment& now = w.moment();
    each_grip(w, places, turns, [&](std::size_t k, Constraint& c, const Gripped& of) {
      const Set& set = sets_[k];
      const int axis = c.axis % 3;
      const PrescribedMotion here = c.at(now.time);
      const Real a = here.acceleration / beta;
      const Real lacking = missing(c, set, of, a);
      if (c.grip == Grip::each) {
        for (const Index row : set) of.load.at(row, axis) = of.inertia[row] * a;
        c.reaction = lacking;
      } else {
        for (const Index row : set) of.load.at(row, axis) += lacking;
        c.reaction = lacking * static_cast<Real>(set.size());
      }
      if (now.step == now.stage_step) return;
      const PrescribedMotion before = c.at(now.time - now.time_step);
      c.work += 0.5 * (c.reaction - weights_[k] * a) * (here.displacement - before.displacement);
      c.work += 0.5 * weights_[k] / beta * (here.velocity * here.velocity - before.velocity * before.velocity);
    });
  }

  void after_correct(Workings& w, const Gripped& places, const Gripped& turns) {
    const Moment& now = w.moment();
    for (std::size_t k = 0; k < sets_.size(); ++k) {
      const Constraint& c = w.constraints()[k];
      const Gripped& of = c.axis < 3 ? places : turns;
      if (of.rate) set_rate(c, sets_[k], c.at(now.time).velocity, of);
    }
  }

 private:
  // f(number, constraint, rates and loads of its kind of axis) of each that holds something which moves.
  template <class F>
  void each_grip(Workings& w, const Gripped& places, const Gripped& turns, const F& f) const {
    for (std::size_t k = 0; k < sets_.size(); ++k) {
      Constraint& c = w.constraints()[k];
      const Gripped& of = c.axis < 3 ? places : turns;
      if (of.load) f(k, c, of);
    }
  }

  // What the loads lack of the acceleration `a`: in all where each element has it, for each element where the mean
  // does.
  static Real missing(const Constraint& c, const Set& set, const Gripped& of, Real a) {
    const int axis = c.axis % 3;
    if (c.grip == Grip::mean) {
      const Real free = mean(set, [&](Index row) { return of.load.at(row, axis) / of.inertia[row]; });
      return (a - free) / mean(set, [&](Index row) { return 1 / of.inertia[row]; });
    }
    Real sum = 0;
    for (const Index row : set) sum += of.inertia[row] * a - of.load.at(row, axis);
    return sum;
  }

  // What the motion of all is worth in kinetic energy: 1/2 of this times the square of the prescribed velocity.
  static Real weight(Grip grip, const Set& set, const View<const Real>& mass) {
    const auto count = static_cast<Real>(set.size());
    return grip == Grip::each ? count * mean(set, [&](Index row) { return mass[row]; })
                              : count / mean(set, [&](Index row) { return 1 / mass[row]; });
  }

  static void set_rate(const Constraint& c, const Set& set, Real v, const Gripped& of) {
    const int axis = c.axis % 3;
    if (c.grip == Grip::each) {
      for (const Index row : set) of.rate.at(row, axis) = v;
      return;
    }
    shift(set, v - mean(set, [&](Index row) { return of.rate.at(row, axis); }), of.rate, axis, of.inertia);
  }

  static Real kinetic(const Set& set, const Gripped& of, int axis) {
    Real twice = 0;
    for (const Index row : set) twice += of.inertia[row] * of.rate.at(row, axis) * of.rate.at(row, axis);
    return 0.5 * twice;
  }

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

  void note_bonds(const Domain& domain, const std::vector<const BondTable*>& tables,
                  const std::vector<char>& averaged) {
    for (std::size_t f = 0; f < domain.families().size(); ++f) {
      const BondTable* table = domain.families()[f];
      if (std::find(tables.begin(), tables.end(), table) == tables.end()) continue;
      for (Index b = 0; b < table->size(); ++b)
        if (averaged[static_cast<std::size_t>(table->first()[b])] ||
            averaged[static_cast<std::size_t>(table->second()[b])])
          bonds_of_means_.insert({static_cast<Index>(f), table->id()[b]});
    }
  }

  std::vector<Set> sets_;
  std::vector<int> axes_;
  std::vector<char> averages_;
  std::vector<Index> rows_;
  std::vector<Real> means_, weights_;
  std::vector<std::vector<Real>> places_;
  std::vector<unsigned char> held_,
      driven_;  // bit `axis`: prescribed there, of the element itself or of a mean; of itself
  std::set<std::pair<Index, Index>> bonds_of_means_;  // (family, id) of the bonds that hold members of a mean
};

}  // namespace beadwork
