// Runs while somebody sees to them, wherever that is: whose turn it is, what is told, and the table of what came of them.

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <map>
#include <set>

#include "core/base/failure.hpp"
#include "core/loop/job_driver.hpp"
#include "workbench/batch.hpp"
#include "workbench/progress.hpp"
#include "workbench/terminal.hpp"

namespace beadwork {

namespace {

class Attendance final : public JobEvents {
  using Clock = std::chrono::steady_clock;

 public:
  Attendance(std::vector<BatchRun>& runs, OwnFolder& folder, Command command)
      : runs_(runs), folder_(folder), command_(std::move(command)) {
    std::map<std::size_t, std::size_t> job_of;
    for (std::size_t k = 0; k < runs_.size(); ++k) {
      BatchRun& run = runs_[k];
      if (run.done || run.refused) {
        ++ended_;
        continue;
      }
      job_of[k] = jobs_.size();
      waiting_.push_back(&run);
      jobs_.push_back({run.name, run.folder, command_(run)});
    }
    for (std::size_t job = 0; job < jobs_.size(); ++job)
      for (const std::size_t need : waiting_[job]->needs)
        if (const auto found = job_of.find(need); found != job_of.end()) jobs_[job].needs.push_back(found->second);
  }

  void attend(JobDriver& driver) {
    write();
    driver.run(jobs_, *this);
    progress_.hide();
    for (BatchRun* run : waiting_)
      if (run->code < 0) note_row(*run);
    write();
  }

 private:
  // Runs that have ended are not read again, and long tables are not written at each end: there may be many.
  void write_now_and_then() {
    constexpr std::size_t few = 300;
    constexpr std::chrono::seconds patience{5};
    if (runs_.size() <= few || Clock::now() - written_ > patience) write();
  }

  void write() {
    written_ = Clock::now();
    for (const std::size_t job : at_work_) note_row(*waiting_[job]);
    write_tables(runs_, folder_);
  }

  Turn turn_of(std::size_t job) override {
    BatchRun& run = *waiting_[job];
    bool is_early = false;
    for (const std::size_t need : run.needs) {
      const BatchRun& other = runs_[need];
      if (other.done) continue;
      const bool may_come = other.code < 0 && !other.refused;
      if (!may_come) {
        skip(run, other);
        return Turn::never;
      }
      is_early = true;
    }
    if (is_early) return Turn::later;
    if (!run.postponed) return Turn::now;
    const Turn turn = turn_after_check(run);
    jobs_[job].command = command_(run);  // now it is known whether it is a calibration
    return turn;
  }

  /// What it needs is there now, and so its deck can be read.
  Turn turn_after_check(BatchRun& run) {
    DeckChecks checks;
    checks.check(run, runs_);
    if (run.refused) {
      progress_.hide();
      write_error(checks.text(runs_.size()));
      count_ended(run, "refused");
      return Turn::never;
    }
    if (!run.done) return Turn::now;
    run.code = 0;
    count_ended(run, "done already");
    return Turn::never;
  }

  void skip(BatchRun& run, const BatchRun& needed) {
    run.missing = needed.name;
    run.code = needed.code;
    note_row(run);
    count_ended(run, fmt::format("skipped: it needs '{}', which is not done", needed.name));
  }

  void began(std::size_t job) override { at_work_.insert(job); }

  void ended(std::size_t job, const JobEnd& end) override {
    BatchRun& run = *waiting_[job];
    at_work_.erase(job);
    run.code = end.code;
    const std::string by = end.by.empty() ? "" : " (" + end.by + ")";
    if (run.code == static_cast<int>(ExitCode::interrupted))
      note_done(run, fmt::format("interrupted{}, goes on when the same command is given again", by));
    else
      note_done(run, run.code == 0 ? "done" : fmt::format("{}{}, see {}", end.how, by, log_of(run, end)));
  }

  /// Where it says what went wrong: it may not have come as far as its own log.
  static std::string log_of(const BatchRun& run, const JobEnd& end) {
    std::error_code error;
    const std::filesystem::path own = run.folder / "run.log";
    return (end.log.empty() || std::filesystem::exists(own, error) ? own : end.log).string();
  }

  void is_held_up(std::size_t job, const std::string& why) override {
    tell(fmt::format("{}: {}", waiting_[job]->name, why));
  }

  void said(std::size_t /*job*/, const std::string& text) override {
    progress_.hide();
    write_error(text);
  }

  bool was_done_elsewhere(std::size_t job) override {
    BatchRun& run = *waiting_[job];
    if (!is_done(run)) return false;
    run.code = 0;
    note_done(run, "done");
    return true;
  }

  void at_work(const std::vector<JobShare>& jobs) override {
    if (jobs_.empty()) return;
    std::vector<Progress::Part> parts;
    for (const JobShare& each : jobs) parts.push_back({jobs_[each.job].name, each.share});
    progress_.show({.work = "batch",
                    .detail = fmt::format("{} of {} runs done, {} at work", ended_, runs_.size(), jobs.size()),
                    .share = (static_cast<double>(here_) + sum_of(jobs)) / static_cast<double>(jobs_.size())},
                   parts);
  }

  void note_done(BatchRun& run, const std::string& how) {
    run.done = run.code == 0;
    run.results = results_of(run.folder);
    note_row(run);
    count_ended(run, how);
  }

  void count_ended(const BatchRun& run, const std::string& how) {
    ++ended_;
    ++here_;
    tell(fmt::format("[{}/{}] {}: {}", ended_, runs_.size(), run.name, how));
    write_now_and_then();
  }

  void tell(const std::string& line) {
    progress_.hide();
    beadwork::say("{}\n", line);
    std::fflush(stdout);
  }

  std::vector<BatchRun>& runs_;
  OwnFolder& folder_;
  Command command_;
  std::vector<BatchRun*> waiting_;
  std::vector<Job> jobs_;  // of these, in their order
  std::set<std::size_t> at_work_;
  std::size_t ended_ = 0, here_ = 0;
  Clock::time_point written_;
  Progress progress_{[](const std::string& line) {
    beadwork::say("{}\n", line);
    std::fflush(stdout);
  }};
};

}  // namespace

void attend(std::vector<BatchRun>& runs, OwnFolder& folder, JobDriver& driver, const Command& command) {
  Attendance(runs, folder, command).attend(driver);
}

}  // namespace beadwork
