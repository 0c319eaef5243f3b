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
constexpr int patience = 20;
constexpr Real slow = 2;

}  // namespace

const char* in_words(Reason reason) {
  switch (reason) {
    case Reason::converged: return "converged";
    case Reason::too_many_iterations: return "too many iterations";
    case Reason::grows: return "the residual grows";
    case Reason::far_away:
      return "something snaps, and the next equilibrium lies far away ('opening' follows bonds that soften)";
    case Reason::outruns_skin: return "an element moves by more than the skin of contacts allows (a wider 'skin' does)";
    case Reason::no_number: return "forces are no numbers";
    case Reason::singular: return "the stiffness is singular";
    case Reason::linear_solver: return "the linear solver did not come to its end";
  }
  return "";
}

/// Holds residual, displacement and energy of an increment against what it does: the change of what supports take and of
/// loads, and a thousandth of what stands, as near a peak the change alone is nothing.
class Newton::Judge {
 public:
  Judge(const StaticModel& model, const Vector& at_start, Real tolerance)
      : model_(model), at_start_(at_start), tolerance_(tolerance), unbalanced_(model.supports().unbalanced(at_start)) {
    taken_before_ = at_start - unbalanced_;
    loads_ = left_ = unbalanced_.norm();
    moved_ = Vector::Zero(at_start.size());
  }

  /// Whether, after a step `du` that has led to these forces, the equilibrium is found.
  bool finds(const Vector& f, const Vector& du) {
    moved_ += du;
    if (first_ < 0) first_ = du.norm();
    unbalanced_ = model_.supports().unbalanced(f);
    left_ = unbalanced_.norm();
    taken_ = f - unbalanced_;
    does_ = std::max({loads_, (taken_ - taken_before_).norm(), 1e-3 * taken_.norm()});
    const Real energy = std::abs(at_start_.dot(moved_)) + std::abs(taken_.dot(moved_));
    const bool still = du.norm() <= tolerance_ * moved_.norm();
    const bool spent = std::abs(unbalanced_.dot(du)) <= tolerance_ * energy;
    return left_ <= allowed() && ((still && spent) || left_ <= 1e-3 * tolerance_ * does_ + floor());
  }
  void tell(NewtonResult& result) const {
    result.reference = does_;
    result.residual = left_ > floor() ? left_ / does_ : 0;
  }
  Real left() const { return left_; }
  Real floor() const { return model_.noise(); }
  /// The least that is asked for, in newtons.
  Real allowed() const { return tolerance_ * does_ + floor(); }
  /// An equilibrium so many times as far away as the first step has it is another one: something has snapped.
  bool is_far() const { return moved_.norm() > 4 * first_; }
  bool is_farther_than_thought() const { return moved_.norm() > 1.5 * first_; }
  /// Half of what the increment's own forces do on its way: of loads, and of supports [J].
  Real energy() const {
    const Vector loads = at_start_ - taken_before_;
    return 0.5 * (std::abs(loads.dot(moved_)) + std::abs((taken_ - taken_before_).dot(moved_)));
  }

 private:
  const StaticModel& model_;
  Vector at_start_;
  Real tolerance_;
  Vector unbalanced_, taken_, taken_before_, moved_;
  Real loads_ = 0, left_ = 0, does_ = 0, first_ = -1;
};

Factored Newton::factor(Slope slope) {
  const SymmetricMatrix* k = nullptr;
  {
    const Timer timer(costs_.stiffness_seconds);
    k = &model_.stiffness(slope);
  }
  const Timer timer(costs_.factor_seconds);
  ++costs_.factors;
  served_ = 0;
  return system_.factor(*k, model_.supports());
}

void Newton::take_factor(const SymmetricMatrix& k, int served) {
  const Timer timer(costs_.factor_seconds);
  served_ = system_.factor(k, model_.supports()).whole ? served : no_factor;
}

