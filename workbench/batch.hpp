#pragma once
// Many runs of one deck, each with other values of its parameters and a folder of its own.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace beadwork {

struct BatchRun {
  std::string name;                 ///< "young=30-GPa,seed=2": also that of its folder
  std::vector<std::string> values;  ///< of the parameters that vary
  std::filesystem::path folder;
  std::vector<std::string> command;  ///< beadwork run ..., without --resume or --overwrite
  bool done = false;
  int code = -1;  ///< exit code; -1 before it has ended
};

/// A parameter that varies: "young=30 GPa,40 GPa".
struct Variation {
  std::string name;
  std::vector<std::string> values;
};
/// DeckFailure if the text is no such thing.
Variation variation_of(const std::string& text);
/// All combinations, the last parameter varying fastest.
std::vector<std::vector<std::string>> combinations(const std::vector<Variation>& variations);

/// True if a run ended there, in order. DeckFailure if it was another deck, or other values, that ran.
bool is_done(const BatchRun& run, const std::string& deck_sha256);
/// True if a run was interrupted there and can go on.
bool can_resume(const BatchRun& run);

/// The runs and what came of them, as CSV.
std::string batch_table(const std::vector<Variation>& variations, const std::vector<BatchRun>& runs);

/// The code that tells most: a failed run outranks an interrupted one.
int worst(const std::vector<BatchRun>& runs);

/// Runs those that are not done, so many at once, as processes of this machine; rewrites `table` whenever one ends.
/// Stops them, so that they can be resumed, when it is interrupted.
void run_here(std::vector<BatchRun>& runs, int at_once, const std::vector<Variation>& variations, const std::filesystem::path& table);

/// Writes a script for Slurm and submits it. MachineFailure, naming the script, if there is no sbatch here.
void submit_to_slurm(const std::vector<BatchRun>& runs, int at_once, int threads, const std::filesystem::path& folder);

}  // namespace beadwork
