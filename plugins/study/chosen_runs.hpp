#pragma once
// Which runs of a study a plugin speaks of.

#include "core/plugin/batch_plan.hpp"
#include "core/plugin/kinds.hpp"
#include "plugins/study/sweep_values.hpp"

namespace beadwork::sweeps {

/// "deck = fine, coarse; ratio = 2".
inline std::vector<ChosenRuns::Wanted> wanted_of(const std::string& text) {
  std::vector<ChosenRuns::Wanted> all;
  for (const Clause& clause : clauses(text)) {
    ChosenRuns::Wanted wanted{clause.name, {}};
    for (const std::string& value : split(clause.what, ',')) wanted.values.emplace_back(trim(value));
    all.push_back(std::move(wanted));
  }
  return all;
}

/// Complains of a text of clauses that is none.
inline void understand_clauses(const Param<std::string>& text, Complaints& complaints) {
  if (!text.given()) return;
  try {
    clauses(*text);
  } catch (const Wrong& wrong) {
    complaints.error(text.at(), "'" + text.info().name + "' " + wrong.what());
  }
}

}  // namespace beadwork::sweeps
