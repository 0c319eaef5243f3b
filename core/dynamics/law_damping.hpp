#pragma once
// Bond laws that read velocities: they see those of the step, as far as they can be known before its forces are, and
// what they take is the force that they gave times the velocity that came of it. docs/theory/verlet.md

#include <algorithm>
#include <vector>

#include "core/base/parallel.hpp"
#include "core/dynamics/motion.hpp"
#include "core/plugin/blame.hpp"

namespace beadwork {

class LawDamping {
 public:
  /// At the start of a stage.
  void prepare(Workings& w) {
    acts_ = std::any_of(w.laws().begin(), w.laws().end(), [](const auto& acting) { return acting.first->moves(); });
  }
  bool acts() const { return acts_; }

  /// The velocities that stand are those that the forces are found with.
  void see(const Motion& all) {
    if (acts_) take(all, foreseen_);
  }

  /// Velocities stand half-way: `foresee` brings them to the step, `evaluate` finds the forces; then they stand
  /// half-way again.
  template <class Foresee, class Evaluate>
  void evaluate(const Motion& all, const Foresee& foresee, const Evaluate& find_forces) {
    take(all, kept_);
    foresee();
    see(all);
    find_forces();
    set(all, [&](std::size_t i) { return kept_[i]; });
  }

  /// At the velocities of the step [W]. A power is the square of a velocity, so f.C.v = P((f + v)/2) - P((f - v)/2);
  /// where a law's is not, this is exact to second order in f - v.
  Real power(Workings& w, const Motion& all) {
    return acts_ ? product(w, all, [](const Rates& now, Index) { return now; }) : 0;
  }

  /// By how much what is booked lags behind what they took: dt^2/4 of their force times the acceleration [J].
  Real lag(Workings& w, const Motion& all, Real dt) {
    if (!acts_) return 0;
    return -dt / 4 * product(w, all, [&](const Rates&, Index i) {
      return Rates{dt / all.mass[i] * all.force[i],
                   all.spin ? Vec3(dt / all.inertia[i] * all.torque[i]) : Vec3(Vec3::Zero())};
    });
  }

 private:
  struct Rates {
    Vec3 velocity, spin;
  };

  static void take(const Motion& all, std::vector<Rates>& into) {
    into.resize(static_cast<std::size_t>(all.count));
    each_shared(all.count, [&](Index i) {
      into[static_cast<std::size_t>(i)] = {all.velocity[i], all.spin ? Vec3(all.spin[i]) : Vec3(Vec3::Zero())};
    });
  }

  template <class Of>
  static void set(const Motion& all, const Of& of) {
    each_shared(all.count, [&](Index i) {
      const Rates value = of(static_cast<std::size_t>(i));
      all.velocity.set(i, value.velocity);
      if (all.spin) all.spin.set(i, value.spin);
    });
  }

  // of(rates, row) is what the foreseen velocities are multiplied with.
  template <class Of>
  Real product(Workings& w, const Motion& all, const Of& of) {
    take(all, kept_);
    const auto power_at = [&](Real sign) {
      set(all, [&](std::size_t i) {
        const Rates& f = foreseen_[i];
        const Rates other = of(kept_[i], static_cast<Index>(i));
        return Rates{0.5 * (f.velocity + sign * other.velocity), 0.5 * (f.spin + sign * other.spin)};
      });
      Real sum = 0;
      for (const auto& [law, table] : w.laws())
        if (law->moves())
          sum += blaming(*law, "power", [&, law = law, table = table] { return law->power(w.domain(), *table); });
      return sum;
    };
    const Real found = power_at(1) - power_at(-1);
    set(all, [&](std::size_t i) { return kept_[i]; });
    return found;
  }

  bool acts_ = false;            // some law of the stage reads velocities
  std::vector<Rates> foreseen_;  // of each element, with which the forces were found
  std::vector<Rates> kept_;      // while others stand in their place
};

}  // namespace beadwork
