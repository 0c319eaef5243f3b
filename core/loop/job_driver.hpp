#pragma once
// Runs in folders of their own, and who sees to them: processes of this machine, or a queue of many machines. Batches
// and studies know only this.

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace beadwork {

struct Job {
  std::string name;  ///< its own, among all
  std::filesystem::path folder;
  std::vector<std::string> command;
  std::vector<std::size_t> needs{};  ///< those of the list that are to end before
};

struct JobEnd {
  int code = -1;                ///< exit code, or what stands for whatever ended it
  std::string how;              ///< "exit code 3", "killed by signal 9 (Killed)", "Slurm: NODE_FAIL"
  std::string by{};             ///< who ended it, where that was not itself: "Slurm: TIMEOUT"
  std::filesystem::path log{};  ///< what it said outside of its folder, where that was kept
};

/// A job at work, and how far it has come, 0 to 1.
struct JobShare {
  std::size_t job;
  double share;
};
/// Of all.
inline double sum_of(const std::vector<JobShare>& jobs) {
  double sum = 0;
  for (const JobShare& each : jobs) sum += each.share;
  return sum;
}

enum class Turn { now, later, never };

/// What is told of them while they run; numbers are those of the list.
class JobEvents {
 public:
  virtual ~JobEvents() = default;
  /// Whether a job may begin: it may need what others leave. Asked again and again; one that never may is left out.
  virtual Turn turn_of(std::size_t /*job*/) { return Turn::now; }
  virtual void began(std::size_t /*job*/) {}
  virtual void ended(std::size_t job, const JobEnd& end) = 0;
  /// What keeps it from beginning or going on, once for each reason.
  virtual void is_held_up(std::size_t /*job*/, const std::string& /*why*/) {}
  /// Another process was writing its folder and has ended: whether the job is done now.
  virtual bool was_done_elsewhere(std::size_t /*job*/) { return false; }
  /// What it wrote where nobody saw it.
  virtual void said(std::size_t /*job*/, const std::string& /*text*/) {}
  /// Now and then: those at work.
  virtual void at_work(const std::vector<JobShare>& /*jobs*/) {}
};

class JobDriver {
 public:
  virtual ~JobDriver() = default;
  /// Sees to all of them until each has ended or never may begin, or until it is interrupted.
  virtual void run(const std::vector<Job>& jobs, JobEvents& events) = 0;
};

}  // namespace beadwork
