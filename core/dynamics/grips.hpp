#pragma once
// Prescribed motions inside an explicit scheme: rows (element, axis) = value(t), of each element by itself, of their
// mean, or of a set that turns as a body (gripped.hpp). Axes 0..2 are places, 3..5 are turns.
//
// Work of a step: the inertia of what is gripped takes just the change of its kinetic energy, which prescribed
// velocities tell whatever kinks they have. The rest of the reaction does that of the trapezoid, between what it is
// after the bonds of the last step have broken and what it is before those of this step do: of second order in the
// step. Of a turn the reaction is a torque, the way an angle and the inertia that about the axis. docs/theory/verlet.md
//
// A mean leaves out debris. A loose element, which no bond holds, would take its share of the force and fly away, and
// the mean would follow it instead of the specimen. What breaks loose later is left out from then on.

#include <algorithm>
#include <memory>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "core/domain/bodies.hpp"
#include "core/dynamics/gripped.hpp"

namespace beadwork {

class Grips {
 public:
  Grips() = default;
  /// Takes hold of the sets, with the bonds that stood after step `when`.
  Grips(Workings& w, const Motion& all, std::int64_t when)
      : held_(static_cast<std::size_t>(w.domain().size()), 0), driven_(held_) {
    std::vector<const BondTable*> tables;
    for (const auto& [law, table] : w.laws()) tables.push_back(table);
    std::vector<Index> body;
    std::vector<char> averaged(held_.size(), 0);
    for (const Constraint& c : w.constraints()) {
      if (c.grip == Grip::mean && body.empty()) body = bodies(w.domain(), tables, when);
      grips_.push_back(take_hold(w, c, body));
      weights_.push_back(grips_.back()->moves(all) ? grips_.back()->weight(all) : 0);
      for (const Index row : grips_.back()->set()) {
        const auto bits = static_cast<unsigned char>(c.prescribes());
        held_[static_cast<std::size_t>(row)] |= bits;
        if (c.grip == Grip::each) driven_[static_cast<std::size_t>(row)] |= bits;
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
  void seize(Workings& w, const Motion& all, Real beta) {
    each_grip(w, all, [&](std::size_t, Constraint& c, Gripped& of) {
      const Real before = of.kinetic(all);
      of.set_rates(all, c.at(w.moment().time));
      c.work += (of.kinetic(all) - before) / beta;
    });
  }

  /// What a mean keeps from moving its set: of sum |F|^2/m the part of the set's mean, (sum F/m)^2 / sum 1/m, over all
  /// means [N^2/kg].
  Real held_by_means(const Motion& motion) const {
    Real all = 0;
    for (const auto& of : grips_)
      if (of->moves(motion)) all += of->held_as_mean(motion);
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
  void bonds_broke(Workings& w, const Motion& all, Real beta) const {
    each_grip(w, all, [&](std::size_t, Constraint& c, const Gripped& of) {
      const Lack lack = of.lacking(all, c.at(w.moment().time), beta);
      c.reaction += lack.along;
      if (c.body)
        for (std::size_t axis = 0; axis < 3; ++axis) c.body->forces[axis] += lack.force[static_cast<int>(axis)];
    });
  }

  /// Members that these grips, made anew after breaks, have let go still carry their share of the reaction in the half
  /// step to come. Rates are those of the full step.
  void take_over(Workings& w, const Grips& before, const Motion& motion) const {
    const Real dt = w.moment().time_step;
    each_grip(w, motion, [&](std::size_t k, Constraint& c, const Gripped& of) {
      const Set& all = before.grips_[k]->set();
      if (c.axis >= 3 || all.size() == of.set().size()) return;
      const Real share = c.reaction / static_cast<Real>(all.size());
      for (const Index row : all)
        if (!(held(row) >> c.axis & 1))
          c.work += 0.5 * share * dt *
                    (motion.velocity.at(row, c.axis) + 0.5 * dt * motion.force.at(row, c.axis) / motion.mass[row]);
      c.reaction = share * static_cast<Real>(of.set().size());
    });
  }

  /// Notes where what is gripped stands; to be called before places and turns advance.
  void before_advance(Workings& w, const Motion& all) {
    const Moment& now = w.moment();
    ways_.resize(grips_.size());
    each_grip(w, all, [&](std::size_t k, const Constraint& c, Gripped& of) {
      ways_[k] = {c.at(now.time), c.at(now.time + now.time_step), now.time_step};
      of.before_advance(all, ways_[k]);
    });
  }

  /// Puts what is gripped where it has to be at the end of the step, and does the work of the old reaction's half.
  void after_advance(Workings& w, const Motion& all, Real beta) {
    each_grip(w, all, [&](std::size_t k, Constraint& c, const Gripped& of) {
      const Way& way = ways_[k];
      c.work += 0.5 * (c.reaction - weights_[k] * way.from.acceleration / beta) * way.moved();
      of.after_advance(all, way);
    });
  }

  /// Replaces the force on what is gripped by the one that gives the prescribed acceleration; the difference is the
  /// reaction, and does its half of the work of the step that has just been made.
  void react(Workings& w, const Motion& all, Real beta) {
    const Moment& now = w.moment();
    each_grip(w, all, [&](std::size_t k, Constraint& c, const Gripped& of) {
      const PrescribedMotion here = c.at(now.time);
      const Lack lack = of.impose(all, here, beta);
      c.reaction = lack.along;
      if (c.body)
        for (std::size_t axis = 0; axis < 3; ++axis) c.body->forces[axis] = lack.force[static_cast<int>(axis)];
      if (now.step == now.stage_step) return;
      const PrescribedMotion before = c.at(now.time - now.time_step);
      c.work +=
          0.5 * (c.reaction - weights_[k] * (here.acceleration / beta)) * (here.displacement - before.displacement);
      c.work += 0.5 * weights_[k] / beta * (here.velocity * here.velocity - before.velocity * before.velocity);
    });
  }

  void after_correct(Workings& w, const Motion& all) {
    each_grip(w, all,
              [&](std::size_t, const Constraint& c, const Gripped& of) { of.set_rates(all, c.at(w.moment().time)); });
  }

 private:
  static std::unique_ptr<Gripped> take_hold(Workings& w, const Constraint& c, const std::vector<Index>& body) {
    const Set& all = w.domain().set(c.set);
    if (c.body) return std::make_unique<GrippedBody>(all, c, w.domain().elements().column(c.body->from).view<Vec3>());
    if (c.grip == Grip::each) return std::make_unique<GrippedEach>(all, c.axis);
    Set carrying = without_debris(all, body);
    if (carrying.size() < all.size())
      w.log().say_once("mean of " + c.set, fmt::format("{} of the {} elements of '{}' have no bond left, or belong "
                                                       "to a small fragment, and are left out of its mean",
                                                       all.size() - carrying.size(), all.size(), c.set));
    return std::make_unique<GrippedMean>(std::move(carrying), c.axis);
  }

  // f(number, constraint, what it holds) of each that holds something which moves.
  template <class F>
  void each_grip(Workings& w, const Motion& all, const F& f) const {
    for (std::size_t k = 0; k < grips_.size(); ++k)
      if (grips_[k]->moves(all)) f(k, w.constraints()[k], *grips_[k]);
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

  std::vector<std::unique_ptr<Gripped>> grips_;  // of the constraints, one by one
  std::vector<Real> weights_;
  std::vector<Way> ways_;  // of the step that is being made
  std::vector<Index> rows_;
  std::vector<unsigned char> held_,
      driven_;  // bit `axis`: prescribed there, of the element itself or of a mean; of itself
  std::set<std::pair<Index, Index>> bonds_of_means_;  // (family, id) of the bonds that hold members of a mean
};

}  // namespace beadwork
