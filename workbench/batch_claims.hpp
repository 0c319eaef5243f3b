#pragma once
// What a study expects of its runs, held beside what they have found: claims.csv and figures.json of a batch.

#include "core/plugin/batch_plan.hpp"
#include "workbench/batch.hpp"

namespace beadwork {

/// Places of the chosen runs among all.
std::vector<std::size_t> runs_chosen(const ChosenRuns& chosen, const std::vector<BatchRun>& runs);

/// DeckFailure if a claim or a figure speaks of a sweep, or of values, that no run has; if a claim's runs differ in more
/// than seeds, or one of them has not one run beside it.
void refuse_claims_of_none(const BatchPlan& plan, const std::vector<BatchRun>& runs);

/// Each claim, what was printed, its band, mean and scatter over the runs that gave a number, how many of how many that
/// are, and whether it holds.
ResultTable claims_table(const std::vector<ClaimPlan>& claims, const std::vector<BatchRun>& runs);

/// claims.csv and figures.json, where the study has any or had some before. Somebody else's files there are told before
/// hours of runs.
class ClaimFiles {
 public:
  ClaimFiles(const BatchPlan& plan, OwnFolder& folder);
  /// And says what came of the claims.
  void write(const std::vector<BatchRun>& runs) const;

 private:
  const BatchPlan& plan_;
  std::filesystem::path claims_, figures_;  // empty: none
};

}  // namespace beadwork
