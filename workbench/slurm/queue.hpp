#pragma once
// What Slurm's queue holds, takes and refuses.

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace beadwork::slurm {

/// A task of an array: the word that its array was given when it was submitted, and its number there.
using Place = std::pair<std::string, std::size_t>;

struct Seen {
  std::string state;   ///< "PENDING", "RUNNING", "TIMEOUT"
  std::string reason;  ///< why it waits, or why it ended
  std::string array;   ///< number of the job of its array
  bool has_ended() const;
  bool is_waiting() const { return state == "PENDING"; }
  bool is_running() const { return state == "RUNNING"; }
};

/// What an array may hold.
struct Limits {
  std::size_t tasks = 1001;     ///< numbers from 0 up to one less
  std::size_t bytes = 3000000;  ///< of its script
};

/// Of what `scontrol show config` says.
Limits limits_in(const std::string& config);

/// Whether this machine has Slurm's programs at all.
bool is_here();
/// Of what squeue says.
std::map<Place, Seen> queue_in(const std::string& text);

/// What a state of a job that has ended means for its user: "Slurm: TIMEOUT, it took longer than it was given".
std::string told(const std::string& state, const std::string& reason = "");

struct Submission {
  std::string job;         ///< number; "" if it was refused
  std::string refusal;     ///< what sbatch said
  bool is_limit = false;   ///< less would be taken, or the same later
  bool is_unsure = false;  ///< no answer came: it may have been taken all the same
};
/// Of what sbatch says where it did not succeed.
Submission refusal_in(const std::string& text);

/// Slurm's controller, asked by its programs.
class Controller {
 public:
  virtual ~Controller() = default;
  /// MachineFailure where there is no Slurm, or none that answers.
  virtual Limits limits();
  /// All tasks of this user that it still knows of, those of the last minutes that have ended among them; nothing if it
  /// does not answer now.
  virtual std::optional<std::map<Place, Seen>> queue();
  /// State of a task that is in the queue no more, "" where nobody knows.
  virtual std::string state_of_gone(const std::string& array, std::size_t task);
  /// MachineFailure where there is no sbatch. `kept` as for `ask`.
  virtual Submission submit(const std::vector<std::string>& options, const std::string& script, int kept);
};

/// Words for sbatch from what the user gives for it, "--partition=long --time=4:00:00". DeckFailure for what is no
/// option, and for options that are the batch's own.
std::vector<std::string> user_options(const std::vector<std::string>& texts);

}  // namespace beadwork::slurm
