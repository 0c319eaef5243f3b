// A run that is begun to see what it costs.

#include <algorithm>

#include "core/loop/filling.hpp"
#include "core/loop/run.hpp"

namespace beadwork {

Trial Run::trial(Real seconds) {
  const auto begin = Clock::now();
  fill(state_, options_, record_.figures().packing_reports);
  begin_stage();
  looks_.pass();
  Trial trial;
  trial.fill_seconds = std::chrono::duration<Real>(Clock::now() - begin).count();
  trial.time_step = state_.moment.time_step;
  trial.limited_by = state_.mover().limited_by();
  record_.open();
  trial.seconds_per_step = try_steps(seconds, trial.steps);
  for (Watcher* watcher : state_.stage().watchers) trial.seconds_per_look.emplace_back(watcher, try_looks(*watcher));
  return trial;
}

// The first look opens files, so that it tells little of the others; a step comes between two, as no moment is recorded
// twice, be it one beyond the end of the stage.
Real Run::try_looks(Watcher& watcher) {
  std::vector<Real> taken;
  for (int look = 0; look < 4; ++look) {
    if (look > 0) advance();
    const auto start = Clock::now();
    fresh_.outdate();
    looks_.show_to(watcher);
    taken.push_back(std::chrono::duration<Real>(Clock::now() - start).count());
  }
  taken.erase(taken.begin());
  std::sort(taken.begin(), taken.end());
  return taken[taken.size() / 2];
}

// Median over blocks of a twentieth of the time: whatever else the machine does now and then does not count.
Real Run::try_steps(Real seconds, int& steps) {
  std::vector<Real> blocks;
  const auto start = Clock::now();
  auto now = start;
  while (now - start < std::chrono::duration<Real>(seconds) && !over()) {
    const auto block = now;
    int done = 0;
    do {
      advance();
      looks_.pass();
      ++done;
      now = Clock::now();
    } while (now - block < std::chrono::duration<Real>(seconds / 20) && !over());
    blocks.push_back(std::chrono::duration<Real>(now - block).count() / done);
    steps += done;
  }
  if (blocks.empty()) return 0;
  std::nth_element(blocks.begin(), blocks.begin() + static_cast<std::ptrdiff_t>(blocks.size() / 2), blocks.end());
  return blocks[blocks.size() / 2];
}

}  // namespace beadwork
