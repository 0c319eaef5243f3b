#pragma once
// Programs as processes of this machine, so many at once: started, listened to, waited for. Batches and studies run
// their scenes in this way.

#include <sys/types.h>

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

namespace beadwork {

/// Starts a program that is asked to stop (SIGTERM) when this process ends, however it ends. -1 if it cannot be
/// started. `also`: a descriptor that it inherits, as number `inherited_descriptor`; -1 for none.
enum class Voice { heard, silent };
pid_t start_program(const std::vector<std::string>& command, int also = -1, Voice voice = Voice::heard);
inline constexpr int inherited_descriptor = 3;

/// Whether this signal asks a run to end in order. Runs heed them from their first lines on: one that such a signal has
/// killed had not begun.
bool ends_by_asking(int number);
/// All these.
const std::vector<int>& asking_signals();

/// A scene that is run in a folder of its own.
struct LocalJob {
  std::string name;
  std::filesystem::path folder;
  std::vector<std::string> command;  ///< it takes --tell, and writes there how far it has come
};

struct JobEnd {
  int code = -1;    ///< exit code, or what stands for the signal that killed it
  std::string how;  ///< "exit code 3", "killed by signal 9 (Killed)"
};

/// A job at work, and how far it has come, 0 to 1.
struct JobShare {
  std::size_t job;
  double share;
};
/// Of all.
double sum_of(const std::vector<JobShare>& jobs);

enum class Turn { now, later, never };

/// What is told of them while they run; numbers are those of the list.
class JobEvents {
 public:
  virtual ~JobEvents() = default;
  /// Whether a job may begin: it may need what others leave. Asked again and again; one that never may is left out.
  virtual Turn turn_of(std::size_t /*job*/) { return Turn::now; }
  virtual void began(std::size_t /*job*/) {}
  virtual void ended(std::size_t job, const JobEnd& end) = 0;
  /// Another process is writing its folder and is waited for.
  virtual void is_written_elsewhere(std::size_t /*job*/, const std::string& /*by*/) {}
  /// That other process has ended: whether the job is done now.
  virtual bool was_done_elsewhere(std::size_t /*job*/) { return false; }
  /// Now and then: those at work.
  virtual void at_work(const std::vector<JobShare>& /*jobs*/) {}
};

/// Runs all. Asks those at work to stop, so that they can be resumed, once `interrupt` is not zero, and starts no other;
/// and whatever is thrown on the way: no process is left to itself.
void run_jobs(const std::vector<LocalJob>& jobs, int at_once, Voice voice, const std::atomic<int>* interrupt,
              JobEvents& events);

/// How the processors are shared out: jobs at once, threads of each; 0 is open.
struct Shares {
  int jobs = 0, threads = 0;
  Shares among(std::size_t runs) const;
};

}  // namespace beadwork
