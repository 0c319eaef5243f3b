#pragma once
// How much memory there is, so that what cannot fit is refused instead of being killed by the system.

#include <string>

namespace beadwork {

/// The memory that this process may use at most [bytes]: that of the machine, or less where the process is limited
/// (ulimit -v, a control group such as those of Slurm and of containers).
double memory_at_most();

/// The most that this process has held so far [bytes].
double peak_memory();

/// Why `things` ("elements") of `bytes` each and so many of them cannot be held in `memory`; empty if they can.
std::string why_no_memory(double count, const std::string& things, double bytes, double memory = memory_at_most());

}  // namespace beadwork
