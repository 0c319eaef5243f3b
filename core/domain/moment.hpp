#pragma once
// Where a run stands.

#include <cstdint>

#include "core/base/types.hpp"

namespace beadwork {

struct Moment {
  Real time = 0;  ///< [s]
  std::int64_t step = 0;
  Real time_step = 0;  ///< [s]
  int stage = 0;
  Real stage_start = 0;         ///< [s]
  std::int64_t stage_step = 0;  ///< step at which the stage began
};

}  // namespace beadwork
