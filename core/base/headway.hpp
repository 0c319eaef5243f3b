#pragma once
// How far a piece of work has come, told to whoever waits for it.

#include <functional>
#include <optional>
#include <string>

#include "core/base/types.hpp"

namespace beadwork {

struct Headway {
  std::string
      work;  ///< what is being done: "filling 'matrix'", "stage 'pull'"; its time to go is found anew when it changes
  std::string detail;         ///< where it stands: "step 1200, 3 breaks"
  std::optional<Real> share;  ///< of the work that is done, 0 to 1; nothing where nobody can know
  bool at_most = false;       ///< the work may end sooner, by a condition
};

/// Called now and then in long work, as often as is convenient: whoever shows it takes what it needs.
using TellHeadway = std::function<void(const Headway&)>;

}  // namespace beadwork
