// What a batch would do.

#include <fmt/format.h>

#include "core/base/text.hpp"
#include "workbench/batch.hpp"

namespace beadwork {

namespace {

std::string state_of(const BatchRun& run) {
  if (run.done) return "done";
  if (run.refused) return "refused";
  return run.outdated ? "to be run, with other data files than before" : "to be run";
}

/// What is still to be done before it.
std::string wait_of(const BatchRun& run, const std::vector<BatchRun>& all) {
  constexpr std::size_t most_names = 2;
  std::vector<std::string> names;
  for (const std::size_t need : run.needs)
    if (!all[need].done) names.push_back("'" + all[need].name + "'");
  if (run.done || names.empty()) return "";
  if (names.size() > most_names) return fmt::format(", after {} others", names.size());
  return ", after " + join(names, " and ");
}

}  // namespace

std::string outlook_on(const std::vector<BatchRun>& runs) {
  constexpr std::size_t most_shown = 200;
  std::string text;
  for (std::size_t k = 0; k < runs.size() && k < most_shown; ++k)
    text += fmt::format("{}: {}{}{}\n", runs[k].name, state_of(runs[k]), wait_of(runs[k], runs),
                        runs[k].postponed ? "; its deck can only be read then" : "");
  if (runs.size() > most_shown) text += fmt::format("... and {} more\n", runs.size() - most_shown);
  return text;
}

}  // namespace beadwork
