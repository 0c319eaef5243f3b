#pragma once
// What a study expected of its runs, and the figures that it asked for. Empty texts where it did not.

#include <filesystem>
#include <string>

namespace beadwork::report {

std::string claims_of(const std::filesystem::path& batch);
std::string figures_of(const std::filesystem::path& batch);

}  // namespace beadwork::report
