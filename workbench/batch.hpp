#pragma once
// Many runs of decks, each with other values of their parameters and a folder of its own.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/io/own_folder.hpp"
#include "core/loop/same_deck.hpp"
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
  std::vector<std::string> command;  ///< beadwork run ...
  std::string deck_sha256;
  FileSums files;        ///< that its deck names for data, as they are now
  bool refused = false;  ///< its deck has errors
  bool done = false;
  bool outdated = false;         ///< it was done, but with other data files
  int code = -1;                 ///< exit code; -1 before it has ended
  std::vector<std::string> row;  ///< of the table, from "status" to "exit_reason", as note_row read it last
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
/// Of the values, without what a folder's name should not have; of 200 letters at most, a long one ends in a check sum
/// of all of it.
std::string folder_name(const std::vector<Variation>& variations, const std::vector<std::string>& values);

struct DeckCheck {
  std::size_t refused = 0;  ///< runs
  std::string text;         ///< what is wrong, and warnings, each once with the runs that it concerns
};
/// Checks the decks of all runs, each as its process will see it, and marks those that are done and those that are
/// refused.
DeckCheck check_decks(std::vector<BatchRun>& runs);

/// True if a run ended there, in order, with the data files that there are now. DeckFailure if it was another deck, or
/// other values, that ran.
bool is_done(BatchRun& run);
/// Reads what the run says of itself now.
void note_row(BatchRun& run);

/// What summary.json and the curves of a run that has ended say.
Results results_of(const std::filesystem::path& folder);
/// The runs and what came of them as it was noted last, as CSV.
std::string batch_table(const std::vector<Variation>& variations, const std::vector<BatchRun>& runs);

/// The code that tells most: a failed run outranks an interrupted one.
int worst(const std::vector<BatchRun>& runs);

/// Runs those that are neither done nor refused, so many at once, as processes of this machine; rewrites `table`
/// whenever one ends. Stops them, so that they can be resumed, when it is interrupted; they stop by themselves when
/// this process is killed. A run that another process is still at is waited for.
void run_here(std::vector<BatchRun>& runs, int at_once, const std::vector<Variation>& variations,
              const std::filesystem::path& table);

/// Writes a script for Slurm and submits it; `at_once` = 0 leaves that to Slurm. MachineFailure, naming the script, if
/// there is no sbatch here.
void submit_to_slurm(const std::vector<BatchRun>& runs, int at_once, int threads, OwnFolder& folder);

}  // namespace beadwork
