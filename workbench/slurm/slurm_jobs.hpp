#pragma once
// Jobs as tasks of arrays of Slurm: submitted, found again, followed. What has been submitted goes on without whoever
// did it.

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/loop/job_driver.hpp"
#include "workbench/slurm/ledger.hpp"
#include "workbench/slurm/note.hpp"
#include "workbench/slurm/pieces.hpp"
#include "workbench/slurm/queue.hpp"

namespace beadwork::slurm {

struct Options {
  int at_once = 0;                  ///< 0: as many as Slurm likes
  int threads = 1;                  ///< of each
  std::vector<std::string> sbatch;  ///< words that the user adds
  bool follow = true;               ///< otherwise it submits and leaves
  std::filesystem::path ledger;     ///< file of what has been submitted
  std::filesystem::path desk;       ///< folder for what jobs leave and say
  const std::atomic<int>* interrupt = nullptr;
  std::chrono::milliseconds shortest_rest{1000};  ///< between two looks at the queue
  /// What Slurm was asked to take, and did not answer, is in its queue after so long or not at all.
  std::chrono::milliseconds answers_within{30000};
  std::function<void(const std::string&)> say = [](const std::string&) {};
};

/// Each command takes --note, a file that tells how far it has come and how it ended, and may begin once those that it
/// needs have ended, however they did: it looks itself whether all is there. Once it is interrupted, it leaves the jobs
/// to Slurm.
class SlurmJobs final : public JobDriver {
 public:
  SlurmJobs(Options options, Controller& controller);
  void run(const std::vector<Job>& jobs, JobEvents& events) override;

  /// Numbers of the jobs that go on.
  std::vector<std::string> left() const;
  /// How many tasks of them, and how many wait that Slurm has not taken.
  std::size_t with_slurm() const { return count(At::queued); }
  std::size_t not_taken() const { return count(At::start); }

 private:
  using Clock = std::chrono::steady_clock;
  enum class At { start, queued, over };
  struct Own {
    At at = At::start;
    Place place;
    std::string array;
    bool began = false;
    bool may_begin = false;  ///< what it needs is done, and was looked at
    double share = 0;
    std::optional<Clock::time_point> odd_since;  ///< Slurm and its folder do not say the same
  };

  bool is_interrupted() const { return options_.interrupt && *options_.interrupt; }
  std::size_t count(At at) const;
  std::size_t task(const Own& own) const { return own.place.second; }
  std::filesystem::path file_of(const Own& own, const char* ending) const;

  using Queue = std::map<Place, Seen>;
  void take_up();
  bool adopt(const Entry& entry, const Queue& queue, bool ended_too);
  void leave_out_what_ended_meanwhile();
  bool may_submit() const { return !(room_ && *room_ == 0) && !is_unsure_ && !is_interrupted(); }

  void submit_what_can();
  std::vector<Wanted> wanted(bool& dropped);
  bool submit(const std::vector<Wanted>& wanted);
  std::string submit_some(Piece piece, const std::vector<std::string>& behind);
  void note_taken(std::size_t jobs);
  Submission submit_piece(const Piece& piece, const std::vector<std::string>& behind);
  std::vector<std::string> options_of(const Piece& piece, const std::vector<std::string>& behind,
                                      const std::string& word) const;
  std::string dependency_of(const Piece& piece, const std::vector<std::string>& behind) const;
  std::string script_of(const Piece& piece) const;

  void look();
  void look_for_unsure(const Queue& queue);
  void look_at(std::size_t job, const Queue& queue);
  void note_begun(std::size_t job, const std::optional<Note>& note);
  void note_held(std::size_t job, const Seen& seen);
  void settle(std::size_t job, const std::string& state, const std::string& reason, const std::optional<Note>& note);
  bool is_odd_for(Own& own, std::chrono::seconds patience);
  void end(std::size_t job, JobEnd ending);
  void leave(Own& own, bool with_log = true);
  void rest();

  Options options_;
  Controller& controller_;
  Ledger ledger_;
  Limits limits_;
  const std::vector<Job>* jobs_ = nullptr;
  JobEvents* events_ = nullptr;
  std::vector<Own> own_;
  std::optional<std::size_t> room_;               ///< once Slurm took no more: how many it may be asked to take
  bool is_probe_ = false;                         ///< that it may take more was only guessed
  bool is_unsure_ = false;                        ///< it was asked to take some, and no answer is known
  std::optional<Clock::time_point> heard_since_;  ///< when it answered again
  bool full_was_told_ = false, silence_was_told_ = false;
  std::map<std::string, std::size_t> names_;  ///< of the jobs
  std::set<std::string> held_told_;
  Clock::time_point began_ = Clock::now();
};

}  // namespace beadwork::slurm
