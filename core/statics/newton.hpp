#pragma once
// Equilibrium by Newton's iteration.        docs/theory/statics.md

#include <cstdint>

#include "core/statics/static_model.hpp"
#include "core/statics/supported_system.hpp"

namespace beadwork {

/// Why an iteration ended.
enum class Reason { converged, too_many_iterations, grows, far_away, outruns_skin, no_number, singular, linear_solver };
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
  int negative = 0;    ///< negative pivots at the last accepted state, where it was factored
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
  /// The stiffness that is kept is of a state too far away: the next iteration finds its own.
  void forget_factor() { served_ = no_factor; }
  /// Iterations that the kept stiffness has served; `no_factor`: there is none.
  int served() const { return served_; }
  static constexpr int no_factor = -1;
  /// Goes on with the stiffness that a run before kept, as if it were its own.
  void take_factor(const SymmetricMatrix& k, int served);
  const NewtonCosts& costs() const { return costs_; }

 private:
  class Judge;
  Factored factor(Slope slope);
  bool renew(Slope slope, NewtonResult& result);
  void shorten(Vector& f, Vector& du);
  bool solve(const Vector& forces, const Lacking& lacking, Vector& du);
  const Vector& forces();

  StaticModel& model_;
  SupportedSystem& system_;
  NewtonLimits limits_;
  NewtonCosts costs_;
  int served_ = no_factor;
};

}  // namespace beadwork
