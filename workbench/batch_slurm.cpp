#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"
#include "core/io/file.hpp"
#include "core/loop/local_jobs.hpp"
#include "workbench/batch.hpp"
#include "workbench/terminal.hpp"

namespace beadwork {

namespace {

// sbatch fills in what stands behind a %.
std::string without_patterns(const std::string& path) {
  std::string text;
  for (const char c : path) text += c == '%' ? std::string("%%") : std::string(1, c);
  return text;
}

}  // namespace

void submit_to_slurm(const std::vector<BatchRun>& runs, int at_once, int threads, OwnFolder& folder) {
  std::string commands;  // a line each: a job that Slurm starts once more goes on where it was
  int count = 0, later = 0;
  for (const BatchRun& run : runs) {
    if (run.done || run.refused) continue;
    const bool waits =
        std::any_of(run.needs.begin(), run.needs.end(), [&](std::size_t need) { return !runs[need].done; });
    if (waits) {
      ++later;
      continue;
    }
    commands += "exec " + command_line(command_of(run)) + "\n";
    ++count;
  }
  if (later > 0) say("{} runs need others that are not done: give the same command again once these are\n", later);
  if (count == 0) return;
  const auto list = std::filesystem::absolute(folder.claim("batch.commands"));
  const auto script = std::filesystem::absolute(folder.claim("batch.sbatch"));
  write_atomically(list, commands);
  write_atomically(
      script, fmt::format("#!/bin/bash\n"
                          "#SBATCH --job-name=beadwork\n"
                          "#SBATCH --array=1-{}{}\n"
                          "#SBATCH --cpus-per-task={}\n"
                          "#SBATCH --requeue\n"
                          "commands={}\n"
                          "eval \"$(sed -n \"${{SLURM_ARRAY_TASK_ID}}p\" \"$commands\")\"\n",
                          count, at_once > 0 ? fmt::format("%{}", at_once) : "", threads, shell_quoted(list.string())));
  const pid_t child = start_program(
      {"sbatch", "--output", without_patterns(script.parent_path().string()) + "/slurm-%a.log", script.string()});
  int status = 0;
  if (child > 0) ::waitpid(child, &status, 0);
  if (child < 0 || (WIFEXITED(status) && WEXITSTATUS(status) == 127))
    throw MachineFailure(
        fmt::format("there is no sbatch here; submit it where there is one: sbatch {}", script.string()));
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw MachineFailure(fmt::format("error: sbatch refused {}", script.string()));
  say("{} runs submitted; the same command with --engine local makes the table once they are done\n", count);
}

}  // namespace beadwork
