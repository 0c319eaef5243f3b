#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <map>
#include <thread>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"
#include "core/io/file.hpp"
#include "workbench/batch.hpp"

extern char** environ;

namespace beadwork {

namespace {

std::atomic<bool> stopped{false};
void note_stop(int) { stopped = true; }

pid_t start(const std::vector<std::string>& command) {
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  pid_t child = 0;
  const int error = ::posix_spawnp(&child, words[0], nullptr, nullptr, words.data(), environ);
  return error == 0 ? child : -1;
}

int code_of(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : static_cast<int>(ExitCode::machine); }

// Processes of this machine, so many at once.
class Pool {
 public:
  explicit Pool(int at_once) : at_once_(static_cast<std::size_t>(at_once)) {}
  bool is_full() const { return running_.size() >= at_once_; }
  bool is_empty() const { return running_.empty(); }

  void start_run(BatchRun& run) {
    std::vector<std::string> command = run.command;
    command.push_back(can_resume(run) ? "--resume" : "--overwrite");
    const pid_t child = start(command);
    if (child < 0) throw MachineFailure("error: cannot start " + command.front());
    running_[child] = &run;
  }

  /// A run that has ended, or null.
  BatchRun* reap() {
    for (auto it = running_.begin(); it != running_.end(); ++it) {
      int status = 0;
      if (::waitpid(it->first, &status, WNOHANG) != it->first) continue;
      BatchRun* run = it->second;
      running_.erase(it);
      run->code = code_of(status);
      run->done = run->code == 0;
      return run;
    }
    return nullptr;
  }

  void ask_to_stop() const {
    for (const auto& [child, run] : running_) ::kill(child, SIGTERM);
  }

 private:
  std::size_t at_once_;
  std::map<pid_t, BatchRun*> running_;
};

// One line for each run: a job that Slurm starts once more goes on where it was.
std::string command_line(const BatchRun& run) {
  std::string command;
  for (const std::string& word : run.command) command += shell_quoted(word) + " ";
  return fmt::format("if [ -e {0} ]; then exec {1}--resume; else exec {1}--overwrite; fi\n", shell_quoted((run.folder / "checkpoint.h5").string()),
                     command);
}

}  // namespace

void run_here(std::vector<BatchRun>& runs, int at_once, const std::vector<Variation>& variations, const std::filesystem::path& table) {
  ::signal(SIGINT, note_stop);
  ::signal(SIGTERM, note_stop);
  Pool pool(at_once);
  std::size_t next = 0;
  auto ended = static_cast<std::size_t>(std::count_if(runs.begin(), runs.end(), [](const BatchRun& run) { return run.done; }));
  bool asked = false;
  while (true) {
    for (; !stopped && !pool.is_full() && next < runs.size(); ++next)
      if (!runs[next].done) pool.start_run(runs[next]);
    if (stopped && !asked) {
      pool.ask_to_stop();
      asked = true;
    }
    if (pool.is_empty() && (stopped || next == runs.size())) return;
    while (const BatchRun* run = pool.reap()) {
      std::printf("[%zu/%zu] %s: %s\n", ++ended, runs.size(), run->name.c_str(),
                  run->done ? "done" : fmt::format("exit code {}, see {}", run->code, (run->folder / "run.log").string()).c_str());
      std::fflush(stdout);
      write_atomically(table, batch_table(variations, runs));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

void submit_to_slurm(const std::vector<BatchRun>& runs, int at_once, int threads, const std::filesystem::path& folder) {
  std::string commands;
  int count = 0;
  for (const BatchRun& run : runs)
    if (!run.done) {
      commands += command_line(run);
      ++count;
    }
  if (count == 0) return;
  const auto list = folder / "batch.commands";
  const auto script = folder / "batch.sbatch";
  write_atomically(list, commands);
  write_atomically(script, fmt::format("#!/bin/bash\n"
                                       "#SBATCH --job-name=beadwork\n"
                                       "#SBATCH --array=1-{}%{}\n"
                                       "#SBATCH --cpus-per-task={}\n"
                                       "#SBATCH --requeue\n"
                                       "eval \"$(sed -n \"${{SLURM_ARRAY_TASK_ID}}p\" {})\"\n",
                                       count, at_once, threads, shell_quoted(list.string())));
  const pid_t child = start({"sbatch", "--output", (folder / "slurm-%a.log").string(), script.string()});
  if (child < 0) throw MachineFailure(fmt::format("there is no sbatch here; submit it where there is one: sbatch {}", script.string()));
  int status = 0;
  ::waitpid(child, &status, 0);
  if (code_of(status) != 0) throw MachineFailure(fmt::format("error: sbatch refused {}", script.string()));
  std::printf("%d runs submitted; the same command with --engine local makes the table once they are done\n", count);
}

}  // namespace beadwork
