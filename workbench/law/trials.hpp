#pragma once
// All modes of all families: searched first, for where a bond bears most and where it fails, then taken through cycles.

#include <functional>

#include "workbench/law/response.hpp"
#include "workbench/law/stated.hpp"

namespace beadwork::law {

/// One mode of one family, and what came of it.
struct Trial {
  const Family* family;
  Pair pair;
  Mode mode;
  std::string name;  ///< of its deck and its curve: "glue-tension"
  Real stated = 0;   ///< stiffness that the law states at rest
  Found found = {};  ///< by the search
  Response cycles = {};
  Figures figures = {};
  bool bears_nothing = false;  ///< beside what the family bears in another mode
  ExitCode code = ExitCode::done;
  std::string failure = {};  ///< why it could not be run
};

/// What trials are lent.
struct TrialDesk {
  const Scene& scene;
  Runner& runner;
  std::vector<std::string> libraries;
  std::function<std::filesystem::path(const std::string& name, std::string_view text)> write;
};

std::vector<Trial> trials_of(const std::vector<Family>& families, const std::vector<Pair>& pairs, const Reach& reach);

void run(std::vector<Trial>& trials, const TrialDesk& desk);

}  // namespace beadwork::law
