#include "workbench/law/trials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"

namespace beadwork::law {

namespace {

// Takes the outcome of a scene, if it came to its end.
Response taken(Trial& trial, const Outcome& outcome) {
  if (outcome.is_done()) return response_of(outcome, trial.mode);
  trial.code = outcome.code;
  trial.failure = outcome.reason;
  return {};
}

std::string told(const Trial& trial) {
  return fmt::format("One bond of family '{}' in {}, made by beadwork law.", trial.family->name, trial.mode.name);
}

void search(std::vector<Trial>& trials, const TrialDesk& desk) {
  std::vector<Errand> errands;
  for (Trial& trial : trials) {
    const std::string name = trial.name + "-search";
    const auto deck =
        desk.write(name + ".xml",
                   pair_deck(desk.scene, *trial.family, trial.mode, trial.pair, search_course(trial.mode, trial.pair),
                             name, told(trial) + " Ever further, for where it bears most and where it fails."));
    errands.push_back({name, deck});
    try {
      trial.stated = stated_stiffness({deck.string(), {}, desk.libraries}, *trial.family, trial.mode);
    } catch (const DeckFailure&) {  // of a law that does not stand alone; its run says why
    }
  }
  const std::vector<Outcome> outcomes = desk.runner.run(errands);
  for (std::size_t k = 0; k < trials.size(); ++k) {
    trials[k].found = found_in(taken(trials[k], outcomes[k]), trials[k].pair.scale(trials[k].mode));
    if (trials[k].family->is_contact) trials[k].found.softens = false;  // it slips, or leaves: it does not fail
  }
}

// A rounding of nothing is no response: against a force, what turns is seen at the distance of the centres.
void see_what_bears_nothing(std::vector<Trial>& trials) {
  const auto force = [](const Trial& trial) {
    return std::abs(trial.found.peak) / (trial.mode.is_turn() ? trial.pair.distance() : 1);
  };
  std::map<const Family*, Real> most;
  for (const Trial& trial : trials) most[trial.family] = std::max(most[trial.family], force(trial));
  for (Trial& trial : trials) trial.bears_nothing = force(trial) <= 1e-9 * most[trial.family];
}

void cycle(std::vector<Trial>& trials, const TrialDesk& desk) {
  std::vector<Errand> errands;
  std::vector<Trial*> of_errands;
  for (Trial& trial : trials) {
    if (trial.bears_nothing || !trial.failure.empty()) continue;
    const auto course = cycles_course(amplitudes(trial.found, trial.mode, trial.pair));
    const auto deck =
        desk.write(trial.name + ".xml", pair_deck(desk.scene, *trial.family, trial.mode, trial.pair, course, trial.name,
                                                  told(trial) + " Forth and back, further each time."));
    errands.push_back({trial.name, deck});
    of_errands.push_back(&trial);
  }
  const std::vector<Outcome> outcomes = desk.runner.run(errands);
  for (std::size_t k = 0; k < outcomes.size(); ++k) {
    Trial& trial = *of_errands[k];
    trial.cycles = taken(trial, outcomes[k]);
    trial.figures = figures_of(trial.cycles);
  }
}

}  // namespace

std::vector<Trial> trials_of(const std::vector<Family>& families, const std::vector<Pair>& pairs, const Reach& reach) {
  std::vector<Trial> trials;
  for (std::size_t k = 0; k < families.size(); ++k)
    for (const Mode& mode : modes_of(families[k], reach))
      trials.push_back({.family = &families[k],
                        .pair = pairs[k],
                        .mode = mode,
                        .name = as_file_name(families[k].name) + "-" + mode.name});
  return trials;
}

void run(std::vector<Trial>& trials, const TrialDesk& desk) {
  search(trials, desk);
  see_what_bears_nothing(trials);
  cycle(trials, desk);
}

}  // namespace beadwork::law
