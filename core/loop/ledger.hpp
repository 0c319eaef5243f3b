#pragma once
// Holds the energy balance of a run against what was brought to it: energy from nothing is noticed, whatever the time
// step. docs/theory/time-step.md

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/domain/kept.hpp"
#include "core/plugin/plugin.hpp"

namespace beadwork {

class Ledger {
 public:
  /// Shares of what was brought, from which on energy from nothing is warned of, and from which on a run that gains
  /// more is stopped.
  static constexpr Real warned_from = 0.01, stopped_from = 1;

  enum class Verdict { balanced, gains, runs_away };

  Ledger() = default;
  /// Keeps its numbers among those of the scene.
  explicit Ledger(Table& scene)
      : brought_(scene, "ledger.brought", "J", "Largest energy brought so far"),
        gained_(scene, "ledger.gained", "J", "Energy gained from nothing at the last look"),
        deviation_(scene, "ledger.deviation", "J", "Largest by which the balance failed to close so far"),
        largest_swing_(scene, "ledger.swing", "J", "Largest swing of the scheme so far"),
        smallest_swing_(scene, "ledger.swing-below", "J", "Smallest swing of the scheme so far"),
        told_(scene, "ledger.told", "1", "1 once a gain has been told"),
        lost_at_breaks_(scene, "ledger.lost-at-breaks", "J", "Energy that breaks have lost by the size of the step") {}

  /// Looks at the balance cost as much as some steps: all hundred steps at first, where most mistakes show, then all
  /// thousand.
  static bool due(std::int64_t steps) { return steps % (steps <= 1000 ? 100 : 1000) == 0; }

  /// After every step: work so far, and the energy that was there without any [J]. The largest counts: what a cycle has
  /// taken back was brought nevertheless.
  void note_work(Real work, Real initial) { brought_ = std::max<Real>(brought_, std::abs(work) + std::abs(initial)); }

  /// `swing`: of the scheme (Mover::swing); `noise`: no more than round-off [J].
  Verdict look(const EnergySums& sums, Real initial, Real swing, Real noise) {
    note_work(sums.worked, initial);
    const Real beyond = sums.beyond_work() - initial + lost_at_breaks_;
    largest_swing_ = std::max<Real>(largest_swing_, swing);
    smallest_swing_ = std::min<Real>(smallest_swing_, swing);  // where it began below zero, it comes up from there
    const Real before = gained_;
    gained_ = beyond - swing + smallest_swing_;
    deviation_ = std::max<Real>({deviation_, gained_, -largest_swing_ - beyond});
    if (!(gained_ > warned_from * brought_ + noise)) return Verdict::balanced;
    return gained_ > stopped_from * brought_ + noise && gained_ > before ? Verdict::runs_away : Verdict::gains;
  }

  /// Where something breaks, the forces jump, and the scheme keeps the energy less what follows from them
  /// (Mover::shadow_energy): what a jump adds to that is lost to the balance, by the size of the step. A jump down is
  /// no gain that could be excused: before it, what the scheme does not keep may have grown out of nothing.
  /// docs/theory/bond-failure.md
  void note_break(Real shadow_before, Real shadow_after) {
    lost_at_breaks_ += std::max(Real(0), shadow_after - shadow_before);
  }

  Real lost_at_breaks() const { return lost_at_breaks_; }  ///< [J]
  Real brought() const { return brought_; }                ///< largest so far: |work| + |what was there| [J]
  Real gained() const { return gained_; }                  ///< at the last look, beyond that and beyond the swing [J]
  Real deviation() const {
    return deviation_;
  }  ///< largest so far by which the balance failed to close, either way [J]

  /// Whether it is to be told now that energy comes from nothing: once.
  bool tells() {
    const bool first = told_ == 0;
    told_ = 1;
    return first;
  }

 private:
  Kept brought_, gained_, deviation_, largest_swing_, smallest_swing_, told_, lost_at_breaks_;
};

}  // namespace beadwork
