#include "core/statics/newton.hpp"

#include <chrono>
#include <cmath>

#include "core/statics/acceleration.hpp"

namespace beadwork {

namespace {

/// Adds the seconds of its life to a sum.
class Timer {
 public:
  explicit Timer(Real& sum) : sum_(sum) {}
  ~Timer() { sum_ += std::chrono::duration<Real>(std::chrono::steady_clock::now() - began_).count(); }
  Timer(const Timer&) = delete;
  Timer& operator=(const Timer&) = delete;

 private:
  Real& sum_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

// A factor is kept for so many iterations, and not after one that leaves more than this of the least that was left: then
// the stiffness is too far off.
constexpr int patience = 10;
constexpr Real slow = 2;

}  // namespace

const char* in_words(Reason reason) {
  switch (reason) {
    case Reason::converged: return "converged";
    case Reason::too_many_iterations: return "too many iterations";
    case Reason::grows: return "the residual grows";
    case Reason::no_number: return "forces are no numbers";
    case Reason::singular: return "the stiffness is singular";
    case Reason::linear_solver: return "the linear solver did not come to its end";
  }
  return "";
}

Factored Newton::factor(Slope slope) {
  const SymmetricMatrix* k = nullptr;
  {
    const Timer timer(costs_.stiffness_seconds);
    k = &model_.stiffness(slope);
  }
  const Timer timer(costs_.factor_seconds);
  ++costs_.factors;
  stale_ = false;
  return system_.factor(*k, model_.supports());
}

bool Newton::solve(const Vector& forces, const Lacking& lacking, Vector& du) {
  const Timer timer(costs_.solve_seconds);
  ++costs_.solves;
  return system_.solve(forces, lacking, du);
}

const Vector& Newton::forces() {
  const Timer timer(costs_.force_seconds);
  return model_.forces();
}

NewtonResult Newton::go(Real time) {
  NewtonResult result;
  model_.begin_trial(time);
  Slope slope = limits_.slope;
  Vector f = forces();
  if (!f.allFinite()) return result.reason = Reason::no_number, result;
  const Vector at_start = f;
  Vector unbalanced, du, moved = Vector::Zero(f.size());
  Real before = -1, least = -1, energy_reference = 0;
  int growths = 0, with_this_factor = 0;
  Acceleration acceleration;
  bool forced = stale_ || !system_.is_factored();

  for (result.iterations = 1; result.iterations <= limits_.iterations; ++result.iterations) {
    ++costs_.iterations;
    if (forced) {
      const Factored factored = factor(slope);
      forced = false;
      with_this_factor = 0;
      acceleration.forget();
      if (!factored.whole || factored.weakest >= 0) {
        result.weakest = factored.weakest;
        return result.reason = Reason::singular, result;
      }
    }
    const Lacking lacking = model_.lacking();
    if (before < 0) before = model_.supports().unbalanced(f).norm();
    const Real unbalanced_at_start = result.iterations == 1 ? before : 0;
    if (!solve(f, lacking, du)) return result.reason = Reason::linear_solver, result;
    du = acceleration.step(du);
    model_.move(du);
    moved += du;
    const Vector f_before = f;
    f = forces();
    if (!f.allFinite()) return result.reason = Reason::no_number, result;
    const Real work = 0.5 * (f_before + f).dot(du);
    result.released += work;

    unbalanced = model_.supports().unbalanced(f);
    const Real left = unbalanced.norm();
    const Vector taken = (f - unbalanced) - (at_start - model_.supports().unbalanced(at_start));
    result.reference = std::max({result.reference, unbalanced_at_start, taken.norm()});
    energy_reference = std::max({energy_reference, std::abs(f_before.dot(du)), std::abs(taken.dot(moved))});
    result.residual = result.reference > 0 ? left / result.reference : 0;
    const Real floor = model_.noise();
    const bool balanced = left <= limits_.tolerance * result.reference + floor;
    const bool still = du.norm() <= limits_.tolerance * moved.norm();
    const bool spent = std::abs(unbalanced.dot(du)) <= limits_.tolerance * energy_reference;
    if (balanced && ((still && spent) || left <= 1e-3 * limits_.tolerance * result.reference + floor)) return result;

    if (result.iterations > 1 && left > before && left > 10 * floor) {
      if (++growths >= 6) return result.reason = Reason::grows, result;
      if (growths >= 4) slope = Slope::secant;
    }
    if (least < 0 || left < least) least = left;
    forced = ++with_this_factor >= patience || left > slow * std::max(least, limits_.tolerance * result.reference);
    before = left;
  }
  --result.iterations;
  return result.reason = Reason::too_many_iterations, result;
}

}  // namespace beadwork
