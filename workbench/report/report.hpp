#pragma once
// The report of a run: one HTML file that needs nothing else, made from whatever the run left in its folder.

#include <cstddef>
#include <filesystem>
#include <string>

namespace beadwork {

/// Writes report.html into the folder and returns its path. Works on runs that are done, failed, interrupted
/// or were killed; what is missing is said in the report. Throws MachineFailure if there is no run or the
/// file cannot be written.
std::string write_report(const std::filesystem::path& run_folder, const std::string& view = "");

/// One PNG of the specimen for a page of text: a few frames below each other, without words. Needs a readable
/// run.h5 with frames; throws MachineFailure otherwise.
void write_picture(const std::filesystem::path& run_folder, const std::filesystem::path& file, std::size_t frames = 3);

/// The same of a batch: its table, and the curves of its runs laid over one another.
std::string write_batch_report(const std::filesystem::path& batch_folder);
/// Whether a batch has been run there.
bool is_batch(const std::filesystem::path& folder);

}  // namespace beadwork
