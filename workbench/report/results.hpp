#pragma once
// What a run has found, as names and numbers.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace beadwork {

/// ("force: largest force [N]", "62.99"), ...
using Results = std::vector<std::pair<std::string, std::string>>;

/// What summary.json and the curves of a run that has ended say.
Results results_of(const std::filesystem::path& folder);

}  // namespace beadwork
