#pragma once
// Many runs of one deck, each with other values of its parameters and a folder of its own.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "workbench/verbs.hpp"

namespace beadwork {

/// What a run has found, as columns of the table: ("force: largest force [N]", "62.99").
using Results = std::vector<std::pair<std::string, std::string>>;

struct BatchRun {
  std::string name;                 ///< "young=30-GPa,seed=2": also that of its folder
  std::string title;                ///< "young=30 GPa, seed=2": what is shown
  std::vector<std::string> values;  ///< of the parameters that vary
  std::filesystem::path folder;
  DeckArguments deck;                ///< with its values
  std::vector<std::string> command;  ///< beadwork run ..., without --resume or --overwrite
  std::string deck_sha256;
  bool refused = false;  ///< its deck has errors
  bool done = false;
  int code = -1;  ///< exit code; -1 before it has ended
  Results results;
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
/// Of the values, without what a folder's name should not have; of 200 letters at most, a long one ends in a check sum of all of it.
std::string folder_name(const std::vector<Variation>& variations, const std::vector<std::string>& values);

struct DeckCheck {
  std::size_t refused = 0;  ///< runs
  std::string text;         ///< what is wrong, and warnings, each once with the runs that it concerns
};
/// Checks the decks of all runs, each as its process will see it, and marks those that are done and those that are refused.
DeckCheck check_decks(std::vector<BatchRun>& runs);

/// True if a run ended there, in order. DeckFailure if it was another deck, or other values, that ran.
bool is_done(const BatchRun& run);
/// True if a run was interrupted there and can go on.
bool can_resume(const BatchRun& run);

/// What summary.json and the curves of a run that has ended say.
Results results_of(const std::filesystem::path& folder);
/// The runs and what came of them, as CSV.
std::string batch_table(const std::vector<Variation>& variations, const std::vector<BatchRun>& runs);

/// The code that tells most: a failed run outranks an interrupted one.
int worst(const std::vector<BatchRun>& runs);

/// Runs those that are neither done nor refused, so many at once, as processes of this machine; rewrites `table` whenever one ends.
/// Stops them, so that they can be resumed, when it is interrupted; they stop by themselves when this process is killed. A run that
/// another process is still at is waited for.
void run_here(std::vector<BatchRun>& runs, int at_once, const std::vector<Variation>& variations, const std::filesystem::path& table);

/// Writes a script for Slurm and submits it; `at_once` = 0 leaves that to Slurm. MachineFailure, naming the script, if there is no sbatch here.
void submit_to_slurm(const std::vector<BatchRun>& runs, int at_once, int threads, const std::filesystem::path& folder);

/// Starts a program that is asked to stop (SIGTERM) when this process ends, however it ends. -1 if it cannot be started.
/// `also`: a descriptor that it inherits, as number `inherited_descriptor`; -1 for none.
pid_t start_program(const std::vector<std::string>& command, int also = -1);
inline constexpr int inherited_descriptor = 3;

}  // namespace beadwork
