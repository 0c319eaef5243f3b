#include "core/statics/course.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/failure.hpp"
#include "core/base/memory.hpp"
#include "core/base/text.hpp"
#include "core/statics/event.hpp"

namespace beadwork {

Course::Course(Workings& w, CourseChoices choices, const StaticRows& elements, const CourseRows& rows,
               const KeptStiffness::Rows& kept)
    : w_(w),
      choices_(std::move(choices)),
      rows_(rows),
      model_(w, elements),
      system_(linear_solver(choices_.solver)),
      newton_(model_, system_, choices_.limits),
      kept_(w.domain(), kept) {}

void Course::begin() {
  const Real memory = analyse();
  note_breaks(false);
  const SceneModel::Noise here = model_.noise_here();
  rows_.noise[0] = here.force, rows_.energy_noise[0] = here.energy;
  model_.take_noise(here.force);
  w_.next_moment(w_.moment().time);  // from now on moments are met exactly
  kept_.begin(model_.pattern());
  hold();
  rows_.share[0] = 1, rows_.used[0] = 0, rows_.does[0] = 0;
  model_.stand_still();
  w_.evaluate(false);
  model_.react(false);
  w_.moment().time_step = choices_.next_time(1) - w_.moment().time;
  w_.log().say(fmt::format(
      "statics: {} unknowns{}; {} elements that nothing binds are held where they are", model_.supports().fixed.size(),
      memory > 0 ? fmt::format(", whose stiffness and factor take {:.3g} MB", memory / 1e6) : "", model_.loose()));
}

void Course::resume() {
  analyse();
  note_breaks(true);
  model_.take_noise(rows_.noise[0]);
  w_.next_moment(w_.moment().time);
  model_.support_as_before();
  kept_.resume(newton_, model_.pattern(), model_.supports());
}

// Those of the step that was accepted last have not been heeded.
void Course::note_breaks(bool resumed) {
  const auto& breaks = w_.domain().breaks().breaks;
  seen_breaks_ = static_cast<std::size_t>(std::count_if(
      breaks.begin(), breaks.end(), [&](const Break& b) { return !resumed || b.step < w_.moment().step; }));
}

void Course::step() {
  heed_changes();
  ++w_.moment().step;
  const bool begins = w_.moment().step == w_.moment().stage_step + 1;
  if ((broke_ || begins) && is_out_of_balance())
    settle();
  else
    advance();
  model_.accept();
  kept_.note(newton_, system_, model_.supports());
  heed_burden();
  if (begins) heed_rounding();
}

std::vector<MoverFigure> Course::figures() const {
  const NewtonCosts& costs = newton_.costs();
  return {{"unknowns", static_cast<Real>(model_.supports().fixed.size())},
          {"iterations", rows_.spent[0]},
          {"cuts", rows_.cuts[0]},
          {"careful_increments", rows_.carefully[0]},
          {"events", rows_.events[0]},
          {"worst_residual", rows_.worst[0]},
          {"negative_pivots", rows_.negative[0]},
          {"pins_bear", rows_.borne[0]},
          {"factors", static_cast<Real>(costs.factors)},
          {"factor_seconds", costs.factor_seconds},
          {"stiffness_seconds", costs.stiffness_seconds},
          {"force_seconds", costs.force_seconds},
          {"solve_seconds", costs.solve_seconds},
          {"loose_elements", static_cast<Real>(model_.loose())}};
}

// Before a factor is allocated it is known how large it will be.
Real Course::analyse() {
  newton_.forget_factor();
  const Real memory = system_.analyse(model_.take_pairs());
  if (memory > memory_at_most())
    refuse(choices_.at,
           fmt::format("the factor of the stiffness of {} unknowns takes {:.3g} GB, and there are {:.3g} GB: fewer "
                       "elements, or solver=\"conjugate-gradients\" with slope=\"secant\", which takes a "
                       "tenth",
                       model_.unknowns(), memory / 1e9, memory_at_most() / 1e9));
  return memory;
}

// What is free is pinned where the deck asks for it, and where a break has made it so.
void Course::hold() {
  const bool broken = !w_.domain().breaks().breaks.empty();
  const auto free = model_.support(broken || choices_.pins_free);
  if (free.empty()) return;
  if (!broken && !choices_.pins_free) {
    const FreeBody& body = free.front();
    const auto id = w_.domain().elements().column("id").view<Index>();
    refuse(choices_.at,
           fmt::format("nothing holds a body of {} elements, of which element {} is one, against this: it can {}{}; "
                       "hold it (a mean is enough: grip=\"mean\"), or free=\"pin\" keeps it where it is; what contacts "
                       "press on at the start "
                       "counts as held",
                       body.members.size(), id[body.members.front()], join(names_of(body.modes), ", "),
                       free.size() > 1 ? fmt::format("; so can {} others in some way", free.size() - 1) : ""));
  }
  w_.log().say_once(fmt::format("pinned {}", free.size()),
                    fmt::format("step {}: {} bodies that no load holds are pinned where they are, as few motions as "
                                "they are free to make",
                                w_.moment().step, free.size()));
}

void Course::heed_changes() {
  const std::size_t breaks = w_.domain().breaks().breaks.size();
  broke_ = breaks != seen_breaks_;
  seen_breaks_ = breaks;
  const bool meets = model_.has_other_pairs();
  if (meets) analyse();
  if (broke_ || meets) hold();  // what was loose may touch something now
  kept_.heed(newton_, model_.supports());
}

// Forces are known to the rounding of places alone, times what is stiffest; less than that is in balance with anything.
void Course::heed_rounding() {
  constexpr Real known = 1e3;
  const Real now = w_.moment().time;
  const Vector after = model_.forces();
  w_.moment().time = now - w_.moment().time_step;
  const Real asked = (after - model_.forces()).norm();  // nothing has moved in between: loads alone change with time
  w_.moment().time = now;
  model_.forces();
  if (!(asked > 0 && asked < known * model_.noise())) return;
  w_.log().warn(fmt::format(
      "{}: the loads change forces by {:.2g} N, which are known to {:.2g} N only, as places are rounded and the "
      "stiffest bonds feel it: what is soft moves less than it should; soften what is stiffest, or load more",
      choices_.at.where(), asked, model_.noise()));
}

// What is pinned because nothing holds it bears nothing where it is in equilibrium.
void Course::heed_burden() {
  constexpr Real too_much = 0.05, noticed = 1e-3;  // of what all supports take
  const SceneModel::Burden burden = model_.burden();
  rows_.borne[0] = std::max(rows_.borne[0], burden.share);
  if (burden.share <= noticed) return;
  const std::string what = fmt::format(
      "step {}: element {}, which no load and no bond holds, is under a force of {:.3g} N {}", w_.moment().step,
      w_.domain().elements().column("id").view<Index>()[model_.element_of(burden.unknown)], burden.force,
      model_.axis_of(burden.unknown));
  if (burden.share > too_much && !choices_.pins_free)
    throw PhysicsFailure(
        fmt::format("{}: {}: there is no equilibrium; end the stage when something breaks "
                    "(until=\"force of ... < ...\"), or go on with inertia: <verlet>",
                    choices_.at.where(), what));
  w_.log().say_once("burden", fmt::format("{}, {:.2g} % of what supports take: a pin bears it, which a real body would "
                                          "not find",
                                          what, 100 * burden.share));
}

// What broke pulls at the supports no more. Contacts that have opened by themselves leave nothing out of balance; what a
// criterion fells does.
bool Course::is_out_of_balance() {
  const Vector f = model_.forces();
  model_.react(false);
  return model_.supports().unbalanced(f).norm() > choices_.limits.tolerance * rows_.does[0] + model_.noise();
}

/// The equilibrium at the present loads, once something has broken, or where a stage begins with loads on it.
void Course::settle() {
  const NewtonResult result = within_reach(go(w_.moment().time));
  if (!result.converged()) fail(result, 0);
  rows_.events[0] += 1;
  rows_.released[0] += model_.work_on_the_way();
  rows_.does[0] = std::max(result.reference, rows_.does[0]);
  rows_.worst[0] = std::max(rows_.worst[0], result.residual);
  rows_.used[0] = std::min<Real>(1, w_.utilisation());
}

/// The next increment, cut until there is an equilibrium, and to where something breaks.
void Course::advance() {
  IncrementShare tried(rows_.share[0], choices_.smallest);
  const Real from = w_.moment().time;
  if (choices_.opening && advance_by_opening(tried, true)) return;
  for (;;) {
    const Real to = choices_.next_time(tried.share());
    NewtonResult result = within_reach(go(to));
    if (result.converged()) {
      tried.grow(result.iterations, choices_.limits.iterations);
      stop_at_event(from, to, result);
      rows_.does[0] = std::max(result.reference, rows_.does[0]);
      rows_.worst[0] = std::max(rows_.worst[0], result.residual);
      return;
    }
    model_.give_up();
    newton_.forget_factor();
    if (choices_.opening && advance_by_opening(tried, false)) return;
    if (!tried.cut()) fail(result, to - from);
    note_cut(tried, result);
  }
}

void Course::stop_at_event(Real from, Real to, NewtonResult& result) {
  const Real after = w_.utilisation();
  if (!(after > 1 + choices_.within)) {
    rows_.used[0] = after;
    return;
  }
  EventSearch search(std::min<Real>(rows_.used[0], 1), after, choices_.within);
  for (int round = 0; round < EventSearch::most_rounds; ++round) {
    const Real part = search.next();
    model_.give_up();
    result = go(from + part * (to - from));
    if (!result.converged()) fail(result, part * (to - from));
    const Real utilisation = w_.utilisation();
    rows_.used[0] = std::min<Real>(1, utilisation);
    if (search.take(part, utilisation)) return;
  }
  throw PhysicsFailure(
      fmt::format("step {}: the load at which something breaks could not be found: the utilisation "
                  "does not follow the load; a smaller increment, or a larger 'within'",
                  w_.moment().step));
}

/// A step in which bonds open by what the deck says. False where none of them opens, or where loads would go further
/// than an increment.
bool Course::advance_by_opening(IncrementShare& tried, bool softening_only) {
  const auto gradient = model_.opening(choices_.opening_of, softening_only);
  if (!gradient) return false;
  const Real from = w_.moment().time, longest = choices_.next_time(1);
  for (;;) {
    newton_.forget_factor();
    const NewtonResult result = within_reach(newton_.go_by(*gradient, tried.share() * *choices_.opening));
    rows_.spent[0] += result.iterations;
    warn(result);
    if (result.converged()) {
      if (w_.moment().time > longest) return model_.give_up(), false;
      w_.moment().time_step = w_.moment().time - from;
      tried.grow(result.iterations, choices_.limits.iterations);
      rows_.worst[0] = std::max(rows_.worst[0], result.residual);
      rows_.used[0] = w_.utilisation();
      return true;
    }
    model_.give_up();
    if (!tried.cut()) {
      if (!softening_only) fail(result, 0);
      rows_.share[0] = 1;  // loads may yet lead on
      return false;
    }
    note_cut(tried, result);
  }
}

NewtonResult Course::go(Real to) {
  const bool goes_on = to != w_.moment().time;
  w_.moment().time_step = to - w_.moment().time;
  NewtonResult result;
  for (const Manner manner : {Manner::quick, Manner::thorough, Manner::careful}) {
    if (manner == Manner::careful && choices_.opening && goes_on) break;  // it knows another way
    if (manner != Manner::quick) model_.give_up(), w_.moment().time_step = to - w_.moment().time;
    result = newton_.go(to, manner);
    rows_.spent[0] += result.iterations;
    const bool done = result.converged() || result.reason == Reason::singular;
    if (manner == Manner::careful) rows_.carefully[0] += 1;
    if (!done || manner == Manner::careful) newton_.forget_factor();  // the secant one is none to go on with
    if (done) break;
  }
  warn(result);
  return result;
}

NewtonResult Course::within_reach(NewtonResult result) const {
  if (result.converged() && model_.farthest() > w_.reach()) result.reason = Reason::outruns_skin;
  return result;
}

void Course::warn(const NewtonResult& result) {
  if (result.negative > 0) {
    rows_.negative[0] = std::max(rows_.negative[0], static_cast<Real>(result.negative));
    w_.log().say_once("unstable",
                      fmt::format("step {}: {} pivots of the stiffness are negative at the last equilibrium: it is not "
                                  "stable, or a snap or a bifurcation lies near; which way a real body takes, its "
                                  "imperfections decide",
                                  w_.moment().step, result.negative));
  }
  if (result.converged() && result.weakest >= 0)
    w_.log().say_once("mechanism",
                      fmt::format("step {}: {}; no load asks for it, and it stays", w_.moment().step, told(result)));
}

void Course::note_cut(const IncrementShare& tried, const NewtonResult& result) {
  rows_.cuts[0] += 1;
  w_.log().say(
      fmt::format("step {}: increment cut to {:.3g} of the whole: {}", w_.moment().step, tried.share(), told(result)));
}

std::string Course::told(const NewtonResult& result) const {
  std::string words = fmt::format("{} after {} iterations, residual {:.2g}", in_words(result.reason), result.iterations,
                                  result.residual);
  if (result.weakest >= 0)
    words += fmt::format("; nothing resists a motion of element {} {}",
                         w_.domain().elements().column("id").view<Index>()[model_.element_of(result.weakest)],
                         model_.axis_of(result.weakest));
  return words;
}

void Course::fail(const NewtonResult& result, Real step) {
  model_.give_up();
  throw PhysicsFailure(fmt::format("{}: step {}: no equilibrium was found {} s further: {}", choices_.at.where(),
                                   w_.moment().step, step, told(result)));
}

}  // namespace beadwork
