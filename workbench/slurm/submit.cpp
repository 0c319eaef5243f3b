// How jobs come into the queue.

#include <fmt/format.h>

#include <algorithm>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"
#include "workbench/slurm/slurm_jobs.hpp"

namespace beadwork::slurm {

namespace {

std::string line_of(const std::vector<std::string>& command) {
  std::vector<std::string> quoted;
  for (const std::string& word : command) quoted.push_back(shell_quoted(word));
  return join(quoted, " ");
}

}  // namespace

// Arrays of those that need nothing, then of those that need these, and so on; Slurm has the later ones wait.
void SlurmJobs::submit_what_can() {
  if (with_slurm() == 0 && room_ == 0) {  // there is nothing whose end could be waited for
    room_.reset();
    is_probe_ = false;
  }
  // Each array waits for all before it where only some may be at work at once: small ones would go one by one.
  const std::size_t worth = std::min(static_cast<std::size_t>(options_.at_once), not_taken());
  if (room_ && with_slurm() > 0 && *room_ < worth) return;
  while (may_submit()) {
    bool dropped = false;
    const std::vector<Wanted> some = wanted(dropped);
    if (some.empty() && !dropped) return;
    if (!some.empty() && !submit(some)) return;
  }
}

std::vector<Wanted> SlurmJobs::wanted(bool& dropped) {
  std::vector<Wanted> all;
  for (std::size_t k = 0; k < own_.size(); ++k) {
    Own& own = own_[k];
    if (own.at != At::start) continue;
    const Turn turn = events_->turn_of(k);
    if (turn == Turn::never) {
      own.at = At::over;
      dropped = true;
      continue;
    }
    own.may_begin = turn == Turn::now;
    Wanted each{k, {}, line_of((*jobs_)[k].command).size()};
    bool is_ready = true;
    for (const std::size_t need : (*jobs_)[k].needs) {
      if (own_[need].at == At::queued) each.needs.push_back(need);
      is_ready = is_ready && own_[need].at != At::start;
    }
    if (is_ready && (turn == Turn::now || !each.needs.empty())) all.push_back(std::move(each));
  }
  return all;
}

/// Whether all were taken.
bool SlurmJobs::submit(const std::vector<Wanted>& wanted) {
  const auto at_once = static_cast<std::size_t>(options_.at_once);
  std::vector<std::size_t> others;
  for (std::size_t k = 0; k < own_.size(); ++k)
    if (own_[k].at == At::queued) others.push_back(k);
  const std::size_t tasks = room_ ? std::min(limits_.tasks, *room_) : limits_.tasks;
  const std::vector<Piece> pieces = pieces_of(wanted, tasks, limits_.bytes, at_once, others);
  std::vector<std::string> numbers;
  for (const Piece& piece : pieces) {
    std::vector<std::string> behind;
    for (const std::size_t other : piece.behind) behind.push_back(numbers[other]);
    numbers.push_back(submit_some(piece, behind));
    if (!may_submit()) return false;
  }
  return true;
}

/// All of it or, where Slurm takes no more, a part; the number of the job.
std::string SlurmJobs::submit_some(Piece piece, const std::vector<std::string>& behind) {
  if (room_) piece.jobs.resize(std::min(piece.jobs.size(), *room_));
  for (;;) {
    const Submission done = submit_piece(piece, behind);
    if (!done.job.empty()) {
      note_taken(piece.jobs.size());
      return done.job;
    }
    if (done.is_unsure) {
      options_.say("Slurm does not answer: " + done.refusal + "; it is asked again");
      is_unsure_ = true;
      heard_since_.reset();
      return "";
    }
    room_ = 0;
    if (piece.jobs.size() == 1 && with_slurm() == 0) throw MachineFailure("error: Slurm takes no job: " + done.refusal);
    if (!full_was_told_) options_.say("Slurm takes no more jobs now; the rest is submitted as others end");
    full_was_told_ = true;
    if (piece.jobs.size() == 1 || is_probe_) return "";
    piece.jobs.resize(piece.jobs.size() / 2);
  }
}

// Where it took all that there was room for, there may be room for more: jobs of others end, too.
void SlurmJobs::note_taken(std::size_t jobs) {
  if (!room_) return;
  *room_ -= std::min(*room_, jobs);
  is_probe_ = *room_ == 0;
  if (is_probe_) room_ = jobs;
}

Submission SlurmJobs::submit_piece(const Piece& piece, const std::vector<std::string>& behind) {
  std::vector<std::string> names;
  for (const std::size_t job : piece.jobs) names.push_back((*jobs_)[job].name);
  const std::string word = ledger_.intend(names);
  Submission done = controller_.submit(options_of(piece, behind, word), script_of(piece), ledger_.descriptor());
  if (!done.is_unsure) ledger_.answered(word, done.job);
  if (done.job.empty() && !done.is_limit && !done.is_unsure)
    throw MachineFailure(fmt::format("error: Slurm refuses the jobs: {}{}", done.refusal,
                                     with_slurm() > 0 ? "; those that it has taken before go on" : ""));
  if (done.job.empty()) return done;
  for (std::size_t task = 0; task < piece.jobs.size(); ++task) {
    Own& own = own_[piece.jobs[task]];
    own.at = At::queued;
    own.place = {word, task};
    own.array = done.job;
  }
  return done;
}

std::vector<std::string> SlurmJobs::options_of(const Piece& piece, const std::vector<std::string>& behind,
                                               const std::string& word) const {
  std::string array = fmt::format("--array=0-{}", piece.jobs.size() - 1);
  if (piece.at_once > 0) array += fmt::format("%{}", piece.at_once);
  // The script itself says where its output goes: a path in an option of sbatch has patterns.
  std::vector<std::string> options{"--job-name=beadwork", "--requeue", "--output=/dev/null"};
  options.insert(options.end(), options_.sbatch.begin(), options_.sbatch.end());
  options.insert(options.end(), {array, "--comment=" + word, fmt::format("--cpus-per-task={}", options_.threads)});
  const std::string dependency = dependency_of(piece, behind);
  if (!dependency.empty()) options.push_back("--dependency=afterany" + dependency);
  return options;
}

// However they end: a job whose needs are not done says so and ends, which a job that never may begin could not.
std::string SlurmJobs::dependency_of(const Piece& piece, const std::vector<std::string>& behind) const {
  constexpr std::size_t most_tasks = 50;  // beyond that whole arrays are named
  std::set<std::string> whole(behind.begin(), behind.end()), tasks;
  for (const std::size_t need : piece.needs) {
    if (options_.at_once > 0 || piece.needs.size() > most_tasks)
      whole.insert(own_[need].array);
    else
      tasks.insert(fmt::format("{}_{}", own_[need].array, task(own_[need])));
  }
  tasks.merge(whole);
  std::string text;
  for (const std::string& each : tasks)
    if (!each.empty()) text += ":" + each;
  return text;
}

std::string SlurmJobs::script_of(const Piece& piece) const {
  std::string script = fmt::format(
      "#!/bin/bash\n"
      "stem={}/${{SLURM_ARRAY_JOB_ID}}_$SLURM_ARRAY_TASK_ID\n"
      "exec >>\"$stem.log\" 2>&1\n"
      "case $SLURM_ARRAY_TASK_ID in\n",
      shell_quoted(options_.desk.string()));
  for (std::size_t task = 0; task < piece.jobs.size(); ++task)
    script += fmt::format("{}) exec {} --note \"$stem.note\" ;;\n", task, line_of((*jobs_)[piece.jobs[task]].command));
  return script + "esac\n";
}

}  // namespace beadwork::slurm
