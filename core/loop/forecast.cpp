#include "core/loop/forecast.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/failure.hpp"

namespace beadwork {

namespace {

// The time from `began` on at which what is driven has gone that far, by bisection: of one that turns back before it
// is a guess.
std::optional<Real> time_of_displacement(std::span<const Constraint> constraints, Real began, Real wanted,
                                         Real time_step, Real most_steps) {
  Real late = time_step;
  while (driven_displacement(constraints, "", began, began + late) < wanted) {
    if (late >= most_steps * time_step) return std::nullopt;
    late = std::min(2 * late, most_steps * time_step);
  }
  Real early = 0;
  for (int halving = 0; halving < 100; ++halving) {
    const Real middle = 0.5 * (early + late);
    (driven_displacement(constraints, "", began, began + middle) < wanted ? early : late) = middle;
  }
  return late;
}

// A course may be no number later than it is needed, or not be followed that far: then nothing can be foreseen.
std::optional<Real> foreseen_displacement(std::span<const Constraint> constraints, Real began, Real wanted,
                                          Real time_step, Real most_steps) {
  try {
    return time_of_displacement(constraints, began, wanted, time_step, most_steps);
  } catch (const PhysicsFailure&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<Real> steps_of(const Until& until, std::span<const Constraint> constraints, Real began, Real time_step) {
  std::optional<Real> fewest;
  const auto note = [&](Real steps) { fewest = std::min(fewest.value_or(steps), steps); };
  if (until.steps()) note(static_cast<Real>(*until.steps()));
  if (!(time_step > 0)) return fewest;
  if (until.time()) note(std::ceil(*until.time() / time_step));
  if (until.displacement())
    if (const auto time =
            foreseen_displacement(constraints, began, *until.displacement(), time_step, fewest.value_or(1e12)))
      note(std::ceil(*time / time_step));
  return fewest;
}

// Later stages are taken to have the step of the present one.
Headway headway_of(const Scene& scene, const Moment& moment, std::span<const Constraint> constraints) {
  const auto present = static_cast<std::size_t>(moment.stage);
  const Stage& stage = scene.stages[present];
  Headway headway{
      fmt::format("stage '{}'", stage.name),
      fmt::format("step {}, time {:.4g} s, {} breaks", moment.step, moment.time, scene.domain->breaks().breaks.size()),
      {},
      false};
  if (scene.stages.size() > 1) headway.work += fmt::format(" ({} of {})", present + 1, scene.stages.size());
  Real all = static_cast<Real>(moment.stage_step);
  for (std::size_t s = present; s < scene.stages.size(); ++s) {
    const Stage& next = scene.stages[s];
    const auto steps = s == present ? steps_of(*next.until, constraints, moment.stage_start, moment.time_step)
                                    : steps_of(*next.until, next.constraints(), 0, moment.time_step);
    if (!steps) return headway;
    all += *steps;
    headway.at_most |= !next.until->is_foreseeable();
  }
  if (all > 0) headway.share = std::min<Real>(1, static_cast<Real>(moment.step) / all);
  return headway;
}

}  // namespace beadwork
