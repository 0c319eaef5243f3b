#pragma once
// What a run says, on the terminal and in its run.log. Neither can stop the run: a terminal that is gone and a disk
// that is full take no words, and that is all.

#include <spdlog/logger.h>

#include <filesystem>
#include <memory>
#include <string>

namespace beadwork {

/// `quiet`: only warnings and errors on the terminal. `label` stands before each line there, in brackets, where several
/// runs share it. MachineFailure if the file cannot be opened.
std::shared_ptr<spdlog::logger> make_run_log(const std::filesystem::path& file, bool append, bool quiet,
                                             const std::string& label = "");
/// A line for who looks at the run later: into the file of a log made above, not on the terminal.
void note_in_file(const spdlog::logger& log, const std::string& line);

}  // namespace beadwork
