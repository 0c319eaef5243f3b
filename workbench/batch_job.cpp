// `job`: one run of a batch, as a job that a queue starts on some machine. Nobody types it.

#include <fmt/format.h>

#include <chrono>
#include <thread>

#include "core/base/failure.hpp"
#include "core/loop/former_run.hpp"
#include "core/loop/local_jobs.hpp"
#include "workbench/batch.hpp"
#include "workbench/signals.hpp"
#include "workbench/slurm/note.hpp"
#include "workbench/terminal.hpp"

namespace beadwork {

namespace {

using Clock = std::chrono::steady_clock;

struct JobArguments {
  DeckArguments deck;
  std::string out, batch, label, note;
  std::string as = "either";       // run, calibrate, or either: whatever the deck turns out to be
  std::vector<std::string> needs;  // folders of runs that are to be done before
  int threads = 1;
  bool quiet = false;
};

/// Notes what is told of the one job.
class Notes final : public JobEvents {
 public:
  explicit Notes(const JobArguments& arguments) : arguments_(arguments) { write({0, {}}); }

  void ended(std::size_t /*job*/, const JobEnd& end) override { note_end(end); }
  void note_end(const JobEnd& end) {
    end_ = end;
    write({1, end});
  }
  void is_held_up(std::size_t /*job*/, const std::string& why) override {
    say_error("[{}] {}\n", arguments_.label, why);
  }
  bool was_done_elsewhere(std::size_t /*job*/) override {
    if (!FormerRun(arguments_.out).is_done()) return false;
    note_end({0, "done"});
    return true;
  }
  void at_work(const std::vector<JobShare>& jobs) override {
    constexpr std::chrono::seconds rarely{2};
    constexpr double little = 0.001;
    const double share = sum_of(jobs);
    if (share - told_ < little || Clock::now() - written_ < rarely) return;
    told_ = share;
    write({share, {}});
  }
  bool has_ended() const { return end_.code >= 0; }
  int code() const { return end_.code; }

 private:
  // A disk that takes no note may still take the run.
  void write(const slurm::Note& note) {
    written_ = Clock::now();
    try {
      slurm::write_note(arguments_.note, note);
    } catch (const Fault& fault) {
      say_error("[{}] warning: {}\n", arguments_.label, fault.what());
    }
  }

  const JobArguments& arguments_;
  JobEnd end_;
  double told_ = 0;
  Clock::time_point written_;
};

/// The run that is needed and is not done. One that another machine has just left may be seen late.
std::string missing(const std::vector<std::string>& folders) {
  constexpr std::chrono::seconds patience{20};
  const auto until = Clock::now() + patience;
  for (const std::string& folder : folders)
    for (;;) {
      const std::string status = FormerRun(folder).text("status");
      if (status == "done") break;
      if (status == "failed" || status == "interrupted" || Clock::now() > until || interrupted) return folder;
      std::this_thread::sleep_for(std::chrono::milliseconds(500));
    }
  return "";
}

/// Those that it needs, which are done, and itself at their end.
std::vector<BatchRun> runs_of(const JobArguments& arguments) {
  std::vector<BatchRun> runs;
  for (const std::string& folder : arguments.needs) {
    runs.emplace_back();
    runs.back().folder = folder;
    runs.back().done = true;
  }
  BatchRun run;
  run.name = run.title = arguments.label;
  run.folder = arguments.out;
  run.deck = arguments.deck;
  run.is_study = arguments.as == "calibrate";
  run.options = options_of(run, arguments.threads, arguments.batch);
  for (std::size_t k = 0; k < runs.size(); ++k) run.needs.push_back(k);
  runs.push_back(std::move(run));
  return runs;
}

/// Nothing if it is to run.
std::optional<JobEnd> end_before(const JobArguments& arguments, BatchRun& run, const std::vector<BatchRun>& all) {
  if (const std::string need = missing(arguments.needs); !need.empty())
    return JobEnd{static_cast<int>(ExitCode::machine), fmt::format("needs '{}', which is not done", need)};
  if (arguments.as != "either") return std::nullopt;
  DeckChecks checks;
  checks.check(run, all);
  if (run.done) return JobEnd{0, "done already"};
  write_error(checks.text(1));
  if (run.refused) return JobEnd{run.code, "its deck has mistakes"};
  return std::nullopt;
}

int job(const JobArguments& arguments) {
  heed_signals();
  Notes notes(arguments);
  std::vector<BatchRun> all = runs_of(arguments);
  BatchRun& run = all.back();
  if (const auto end = end_before(arguments, run, all)) {
    notes.note_end(*end);
    return end->code;
  }
  LocalJobs(1, Voice::heard, &interrupted).run({{run.name, run.folder, command_of(run)}}, notes);
  if (!notes.has_ended()) notes.note_end({static_cast<int>(ExitCode::interrupted), "interrupted before it began"});
  return notes.code();
}

}  // namespace

void add_job(CLI::App& app, Chosen& chosen) {
  CLI::App* verb = app.add_subcommand("job", "One run of a batch in a queue")->group("");
  auto arguments = std::make_shared<JobArguments>();
  arguments->deck.add_to(*verb);
  verb->add_option("--out", arguments->out)->required();
  verb->add_option("--note", arguments->note)->required();
  verb->add_option("--as", arguments->as)->check(CLI::IsMember({"run", "calibrate", "either"}));
  verb->add_option("--need", arguments->needs)->allow_extra_args(false);
  verb->add_option("--threads", arguments->threads);
  verb->add_option("--batch", arguments->batch);
  verb->add_option("--label", arguments->label);
  verb->add_flag("--quiet", arguments->quiet);
  verb->callback([&chosen, arguments] { chosen = [arguments] { return job(*arguments); }; });
}

}  // namespace beadwork
