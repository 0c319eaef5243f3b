#pragma once
// Many runs of decks, each with other values of their parameters and a folder of its own.

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/io/own_folder.hpp"
#include "core/io/result_tables.hpp"
#include "core/loop/job_driver.hpp"
#include "core/loop/same_deck.hpp"
#include "core/plugin/run_list.hpp"
#include "workbench/report/results.hpp"
#include "workbench/verbs.hpp"

namespace beadwork {

struct BatchRun {
  std::string name;   ///< "young=30-GPa,seed=2": that of its folder, below that of the batch
  std::string title;  ///< "young=30 GPa, seed=2": what is shown
  std::string sweep;  ///< whose run it is; empty where there is none
  std::vector<std::pair<std::string, std::string>> values;  ///< of what varies
  std::filesystem::path folder;
  DeckArguments deck;                ///< with its values
  std::vector<std::size_t> needs;    ///< runs that are to be done before
  std::vector<std::string> options;  ///< of its command, as far as they are the same for all
  std::string deck_sha256;
  FileSums files;          ///< that its deck names for data, as they are now
  bool refused = false;    ///< its deck has errors
  bool postponed = false;  ///< its deck cannot be read before those are done which it needs
  bool is_study = false;   ///< a calibration
  bool done = false;
  bool outdated = false;         ///< it was done, but with other data files
  std::string missing;           ///< the run that it needs and that has failed
  int code = -1;                 ///< exit code; -1 before it has ended
  std::vector<std::string> row;  ///< of the table, from "status" to "exit_reason", as note_row read it last
  Results results;               ///< columns of the table
};

// ---- Which runs there are (batch_plan.cpp)

/// A parameter that varies: "young=30 GPa,40 GPa".
struct Variation {
  std::string name;
  std::vector<std::string> values;
};
/// DeckFailure if the text is no such thing.
Variation variation_of(const std::string& text);
/// All combinations, the last parameter varying fastest, as a list without a name; DeckFailure beyond a million.
RunList list_of(const std::vector<std::string>& decks, const std::vector<Variation>& variations);
/// The runs of these lists, list by list, deck by deck; `out` is the folder of all. DeckFailure if two would write one
/// folder, if lists wait for one another, or for none that there is.
std::vector<BatchRun> runs_of(const std::vector<RunList>& lists, const DeckArguments& common,
                              const std::filesystem::path& out);
/// The names of what varies in any of them, in the order in which they are met.
std::vector<std::string> parameters_of(const std::vector<BatchRun>& runs);

// ---- Whether their decks are in order (batch_check.cpp)

/// Checks decks, each as its process will see it, marks those runs that are done, refused or postponed, and gathers what
/// is wrong, each mistake once with the runs that have it.
class DeckChecks {
 public:
  /// `all`: the runs among which those stand that it needs.
  void check(BatchRun& run, const std::vector<BatchRun>& all);
  /// All of them, each behind those that it needs.
  void check_all(std::vector<BatchRun>& runs);
  std::size_t refused() const { return refused_; }
  /// What is wrong, and warnings.
  std::string text(std::size_t all) const;

 private:
  void note(const std::string& mistake, const BatchRun& run);
  std::vector<std::string> order_;
  std::map<std::string, std::vector<const BatchRun*>> who_;
  std::map<std::vector<std::string>, FileSums> sums_;  // of files that many runs read
  std::size_t refused_ = 0;
};

/// What each would do, a line each, as the checks have found it (batch_outlook.cpp).
std::string outlook_on(const std::vector<BatchRun>& runs);

// ---- What came of them (batch_table.cpp, batch_means.cpp)

/// True if a run ended there, in order, with the data files that there are now. DeckFailure if it was another deck, or
/// other values, that ran.
bool is_done(BatchRun& run);
/// Reads what the run says of itself now.
void note_row(BatchRun& run);
/// A run's cells, by the names of their columns: its values, what it says of itself, its results.
Results cells_of(const BatchRun& run);
/// The runs and what came of them as it was noted last.
ResultTable batch_table(const std::vector<BatchRun>& runs);
/// Whether a parameter only says which draw it is: "seed", or one whose name ends in "-seed".
bool is_seed(const std::string& parameter);
/// Means and scatter (standard deviation of one run) over seeds: a row for each group of runs that differ in their seeds
/// only, and are done. Without rows where no group has two.
ResultTable batch_means(const std::vector<BatchRun>& runs);
/// batch.csv, batch.h5 and, where there are means or were some before, means.csv.
void write_tables(const std::vector<BatchRun>& runs, OwnFolder& folder);
/// The code that tells most: a failed run outranks an interrupted one.
int worst(const std::vector<BatchRun>& runs);

// ---- How they are run

/// Of its command, as far as they are the same for all; `batch` is that of the batch.
std::vector<std::string> options_of(const BatchRun& run, int threads, const std::string& batch);
/// beadwork run ..., or calibrate ...: as soon as it is known which.
std::vector<std::string> command_of(const BatchRun& run);

/// The command of a run, as the driver wants it.
using Command = std::function<std::vector<std::string>(const BatchRun&)>;

/// Has the driver run those that are neither done nor refused, and rewrites the tables whenever one ends
/// (batch_attend.cpp).
void attend(std::vector<BatchRun>& runs, OwnFolder& folder, JobDriver& driver, const Command& command);

/// How a batch uses Slurm (batch_slurm.cpp).
struct SlurmWish {
  int jobs = 0, threads = 1;
  std::vector<std::string> sbatch;  ///< words for sbatch
  bool follow = true;
  Words words;  ///< that were typed
};
/// Submits and follows; says how the jobs go on, and how they are cancelled, where they outlast this command.
void attend_in_slurm(std::vector<BatchRun>& runs, OwnFolder& folder, const SlurmWish& wish);
/// DeckFailure if jobs of a batch in this folder are in Slurm's queue: nobody else may run them.
void refuse_where_slurm_is_at_work(const std::filesystem::path& folder);

}  // namespace beadwork
