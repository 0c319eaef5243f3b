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
// An equilibrium so many times as far away as the first stiffness has it is another one: something has snapped.
constexpr Real far = 4;

}  // namespace

const char* in_words(Reason reason) {
  switch (reason) {
    case Reason::converged: return "converged";
    case Reason::too_many_iterations: return "too many iterations";
    case Reason::grows: return "the residual grows";
    case Reason::far_away: return "the next equilibrium lies far away (snap-back: 'opening' follows it)";
    case Reason::no_number: return "forces are no numbers";
    case Reason::singular: return "the stiffness is singular";
    case Reason::linear_solver: return "the linear solver did not come to its end";
  }
  return "";
}

// The change of what supports take and of loads, and a thousandth of what stands: near a peak the change alone is nothing.
Real Newton::what_it_does(const Vector& f, const Vector& unbalanced, const Vector& at_start, Real loads) const {
  const Vector before = at_start - model_.supports().unbalanced(at_start), now = f - unbalanced;
  return std::max({loads, (now - before).norm(), 1e-3 * now.norm()});
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

NewtonResult Newton::go(Real time, Manner manner) {
  const bool careful = manner == Manner::careful, quick = manner == Manner::quick;
  const Slope slope = careful ? Slope::secant : limits_.slope;
  const bool goes_on = time != model_.time();  // at one load something breaks, and may go far
  NewtonResult result;
  model_.begin_trial(time);
  Vector f = forces();
  if (!f.allFinite()) return result.reason = Reason::no_number, result;
  const Vector at_start = f;
  Vector unbalanced, du, moved = Vector::Zero(f.size());
  const Real loads = model_.supports().unbalanced(f).norm();
  Real before = loads, least = -1, first = -1;
  int growths = 0, with_this_factor = 0;
  Acceleration acceleration;
  bool forced = !quick || stale_ || !system_.is_factored();

  for (result.iterations = 1; result.iterations <= (careful ? 8 : 1) * limits_.iterations; ++result.iterations) {
    ++costs_.iterations;
    if (forced) {
      const Factored factored = factor(slope);
      forced = false;
      with_this_factor = 0;
      acceleration.forget();
      if (factored.weakest >= 0) result.weakest = factored.weakest;  // where nothing asks for it, it stays
      if (!factored.whole) return result.reason = Reason::singular, result;
    }
    if (!solve(f, model_.lacking(), du)) return result.reason = Reason::linear_solver, result;
    if (quick) du = acceleration.step(du);
    if (!du.allFinite()) return result.reason = Reason::no_number, result;
    model_.move(du);
    moved += du;
    f = forces();
    if (!f.allFinite()) return result.reason = Reason::no_number, result;

    unbalanced = model_.supports().unbalanced(f);
    const Real left = unbalanced.norm();
    result.reference = what_it_does(f, unbalanced, at_start, loads);
    const Real energy_reference = std::abs(at_start.dot(moved)) + std::abs((f - unbalanced).dot(moved));
    const Real floor = model_.noise();
    result.residual = left > floor ? left / result.reference : 0;
    const bool balanced = left <= limits_.tolerance * result.reference + floor;
    const bool still = du.norm() <= limits_.tolerance * moved.norm();
    const bool spent = std::abs(unbalanced.dot(du)) <= limits_.tolerance * energy_reference;
    if (first < 0) first = du.norm();
    if (balanced && ((still && spent) || left <= 1e-3 * limits_.tolerance * result.reference + floor)) {
      if (goes_on && moved.norm() > far * first) result.reason = Reason::far_away;
      return result;
    }

    if (quick && result.iterations > 1 && left > before && left > 10 * floor && ++growths >= 4)
      return result.reason = Reason::grows, result;
    if (careful && goes_on && moved.norm() > far * first) return result.reason = Reason::far_away, result;
    if (least < 0 || left < least) least = left;
    forced =
        !quick || ++with_this_factor >= patience || left > slow * std::max(least, limits_.tolerance * result.reference);
    before = left;
  }
  --result.iterations;
  return result.reason = Reason::too_many_iterations, result;
}

// Each iteration solves twice: for what is unbalanced, and for what a second of the loads' course would bring; of that as
// much is taken as the controlled quantity wants.
NewtonResult Newton::go_by(const Vector& gradient, Real value) {
  NewtonResult result;
  Vector f = forces();
  const Vector at_start = f;
  for (result.iterations = 1; result.iterations <= limits_.iterations; ++result.iterations) {
    ++costs_.iterations;
    const Factored factored = factor(limits_.slope);
    if (factored.weakest >= 0) result.weakest = factored.weakest;
    if (!factored.whole) return result.reason = Reason::singular, result;
    Vector du, per_second;
    if (!solve(f, model_.lacking(), du) || !solve(model_.force_rates(), model_.support_rates(), per_second))
      return result.reason = Reason::linear_solver, result;
    const Real pace = gradient.dot(per_second);
    const Real seconds = (value - gradient.dot(model_.moved()) - gradient.dot(du)) / pace;
    if (!std::isfinite(seconds)) return result.reason = Reason::singular, result;
    du += seconds * per_second;
    model_.begin_trial(model_.time() + seconds);
    model_.move(du);
    f = forces();
    if (!f.allFinite()) return result.reason = Reason::no_number, result;
    const Vector unbalanced = model_.supports().unbalanced(f);
    result.reference = what_it_does(f, unbalanced, at_start, 0);
    const Real floor = model_.noise();
    result.residual = unbalanced.norm() > floor ? unbalanced.norm() / result.reference : 0;
    const bool still = du.norm() <= limits_.tolerance * model_.moved().norm();
    if (unbalanced.norm() <= limits_.tolerance * result.reference + floor &&
        (still || unbalanced.norm() <= 1e-3 * limits_.tolerance * result.reference + floor))
      return result;
  }
  --result.iterations;
  return result.reason = Reason::too_many_iterations, result;
}

}  // namespace beadwork
