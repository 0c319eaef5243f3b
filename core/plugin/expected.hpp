#pragma once
// What is expected of the runs of a batch, or was published, and figures that show several of them.

#include <string>
#include <vector>

#include "core/deck/deck.hpp"
#include "core/plugin/reading.hpp"

namespace beadwork {

/// Runs of a batch: those of a sweep that have one of these values of each of these parameters.
struct ChosenRuns {
  struct Wanted {
    std::string parameter;
    std::vector<std::string> values;
  };
  std::string sweep;
  std::vector<Wanted> where;  ///< empty: all of them
  Location at;
};

/// A number that is read from each of some runs, beside what was printed and where it should lie.
struct ClaimPlan {
  std::string name, says, source;
  ChosenRuns of;
  std::string curve;  ///< empty: `column` of the batch's table
  Reading reading;
  std::string column;                ///< without its unit
  std::optional<Reading> over;       ///< divides it, read from the same curve of the same run
  std::optional<ChosenRuns> beside;  ///< divides it, the same read from those of these runs that have the same seeds
  std::optional<Amount> times;       ///< a factor
  std::string printed;               ///< as text: "42 mN", "about 3 %"
  std::optional<Amount> from, to;    ///< the band
};

/// Curves of some runs laid over one another, or pictures of one.
struct FigurePlan {
  std::string name, says;
  ChosenRuns of;
  std::string curve;  ///< empty: pictures
};

}  // namespace beadwork
