#pragma once
// The report of a run: one HTML file that needs nothing else, made from whatever the run left in its folder.

#include <cstddef>
#include <filesystem>
#include <string>

namespace beadwork::report {

/// Writes report.html into the folder and returns its path. Works on runs that are done, failed, interrupted or were
/// killed; what is missing is said in the report. Throws MachineFailure if there is no run or the file cannot be written.
std::string write_report(const std::filesystem::path& run_folder);

}  // namespace beadwork::report
