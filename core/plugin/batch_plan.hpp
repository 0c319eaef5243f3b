#pragma once
// What the plugins of a study say of a batch before any run of it has begun.

#include "core/plugin/expected.hpp"
#include "core/plugin/run_list.hpp"

namespace beadwork {

struct BatchPlan {
  std::vector<RunList> lists;
  std::vector<ClaimPlan> claims;
  std::vector<FigurePlan> figures;
};

}  // namespace beadwork
