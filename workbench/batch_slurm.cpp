// A batch in the queue of Slurm.

#include <fmt/format.h>

#include <algorithm>

#include "core/base/text.hpp"
#include "workbench/batch.hpp"
#include "workbench/signals.hpp"
#include "workbench/slurm/slurm_jobs.hpp"
#include "workbench/terminal.hpp"

namespace beadwork {

namespace fs = std::filesystem;

namespace {

constexpr const char* ledger_name = "batch.jobs";
constexpr const char* desk_name = "batch.slurm";

/// beadwork job ...: it waits for nobody, but looks whether all is there that the run needs.
std::vector<std::string> command_in_slurm(const BatchRun& run, const std::vector<BatchRun>& all) {
  std::vector<std::string> command{fs::canonical("/proc/self/exe").string(), "job"};
  command.insert(command.end(), run.options.begin(), run.options.end());
  command.insert(command.end(), {"--as", run.postponed ? "either" : run.is_study ? "calibrate" : "run"});
  for (const std::size_t need : run.needs)
    if (!all[need].done) command.insert(command.end(), {"--need", all[need].folder.string()});
  return command;
}

std::string following(Words words) {
  std::erase(words, "--no-wait");
  return command_line(words);
}

void tell_what_goes_on(const slurm::SlurmJobs& driver, const Words& words) {
  if (driver.with_slurm() > 0)
    say("{} runs are with Slurm, which goes on without this command\n  follow them: {}\n  cancel them: scancel {}\n",
        driver.with_slurm(), following(words), join(driver.left(), " "));
  if (driver.not_taken() > 0)
    say("{} runs are not submitted yet; submit them, too: {}\n", driver.not_taken(), following(words));
}

}  // namespace

void attend_in_slurm(std::vector<BatchRun>& runs, OwnFolder& folder, const SlurmWish& wish) {
  heed_signals();
  const fs::path ledger = fs::absolute(folder.claim(ledger_name)), desk = fs::absolute(folder.claim(desk_name));
  fs::create_directories(desk);
  slurm::Controller controller;
  slurm::SlurmJobs driver({.at_once = wish.jobs,
                           .threads = wish.threads,
                           .sbatch = wish.sbatch,
                           .follow = wish.follow,
                           .ledger = ledger,
                           .desk = desk,
                           .interrupt = &interrupted,
                           .say =
                               [](const std::string& line) {
                                 say("{}\n", line);
                                 std::fflush(stdout);
                               }},
                          controller);
  attend(runs, folder, driver, [&runs](const BatchRun& run) { return command_in_slurm(run, runs); });
  tell_what_goes_on(driver, wish.words);
}

void refuse_where_slurm_is_at_work(const fs::path& folder) {
  const auto entries = slurm::read_ledger(folder / ledger_name);
  if (entries.empty()) return;
  if (!slurm::is_here()) return;  // a copy of the folder, on a machine without Slurm
  const auto queue = slurm::Controller().queue();
  if (!queue)
    throw DeckFailure(
        "error: runs of this folder were submitted to Slurm, which does not answer now, so that nobody knows whether "
        "they are at work: give the command again once it does, or follow them with --engine slurm");
  for (const slurm::Entry& entry : entries)
    for (std::size_t task = 0; task < entry.jobs.size(); ++task)
      if (const auto seen = queue->find({entry.word, task}); seen != queue->end() && !seen->second.has_ended())
        throw DeckFailure(
            fmt::format("error: '{}' is in Slurm's queue, as are others perhaps: follow them with --engine slurm, or "
                        "cancel them: scancel {}",
                        entry.jobs[task], seen->second.array));
}

}  // namespace beadwork
