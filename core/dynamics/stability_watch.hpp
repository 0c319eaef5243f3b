#pragma once
// Ends a run beyond stability, before its numbers are none. What gains energy slowly is for the ledger of the loop to
// see.

#include <fmt/format.h>

#include <cmath>

#include "core/base/failure.hpp"
#include "core/base/parallel.hpp"
#include "core/dynamics/motion.hpp"

namespace beadwork {

/// The time step's own fault, at so much of the largest stable one (0: no bond limits it); "" where it has none.
inline std::string fault_of_step(Real ratio) {
  if (ratio > 1)
    return fmt::format(
        "probable cause: the time step is {:.4g} times the largest stable one; leave 'time-step' out, or lower "
        "'safety'",
        ratio);
  return ratio == 0 ? "no bond limits the time step, so probably it is too long: lower 'time-step'" : "";
}

/// What is probably wrong with a run that gains energy.
inline std::string suspect_step(Real ratio, bool laws_damp) {
  if (const std::string fault = fault_of_step(ratio); !fault.empty()) return fault;
  return fmt::format(
      "the time step is {:.3g} of the largest stable one, so probably the tangent that a bond law states is too small, "
      "or its force is not the slope of its stored energy{}: if a smaller 'safety' helps, it is the tangent",
      ratio, laws_damp ? ", or its damping takes another power than it states" : "");
}

class StabilityWatch {
 public:
  /// `stable`: the largest stable step when the stage began [s].
  StabilityWatch(Workings& workings, const Motion& motion, Real stable) : w_(workings), all_(motion), stable_(stable) {}

  /// Throws PhysicsFailure with element, step and the probable cause.
  void look() const {
    check_bonds();
    check_elements();
  }

  [[noreturn]] void stop_at_force() const {
    for (Index i = 0; i < all_.count; ++i)
      if (!all_.force[i].allFinite() || (all_.spin && !all_.torque[i].allFinite()))
        throw PhysicsFailure(
            fmt::format("step {}: the force on element {} is not finite; {}", w_.moment().step, id(i), cause()));
    throw PhysicsFailure(fmt::format("step {}: forces are not finite; {}", w_.moment().step, cause()));
  }

 private:
  Real dt() const { return w_.moment().time_step; }
  Index id(Index row) const { return w_.domain().elements().column("id").view<Index>()[row]; }

  // In one step the ends of a bond may approach or part by a small share of its length only: faster is no solid any
  // more.
  void check_bonds() const {
    for (const auto& acting : w_.laws()) {
      const BondTable& table = *acting.second;
      if (table.is_of_walls()) continue;  // their skin is watched (core/loop/contacts)
      const auto first = [&](Index c) { return first_too_fast(table, table.chunks()[static_cast<std::size_t>(c)]); };
      const Index c = first_where(static_cast<Index>(table.chunks().size()), [&](Index k) { return first(k) >= 0; });
      if (c < 0) continue;
      const Index b = first(c);
      stop(table.first()[b], fmt::format("of a bond of '{}' moves by {:.2g} of the bond's length in one step",
                                         table.name(), moved(table, b)));
    }
  }

  Index first_too_fast(const BondTable& table, const Chunk& chunk) const {
    for (Index b = chunk.begin; b < chunk.live_end; ++b)
      if (moved(table, b) > 0.2) return b;
    return -1;
  }

  Real moved(const BondTable& table, Index b) const {
    const Index i = table.first()[b];
    const Index j = table.second()[b];
    return (all_.velocity[j] - all_.velocity[i]).norm() * dt() / (all_.place[j] - all_.place[i]).norm();
  }

  // Nor does an element pass by itself in one step.
  void check_elements() const {
    const auto moved = [&](Index i) {
      const Real way = all_.velocity[i].norm() * dt();
      return all_.radius[i] > 0 ? way / all_.radius[i] : 0 * way;  // a wall has no size to pass by, but no NaN either
    };
    const Index i = first_where(all_.count, [&](Index k) { return !(moved(k) <= 1 && all_.place[k].allFinite()); });
    if (i < 0) return;
    stop(i, std::isfinite(moved(i)) ? fmt::format("moves by {:.2g} of its radius in one step", moved(i))
                                    : "has no finite place or velocity");
  }

  // -1 where there is none, as nearly always: all threads ask, and the first is looked for only if it is there.
  template <class F>
  static Index first_where(Index count, const F& f) {
    if (!any_shared(count, f, 16)) return -1;
    Index k = 0;
    while (!f(k)) ++k;
    return k;
  }

  [[noreturn]] void stop(Index element, const std::string& why) const {
    throw PhysicsFailure(fmt::format("step {}: element {} {}; {}", w_.moment().step, id(element), why, cause()));
  }

  std::string cause() const {
    const Real ratio = dt() / stable_;
    if (const std::string fault = fault_of_step(ratio); !fault.empty()) return fault;
    return fmt::format(
        "the time step is {:.3g} of the largest stable one, so probably a load is too fast, or the tangent that a bond "
        "law states too small",
        ratio);
  }

  Workings& w_;
  Motion all_;
  Real stable_;
};

}  // namespace beadwork