bool Newton::renew(Slope slope, NewtonResult& result) {
  const Factored factored = factor(slope);
  if (result.iterations == 1 && slope == Slope::consistent) result.negative = std::max(factored.negative, 0);
  if (factored.weakest >= 0) result.weakest = factored.weakest;  // where nothing asks for it, it stays
  if (!factored.whole) result.reason = Reason::singular;
  return factored.whole;
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

// A step that goes beyond where the forces along it vanish is shortened to about there, so that bonds that open and close by
// turns come to rest. Forces are those of an incremental potential, and so it falls.
void Newton::shorten(Vector& f, Vector& du) {
  constexpr int most = 8;
  const auto along = [&](const Vector& there) { return du.dot(model_.supports().unbalanced(there)); };
  Real low = 0, at_low = along(f), high = 1, part = 1;
  f = forces();
  Real at_high = along(f), here = at_high;
  for (int k = 0; k < most && at_high < 0 && std::abs(here) > 0.5 * std::abs(at_low); ++k) {
    const Real share = std::clamp(at_low / (at_low - at_high), 0.1, 0.9);
    const Real next = low + share * (high - low);
    model_.move((next - part) * du);
    part = next;
    f = forces();
    here = along(f);
    (here < 0 ? high : low) = part;
    (here < 0 ? at_high : at_low) = here;
  }
  du *= part;
}

NewtonResult Newton::go(Real time, Manner manner) {
  const bool careful = manner == Manner::careful, quick = manner == Manner::quick;
  const bool goes_on = time != model_.time();  // at one load something breaks, and may go far
  NewtonResult result;
  model_.begin_trial(time);
  Vector f = forces(), du;
  if (!f.allFinite()) return result.reason = Reason::no_number, result;
  Judge judge(model_, f, limits_.tolerance);
  Real before = judge.left(), least = -1;
  int growths = 0;
  Acceleration acceleration;
  bool forced = !quick || served_ == no_factor || served_ >= patience;

  for (result.iterations = 1; result.iterations <= (careful ? 8 : 1) * limits_.iterations; ++result.iterations) {
    ++costs_.iterations;
    model_.pause();
    if (forced && !renew(careful ? Slope::secant : limits_.slope, result)) return result;
    if (forced) acceleration.forget();
    const Lacking lacking = model_.lacking();
    if (!solve(f, lacking, du)) return result.reason = Reason::linear_solver, result;
    const bool searches = !quick && result.iterations > 1;  // what is prescribed has moved in the first
    if (searches && !careful &&
        du.dot(model_.supports().unbalanced(f)) < 0) {  // uphill: not stable there, and the secant one knows the way
      if (!renew(Slope::secant, result)) return result;
      if (!solve(f, lacking, du)) return result.reason = Reason::linear_solver, result;
    }
    if (quick) du = acceleration.step(du);
    if (!du.allFinite()) return result.reason = Reason::no_number, result;
    model_.move(du);
    if (searches)
      shorten(f, du);
    else
      f = forces();
    if (!f.allFinite()) return result.reason = Reason::no_number, result;

    const bool found = judge.finds(f, du);
    judge.tell(result);
    ++served_;
    if (found && goes_on && judge.is_farther_than_thought() && model_.work_on_the_way() > 3 * judge.energy())
      return result.reason = Reason::far_away, result;
    if (found) return result;

    const Real left = judge.left();
    if (quick && result.iterations > 1 && left > before && left > 10 * judge.floor() && ++growths >= 4)
      return result.reason = Reason::grows, result;
    if (careful && goes_on && judge.is_far()) return result.reason = Reason::far_away, result;
    if (least < 0 || left < least) least = left;
    forced = !quick || served_ >= patience || left > slow * std::max(least, judge.allowed() - judge.floor());
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
  Judge judge(model_, f, limits_.tolerance);
  for (result.iterations = 1; result.iterations <= limits_.iterations; ++result.iterations) {
    ++costs_.iterations;
    model_.pause();
    if (!renew(limits_.slope, result)) return result;
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
    const bool found = judge.finds(f, du);
    judge.tell(result);
    if (found) return result;
  }
  --result.iterations;
  return result.reason = Reason::too_many_iterations, result;
}

}  // namespace beadwork
