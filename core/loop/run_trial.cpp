#include "core/loop/run.hpp"

namespace beadwork {

Trial Run::trial(Real seconds) {
  const auto since = [](Clock::time_point start) { return std::chrono::duration<Real>(Clock::now() - start).count(); };
  watched_ = false;
  const auto begin = Clock::now();
  fill();
  enter(stage(), false);
  Trial trial;
  trial.fill_seconds = since(begin);
  trial.time_step = moment_.time_step;
  trial.limited_by = stage().mover().limited_by();
  const auto start = Clock::now();
  while (!over() && since(start) < seconds) {
    step();
    ++trial.steps;
  }
  trial.seconds_per_step = trial.steps > 0 ? since(start) / trial.steps : 0;
  return trial;
}

}  // namespace beadwork
