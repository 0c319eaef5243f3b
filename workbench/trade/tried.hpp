#pragma once
// What a setting of a deck's knobs has cost, and how far it is off.

#include <string>
#include <vector>

#include "core/deck/deck.hpp"
#include "core/io/result_tables.hpp"
#include "core/plugin/runner.hpp"
#include "workbench/trade/knobs.hpp"

namespace beadwork::trade {

struct Tried {
  std::string name;                       ///< "v=0.2 m/s", "reference", "as it stands"
  std::vector<Override> values;           ///< beside what the deck has
  bool done = false, refused = false;     ///< refused: by its deck
  std::string reason;                     ///< why not; of one that is done, what is to be said of it
  Real seconds = 0;                       ///< in the loop
  std::vector<Real> quantities;           ///< nan where the run has none
  Real error = 0;                         ///< the largest of the quantities', over the reference
  std::vector<std::string> numbers = {};  ///< names of all that the run has
  std::vector<Real> ends = {};            ///< time, and displacements of its curves, at its end
};

/// What is compared, as the columns of a batch's table are called: "force: largest force [N]".
using Quantities = std::vector<std::string>;

/// Those that a run has if the user names none: the largest forces of its curves; of a calibration, the parameters that
/// it has found.
Quantities usual_quantities(const Outcome& outcome);
/// Cost and quantities of a run; errors are still to be told.
Tried tried(const std::string& name, const std::vector<Override>& values, const Outcome& outcome,
            const Quantities& quantities);
/// The largest difference over the reference; infinite for a run that failed.
Real error_of(const Tried& one, const Tried& reference);
/// Whether a run ended at another displacement, or, where there is none, another time than the reference, by 2 percent.
bool ends_elsewhere(const Tried& one, const Tried& reference);
/// Standard deviation of one run over its mean, the largest of the quantities'; 0 for fewer than two.
Real scatter_of(const std::vector<Tried>& seeds);
/// Those that no other beats in both, by their time.
std::vector<const Tried*> front_of(const std::vector<Tried>& all);
/// The fastest of those that are off by so much at most; null if there is none.
const Tried* fastest_within(const std::vector<Tried>& all, Real error);

ResultTable table_of(const std::vector<Tried>& all, const Quantities& quantities, const Tried& base);

}  // namespace beadwork::trade
