#include "core/base/memory.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>

#include "core/base/text.hpp"

namespace beadwork {

namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

double of_the_machine() {
  const double pages = static_cast<double>(::sysconf(_SC_PHYS_PAGES)),
               page = static_cast<double>(::sysconf(_SC_PAGESIZE));
  return pages > 0 && page > 0 ? pages * page : no_limit;
}

double of_the_shell() {
  rlimit limit{};
  return ::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY ? static_cast<double>(limit.rlim_cur)
                                                                                : no_limit;
}

/// The number that a file holds; "max", or no file, is none.
double limit_in(const std::string& file) {
  std::string word;
  std::ifstream(file) >> word;
  return parse_number(word).value_or(no_limit);
}

/// The least limit of the control groups that hold this process, in both versions of their tree.
double of_the_group() {
  double least =
      std::min(limit_in("/sys/fs/cgroup/memory.max"), limit_in("/sys/fs/cgroup/memory/memory.limit_in_bytes"));
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const auto parts = split(line, ':');
    if (parts.size() != 3) continue;
    if (parts[1].empty()) least = std::min(least, limit_in("/sys/fs/cgroup" + parts[2] + "/memory.max"));
    if (parts[1] == "memory")
      least = std::min(least, limit_in("/sys/fs/cgroup/memory" + parts[2] + "/memory.limit_in_bytes"));
  }
  return least;
}

}  // namespace

double peak_memory() {
  rusage usage{};
  return ::getrusage(RUSAGE_SELF, &usage) == 0 ? 1024. * static_cast<double>(usage.ru_maxrss) : 0;
}

double memory_at_most() {
  static const double memory = std::min({of_the_machine(), of_the_shell(), of_the_group()});
  return memory;
}

std::string why_no_memory(double count, const std::string& things, double bytes, double memory) {
  if (count * bytes <= memory) return "";
  return fmt::format("{:.4g} {} need at least {:.3g} GB of memory, of which there are {:.3g} GB: {:.2g} are possible",
                     count, things, count * bytes / 1e9, memory / 1e9, memory / bytes);
}

}  // namespace beadwork
