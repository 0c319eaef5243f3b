#pragma once
// Runs that are known before any of them has begun: decks, and values of their parameters.

#include <string>
#include <utility>
#include <vector>

#include "core/deck/deck.hpp"

namespace beadwork {

struct RunList {
  std::string name;  ///< also that of the folder of its runs
  Location at;
  std::vector<std::string> decks;              ///< paths; each is run with all rows
  std::vector<std::string> parameters;         ///< that vary
  std::vector<std::vector<std::string>> rows;  ///< their values, one row for a run
  std::vector<Override> fixed;                 ///< of all its runs
  /// Parameters that are the folder of another list's runs: ("packings", "packings"). A run begins once those of the other
  /// list are done that have the same values of the parameters that both vary.
  std::vector<std::pair<std::string, std::string>> from;
  std::vector<std::string> after;  ///< lists that are waited for likewise
};

}  // namespace beadwork
