#include "workbench/batch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <optional>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"
#include "core/io/file.hpp"
#include "core/loop/local_jobs.hpp"
#include "workbench/batch_claims.hpp"
#include "workbench/signals.hpp"
#include "workbench/slurm/queue.hpp"
#include "workbench/terminal.hpp"

namespace beadwork {

namespace fs = std::filesystem;

namespace {

struct BatchArguments {
  DeckArguments deck;  // without its path
  std::vector<std::string> decks;
  std::string out, engine = "local";
  std::vector<std::string> variations;
  std::vector<std::string> sbatch;
  Words words;
  int jobs = 0, threads = 0, most_runs = 10000;
  bool keep_going = false, no_wait = false, dry_run = false;
  bool is_slurm() const { return engine == "slurm"; }
};

Shares shares_of(const BatchArguments& arguments, std::size_t runs) {
  const Shares wanted{arguments.jobs, arguments.threads};
  if (arguments.is_slurm()) return {wanted.jobs, std::max(1, wanted.threads)};  // processors of other machines
  return wanted.among(runs);
}

bool has_study(const Node& root) {
  return std::any_of(root.children.begin(), root.children.end(),
                     [](const auto& section) { return section->tag == "study"; });
}

bool names_sweeps(const Node& root) {
  return std::any_of(root.children.begin(), root.children.end(), [](const auto& section) {
    return section->tag == "study" && std::any_of(section->children.begin(), section->children.end(),
                                                  [](const auto& child) { return child->tag == "sweep"; });
  });
}

/// What a deck says whose study is a batch; nothing if it is no such deck.
std::optional<BatchPlan> plan_of_study(const BatchArguments& arguments) {
  if (arguments.decks.size() != 1) return std::nullopt;
  DeckArguments deck = arguments.deck;
  deck.path = arguments.decks.front();
  const DeckRequest request = deck.request();
  Complaints unheard, complaints;
  const auto read = read_deck(request.path, request.overrides, unheard);
  if (!read || !has_study(*read->root)) return std::nullopt;  // what is wrong with it is told as that of a run
  const Loaded loaded = load_scene(request, complaints);
  if (!loaded.scene && names_sweeps(*read->root)) complaints.throw_if_any();
  if (!loaded.scene || !loaded.scene->studies.front()->is_of_batch()) return std::nullopt;
  if (!arguments.variations.empty())
    refuse(loaded.scene->studies.front()->at(),
           "this deck says itself what varies, and takes no --vary; --set gives its parameters other values");
  BatchPlan plan;
  for (const Study* study : loaded.scene->studies) study->add_to(plan);
  if (plan.lists.empty())
    refuse(loaded.scene->studies.front()->at(),
           "this study expects something of runs and has none: it wants a <sweep>");
  return plan;
}

void refuse_too_many(const std::vector<RunList>& lists, int most) {
  std::size_t runs = 0;
  for (const RunList& list : lists) runs += list.decks.size() * list.rows.size();
  if (runs > static_cast<std::size_t>(most))
    throw DeckFailure(
        fmt::format("error: these are {} runs, more than {}; if they are meant: --most-runs {}", runs, most, runs));
}

struct Batch {
  BatchPlan plan;
  std::vector<BatchRun> runs;
};

Batch batch_of(const BatchArguments& arguments) {
  DeckArguments common = arguments.deck;
  auto plan = plan_of_study(arguments);
  if (plan) {
    common.settings.clear();  // they were for the study
    common.files.clear();
  } else {
    std::vector<Variation> variations;
    for (const std::string& text : arguments.variations) variations.push_back(variation_of(text));
    plan = BatchPlan{{list_of(arguments.decks, variations)}, {}, {}};
  }
  refuse_too_many(plan->lists, arguments.most_runs);
  std::vector<BatchRun> runs = runs_of(plan->lists, common, arguments.out);
  refuse_claims_of_none(*plan, runs);
  return {std::move(*plan), std::move(runs)};
}

void attend_here(std::vector<BatchRun>& runs, OwnFolder& folder, int at_once, const Words& words) {
  const bool begins_some =
      std::any_of(runs.begin(), runs.end(), [](const BatchRun& r) { return !r.done && !r.refused; });
  if (begins_some) refuse_where_slurm_is_at_work(folder.root());
  heed_signals();
  LocalJobs driver(at_once, Voice::heard, &interrupted);
  attend(runs, folder, driver, command_of);
  if (worst(runs) == static_cast<int>(ExitCode::interrupted)) say("interrupted; go on with: {}\n", command_line(words));
}

int batch(const BatchArguments& arguments) {
  const std::vector<std::string> sbatch = slurm::user_options(arguments.sbatch);
  auto [plan, runs] = batch_of(arguments);
  DeckChecks checks;
  checks.check_all(runs);
  const std::size_t refused = checks.refused();
  write_error(checks.text(runs.size()));
  if (refused > 0 && !arguments.keep_going && !arguments.dry_run) {
    write_error(refused < runs.size() ? "nothing was run; --keep-going runs the others\n" : "nothing was run\n");
    return worst(runs);
  }
  const auto count = [&](const auto& which) {
    return static_cast<std::size_t>(std::count_if(runs.begin(), runs.end(), which));
  };
  const std::size_t done = count([](const BatchRun& run) { return run.done; });
  const std::size_t outdated = count([](const BatchRun& run) { return run.outdated; });
  if (arguments.dry_run) {
    say("{}{} runs, {} of them done already\n", outlook_on(runs), runs.size(), done);
    return refused > 0 ? worst(runs) : 0;
  }
  OwnFolder folder(arguments.out, Manifest::Of::batch);
  const ClaimFiles claims(plan, folder);
  const Shares shares = shares_of(arguments, runs.size() - done - refused);
  for (BatchRun& run : runs) run.options = options_of(run, shares.threads, command_line(arguments.words));
  say("{} runs, {} of them done already{}\n", runs.size(), done, refused ? fmt::format(", {} refused", refused) : "");
  if (outdated > 0) say("{} of them were done with other data files, and are run again\n", outdated);
  std::fflush(stdout);
  if (arguments.is_slurm())
    attend_in_slurm(runs, folder, {shares.jobs, shares.threads, sbatch, !arguments.no_wait, arguments.words});
  else
    attend_here(runs, folder, shares.jobs, arguments.words);
  claims.write(runs);
  say("{}\n", (folder.root() / "batch.csv").string());
  if (arguments.no_wait)
    std::erase_if(runs, [](const BatchRun& run) { return !run.done && run.code < 0; });  // nobody knows yet
  return worst(runs);
}

}  // namespace

std::vector<std::string> options_of(const BatchRun& run, int threads, const std::string& batch) {
  std::vector<std::string> options{fs::absolute(run.deck.path).string(),
                                   "--quiet",
                                   "--label",
                                   run.name,
                                   "--batch",
                                   batch,
                                   "--out",
                                   run.folder.string(),
                                   "--threads",
                                   std::to_string(threads)};
  for (const Override& each : run.deck.request().overrides)
    options.insert(options.end(), {"--set", each.name + "=" + each.value});
  if (run.deck.no_plugins) options.emplace_back("--no-plugins");
  for (const std::string& library : run.deck.libraries)
    options.insert(options.end(), {"--plugins", fs::absolute(library).string()});
  return options;
}

std::vector<std::string> command_of(const BatchRun& run) {
  std::vector<std::string> command{fs::canonical("/proc/self/exe").string(), run.is_study ? "calibrate" : "run"};
  command.insert(command.end(), run.options.begin(), run.options.end());
  if (run.is_study)
    command.insert(command.end(), {"--jobs", "1"});
  else
    command.emplace_back("--resume-or-begin");
  return command;
}

int worst(const std::vector<BatchRun>& runs) {
  const std::vector<int> mildest_first{0, 5, 2, 3, 4, 1};
  const auto rank = [&](int code) {
    return std::find(mildest_first.begin(), mildest_first.end(), code) - mildest_first.begin();
  };
  int code = 0;
  for (const BatchRun& run : runs) {
    const int own = run.done ? 0 : run.code < 0 ? 5 : run.code;
    if (rank(own) > rank(code)) code = own;
  }
  return code;
}

void add_batch(CLI::App& app, Chosen& chosen, const Words& words) {
  CLI::App* verb =
      app.add_subcommand("batch", "Runs decks, each with many values of its parameters, and tabulates the results");
  verb->footer(
      "Example: beadwork batch deck.xml --out out/sweep --vary 'young=30 GPa,40 GPa' --vary seed=1,2,3 --jobs 2\n"
      "Give the same command again: what is done is left alone, what was interrupted or ran out of disk goes on, the "
      "rest begins anew.\n"
      "A deck with <study><sweep .../></study> says itself which decks run with which values, and which wait for "
      "which: "
      "beadwork batch study.xml --out out/study\n"
      "Several decks, 'beadwork batch decks/*.xml --out out/all', share one table: its column 'deck' has their names.\n"
      "beadwork report out/sweep lays the curves of the runs over one another.");
  auto arguments = std::make_shared<BatchArguments>();
  arguments->words = words;
  verb->add_option("deck", arguments->decks, "The decks, XML files")->required();
  arguments->deck.add_options_to(*verb);
  verb->add_option("--out", arguments->out, "Folder for the runs, one folder each, and for batch.csv")->required();
  verb->add_option("--vary", arguments->variations,
                   "Values of a parameter: name=value,value,...; several give all combinations")
      ->allow_extra_args(false);
  verb->add_option("--jobs", arguments->jobs, "Runs at once; where absent as many as there are processors for")
      ->check(CLI::Range(1, 1024));
  verb->add_option("--threads", arguments->threads,
                   "Threads of each run; where absent the processors that it may use, shared out among the runs at "
                   "once, and 1 with Slurm")
      ->check(CLI::Range(1, 1024));
  verb->add_option("--most-runs", arguments->most_runs, "Refuses more runs than these")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  verb->add_flag("--dry-run", arguments->dry_run, "Checks all decks and tells what would be run, and runs nothing");
  verb->add_flag("--keep-going", arguments->keep_going, "Runs those whose decks are in order, though others are not");
  CLI::Option* engine = verb->add_option("--engine", arguments->engine,
                                         "local: processes of this machine; slurm: arrays of jobs, which go on "
                                         "without this command, and which the same command follows")
                            ->check(CLI::IsMember({"local", "slurm"}))
                            ->capture_default_str();
  verb->add_option("--sbatch", arguments->sbatch,
                   "Options for sbatch, such as '--partition=long --time=4:00:00'; several add up")
      ->allow_extra_args(false)
      ->needs(engine);
  verb->add_flag("--no-wait", arguments->no_wait, "Submits to Slurm and leaves")->needs(engine);
  verb->callback([&chosen, arguments] { chosen = [arguments] { return batch(*arguments); }; });
}

}  // namespace beadwork
