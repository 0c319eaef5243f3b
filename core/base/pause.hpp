#pragma once
// Long work that its user may want to stop.

#include <functional>

namespace beadwork {

/// Called now and then in long work, never from several threads at once: what it throws ends the work.
using Pause = std::function<void()>;

inline const Pause never_paused = [] {};

}  // namespace beadwork
