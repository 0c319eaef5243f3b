#pragma once
// Programs as processes of this machine, so many at once: started, listened to, waited for.

#include <sys/types.h>

#include <atomic>
#include <string>
#include <vector>

#include "core/loop/job_driver.hpp"

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

/// Runs them as processes of this machine, so many at once. Each command takes --tell, and writes there how far it has
/// come.
class LocalJobs final : public JobDriver {
 public:
  LocalJobs(int at_once, Voice voice, const std::atomic<int>* interrupt)
      : at_once_(at_once), voice_(voice), interrupt_(interrupt) {}
  /// Asks those at work to stop, so that they can be resumed, once `interrupt` is not zero, and starts no other; and
  /// whatever is thrown on the way: no process is left to itself.
  void run(const std::vector<Job>& jobs, JobEvents& events) override;

 private:
  int at_once_;
  Voice voice_;
  const std::atomic<int>* interrupt_;
};

/// How the processors are shared out: jobs at once, threads of each; 0 is open.
struct Shares {
  int jobs = 0, threads = 0;
  Shares among(std::size_t runs) const;
};

}  // namespace beadwork
