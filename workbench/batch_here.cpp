// Runs as processes of this machine, and the table of what came of them.

#include <cstdio>
#include <set>

#include "core/base/failure.hpp"
#include "core/io/file.hpp"
#include "core/loop/local_jobs.hpp"
#include "workbench/batch.hpp"
#include "workbench/progress.hpp"
#include "workbench/signals.hpp"
#include "workbench/terminal.hpp"

namespace beadwork {

namespace {

namespace fs = std::filesystem;

class Here final : public JobEvents {
 public:
  Here(std::vector<BatchRun>& runs, const std::vector<Variation>& variations, const fs::path& table)
      : runs_(runs), variations_(variations), table_(table) {
    for (BatchRun& run : runs_) {
      if (run.done || run.refused) {
        ++ended_;
        continue;
      }
      waiting_.push_back(&run);
      jobs_.push_back({run.name, run.folder, run.command});
    }
  }

  void attend(int at_once) {
    write();
    run_jobs(jobs_, at_once, Voice::heard, &interrupted, *this);
    for (BatchRun* run : waiting_)
      if (run->code < 0) note_row(*run);
    write();
  }

 private:
  // Runs that have ended are not read again: there may be many.
  void write() {
    for (const std::size_t job : at_work_) note_row(*waiting_[job]);
    write_atomically(table_, batch_table(variations_, runs_));
  }

  void began(std::size_t job) override { at_work_.insert(job); }

  void ended(std::size_t job, const JobEnd& end) override {
    BatchRun& run = *waiting_[job];
    at_work_.erase(job);
    run.code = end.code;
    const std::string log = (run.folder / "run.log").string();
    if (run.code == static_cast<int>(ExitCode::interrupted))
      note_done(run, "interrupted, goes on when the same command is given again");
    else
      note_done(run, run.code == 0 ? "done" : fmt::format("{}, see {}", end.how, log));
  }

  void is_written_elsewhere(std::size_t job, const std::string& by) override {
    tell(fmt::format("{}: {} is still writing this run; waiting", waiting_[job]->name, by));
  }

  bool was_done_elsewhere(std::size_t job) override {
    BatchRun& run = *waiting_[job];
    if (!is_done(run)) return false;
    run.code = 0;
    note_done(run, "done");
    return true;
  }

  void at_work(std::size_t jobs, double shares) override {
    if (jobs_.empty()) return;
    progress_.show({.work = "batch",
                    .detail = fmt::format("{} of {} runs done, {} at work", ended_, runs_.size(), jobs),
                    .share = (static_cast<double>(here_) + shares) / static_cast<double>(jobs_.size())});
  }

  void note_done(BatchRun& run, const std::string& how) {
    run.done = run.code == 0;
    run.results = results_of(run.folder);
    note_row(run);
    ++ended_;
    ++here_;
    tell(fmt::format("[{}/{}] {}: {}", ended_, runs_.size(), run.name, how));
    write();
  }

  void tell(const std::string& line) {
    progress_.hide();
    beadwork::say("{}\n", line);
    std::fflush(stdout);
  }

  std::vector<BatchRun>& runs_;
  const std::vector<Variation>& variations_;
  const fs::path table_;
  std::vector<BatchRun*> waiting_;
  std::vector<LocalJob> jobs_;  // of these, in their order
  std::set<std::size_t> at_work_;
  std::size_t ended_ = 0, here_ = 0;
  Progress progress_{[](const std::string& line) {
    beadwork::say("{}\n", line);
    std::fflush(stdout);
  }};
};

}  // namespace

void run_here(std::vector<BatchRun>& runs, int at_once, const std::vector<Variation>& variations,
              const fs::path& table) {
  heed_signals();
  Here(runs, variations, table).attend(at_once);
}

}  // namespace beadwork
