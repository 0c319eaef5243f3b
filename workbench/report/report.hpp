#pragma once
// The report of a run: one HTML file that needs nothing else, made from whatever the run left in its folder.

#include <filesystem>
#include <string>
#include <vector>

namespace beadwork {

/// Writes report.html into the folder and returns its path. Works on runs that are done, failed, interrupted
/// or were killed; what is missing is said in the report. Throws MachineFailure if there is no run or the
/// file cannot be written.
std::string write_report(const std::filesystem::path& run_folder, const std::string& view = "");

/// The same of a batch: its table, and the curves of its runs laid over one another.
std::string write_batch_report(const std::filesystem::path& batch_folder);
/// Whether a batch has been run there.
bool is_batch(const std::filesystem::path& folder);

/// Several runs: their curves over one another, what differs in their decks, and what came of them, as an HTML file of
/// that name. DeckFailure if one is no run, or if a file that is no page of Beadwork stands there.
std::string write_comparison(const std::vector<std::filesystem::path>& folders, const std::filesystem::path& file);

/// The same of a study: its result and its curves.
std::string write_study_report(const std::filesystem::path& folder);
/// Whether a study has been conducted there.
bool is_study(const std::filesystem::path& folder);

}  // namespace beadwork
