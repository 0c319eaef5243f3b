#pragma once
// How many processors this process may use: those of a machine are shared with others.

#include <filesystem>
#include <functional>

namespace beadwork {

/// Where the limits stand. A test brings its own.
struct Limits {
  std::filesystem::path root = "/";  ///< below it are proc/self/cgroup and sys/fs/cgroup
  std::function<const char*(const char*)> variable;
  int affinity = 1;  ///< processors that the scheduler lets it run on

  static Limits of_this_process();
};

/// The least of: the processors it may run on (affinity), the share of time that its control group gets (cgroup v1 or
/// v2, of all groups around it too; 1.5 processors count as two), OMP_NUM_THREADS and SLURM_CPUS_PER_TASK. At least
/// one.
int allowed_processors(const Limits& limits);
/// Of this process, as it was when it was first asked.
int allowed_processors();

}  // namespace beadwork
