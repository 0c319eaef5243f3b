#include <fmt/format.h>
#include <sys/wait.h>

#include <cstdio>

#include "core/base/failure.hpp"
#include "core/io/file.hpp"
#include "workbench/batch.hpp"
#include "workbench/terminal.hpp"

namespace beadwork {

namespace {

// As one word of one line for bash, whatever is in it: a line break in a value must not begin a command.
std::string quoted(const std::string& word) {
  const auto control = [](unsigned char c) { return c < ' ' || c == 127; };
  std::string text, octal;
  bool any_control = false;
  for (const char c : word) any_control |= control(static_cast<unsigned char>(c));
  for (const char c : word) {
    if (control(static_cast<unsigned char>(c)))
      text += fmt::format("\\{:03o}", static_cast<unsigned char>(c));
    else if (c == '\'')
      text += any_control ? "\\'" : "'\\''";
    else if (c == '\\' && any_control)
      text += "\\\\";
    else
      text += c;
  }
  return (any_control ? "$'" : "'") + text + "'";
}

// One line for each run: a job that Slurm starts once more goes on where it was.
std::string command_line(const BatchRun& run) {
  std::string command;
  for (const std::string& word : run.command) command += quoted(word) + " ";
  return fmt::format("if [ -e {0} ]; then exec {1}--resume; else exec {1}--overwrite; fi\n", quoted((run.folder / "checkpoint.h5").string()),
                     command);
}

// sbatch fills in what stands behind a %.
std::string without_patterns(const std::string& path) {
  std::string text;
  for (const char c : path) text += c == '%' ? std::string("%%") : std::string(1, c);
  return text;
}

}  // namespace

void submit_to_slurm(const std::vector<BatchRun>& runs, int at_once, int threads, const std::filesystem::path& folder) {
  std::string commands;
  int count = 0;
  for (const BatchRun& run : runs)
    if (!run.done && !run.refused) {
      commands += command_line(run);
      ++count;
    }
  if (count == 0) return;
  const auto list = folder / "batch.commands";
  const auto script = folder / "batch.sbatch";
  write_atomically(list, commands);
  write_atomically(script, fmt::format("#!/bin/bash\n"
                                       "#SBATCH --job-name=beadwork\n"
                                       "#SBATCH --array=1-{}{}\n"
                                       "#SBATCH --cpus-per-task={}\n"
                                       "#SBATCH --requeue\n"
                                       "commands={}\n"
                                       "eval \"$(sed -n \"${{SLURM_ARRAY_TASK_ID}}p\" \"$commands\")\"\n",
                                       count, at_once > 0 ? fmt::format("%{}", at_once) : "", threads, quoted(list.string())));
  const pid_t child = start_program({"sbatch", "--output", without_patterns(folder.string()) + "/slurm-%a.log", script.string()});
  int status = 0;
  if (child > 0) ::waitpid(child, &status, 0);
  if (child < 0 || (WIFEXITED(status) && WEXITSTATUS(status) == 127))
    throw MachineFailure(fmt::format("there is no sbatch here; submit it where there is one: sbatch {}", script.string()));
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw MachineFailure(fmt::format("error: sbatch refused {}", script.string()));
  say("{} runs submitted; the same command with --engine local makes the table once they are done\n", count);
}

}  // namespace beadwork
