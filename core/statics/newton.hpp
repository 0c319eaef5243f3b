#pragma once
// Equilibrium by Newton's iteration.        docs/theory/statics.md

#include <string>

#include "core/statics/static_model.hpp"
#include "core/statics/supported_system.hpp"

namespace beadwork {

/// Why an iteration ended.
enum class Reason { converged, too_many_iterations, grows, far_away, no_number, singular, linear_solver };
/// In words, for the log.
const char* in_words(Reason reason);

struct NewtonLimits {
  Real tolerance = 1e-6;  ///< of residual, displacement and energy, each over what this increment does
  int iterations = 20;
  Slope slope = Slope::consistent;
};

struct NewtonResult {
  Reason reason = Reason::converged;
  int iterations = 0;
  Real residual = 0;   ///< what is unbalanced, over what the increment does
  Real reference = 0;  ///< what the increment does [N]
  int weakest = -1;    ///< unknown that nothing holds, of a singular system
  bool converged() const { return reason == Reason::converged; }
};

/// quick: the stiffness of the deck's choice, kept while it serves. thorough: a new one at each iteration, for large
/// turns. careful: a new secant one, which finds the way where bonds open and close by turns.
enum class Manner { quick, thorough, careful };

/// What solving has cost so far.
struct NewtonCosts {
  std::int64_t iterations = 0, factors = 0, solves = 0;
  Real factor_seconds = 0, stiffness_seconds = 0, force_seconds = 0, solve_seconds = 0;
};

class Newton {
 public:
  Newton(StaticModel& model, SupportedSystem& system, NewtonLimits limits)
      : model_(model), system_(system), limits_(limits) {}

  /// Brings the model from its last accepted state to the equilibrium at this time; the trial state is left as it
  /// stands at the end.
  NewtonResult go(Real time, Manner manner = Manner::quick);
  /// The equilibrium at which `gradient` times what has moved since the last accepted state is `value`: loads go as far
  /// as that takes, backwards too.
  NewtonResult go_by(const Vector& gradient, Real value);
  /// The factor is of a state before, which may be too far away: the next iteration finds its own.
  void forget_factor() { stale_ = true; }
  const NewtonCosts& costs() const { return costs_; }

 private:
  Real what_it_does(const Vector& f, const Vector& unbalanced, const Vector& at_start, Real loads) const;
  Factored factor(Slope slope);
  bool solve(const Vector& forces, const Lacking& lacking, Vector& du);
  const Vector& forces();

  StaticModel& model_;
  SupportedSystem& system_;
  NewtonLimits limits_;
  NewtonCosts costs_;
  bool stale_ = true;
};

}  // namespace beadwork
