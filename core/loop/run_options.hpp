#pragma once
// How a run is to be done, beside what its deck says.

#include <atomic>
#include <string>

#include "core/base/headway.hpp"
#include "core/base/log.hpp"
#include "core/base/types.hpp"

namespace beadwork {

/// What the user can paste into a shell.
struct Commands {
  std::string go_on;        ///< from the newest checkpoint
  std::string begin_again;  ///< over what has been written
};

struct RunOptions {
  int threads = 1;
  bool resume = false;
  Commands commands;
  Real checkpoint_seconds = 600;                ///< wall time between checkpoints
  Real first_checkpoint_seconds = 60;           ///< until the first one, where that is less
  const std::atomic<int>* interrupt = nullptr;  ///< not zero: write a checkpoint and stop
  Log log;
  TellHeadway progress = [](const Headway&) {};

  bool is_interrupted() const { return interrupt && *interrupt; }
};

}  // namespace beadwork
