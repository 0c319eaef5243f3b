#pragma once
// What the system says to the program while it runs.

#include <atomic>

namespace beadwork {

/// Opens /dev/null where standard input, output or error was closed by whoever started the program, so that no file of
/// a run gets its number and takes what is meant for the terminal. To be called before any file is opened.
void hold_standard_streams();

/// Number of the signal by which the run is to end in order; 0: none yet.
extern std::atomic<int> interrupted;

/// From now on Ctrl-C, SIGTERM, a closed terminal (SIGHUP, unless nohup has it ignored), SIGUSR1 and the processor time
/// of a queue that is used up (SIGXCPU) are noted in `interrupted`, and a closed pipe or a file that may not grow are
/// errors of the one who writes.
void heed_signals();

}  // namespace beadwork
