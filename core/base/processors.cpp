#include "core/base/processors.hpp"

#include <sched.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>

namespace beadwork {

namespace fs = std::filesystem;

namespace {

constexpr double unlimited = 1e9;

// So many processors' time; unlimited where the files do not say.
double share_of_v2(const fs::path& group) {
  std::ifstream file(group / "cpu.max");
  std::string quota;
  double period = 0;
  if (!(file >> quota >> period) || quota == "max" || !(period > 0)) return unlimited;
  return std::strtod(quota.c_str(), nullptr) / period;
}

double share_of_v1(const fs::path& group) {
  std::ifstream quota_file(group / "cpu.cfs_quota_us"), period_file(group / "cpu.cfs_period_us");
  double quota = 0, period = 0;
  if (!(quota_file >> quota) || !(period_file >> period) || !(quota > 0) || !(period > 0)) return unlimited;
  return quota / period;
}

// Of a group and of all groups around it. Inside of a container the path may be one of the host that is not there: then
// what is left is the root, which is the container's own group.
template <class Share>
double least_up_to_root(const fs::path& mount, const std::string& group, const Share& share) {
  double least = share(mount);
  fs::path here = mount;
  for (const fs::path& piece : fs::path(group).relative_path()) {
    if (piece == "..") break;
    here /= piece;
    least = std::min(least, share(here));
  }
  return least;
}

double share_of_groups(const fs::path& root) {
  std::ifstream file(root / "proc/self/cgroup");
  double least = unlimited;
  for (std::string line; std::getline(file, line);) {  // number:controllers:path
    const auto first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1), group = line.substr(second + 1);
    const fs::path mounts = root / "sys/fs/cgroup";
    if (controllers.empty()) {
      for (const fs::path& mount : {mounts, mounts / "unified"})
        least = std::min(least, least_up_to_root(mount, group, share_of_v2));
    } else if (("," + controllers + ",").find(",cpu,") != std::string::npos) {
      for (const fs::path& mount : {mounts / controllers, mounts / "cpu"})
        least = std::min(least, least_up_to_root(mount, group, share_of_v1));
    }
  }
  return least;
}

// A whole number from one on at the start of the variable ("4", or "4,2" for nested loops); unlimited otherwise.
double number_of(const char* text) {
  if (!text) return unlimited;
  const std::string word = text;
  int number = 0;
  const auto read = std::from_chars(word.data(), word.data() + word.size(), number);
  const bool whole = read.ec == std::errc() && (read.ptr == word.data() + word.size() || *read.ptr == ',');
  return whole && number > 0 ? number : unlimited;
}

}  // namespace

Limits Limits::of_this_process() {
  Limits limits;
  limits.variable = [](const char* name) { return std::getenv(name); };
  cpu_set_t set;
  if (::sched_getaffinity(0, sizeof set, &set) == 0)
    limits.affinity = CPU_COUNT(&set);
  else  // more processors than the set has room for
    limits.affinity = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  return limits;
}

int allowed_processors(const Limits& limits) {
  double least = std::min<double>(limits.affinity, std::ceil(share_of_groups(limits.root) - 1e-6));
  for (const char* name : {"OMP_NUM_THREADS", "SLURM_CPUS_PER_TASK"})
    least = std::min(least, number_of(limits.variable(name)));
  return static_cast<int>(std::max(1., least));
}

int allowed_processors() {
  static const int allowed = allowed_processors(Limits::of_this_process());
  return allowed;
}

}  // namespace beadwork
