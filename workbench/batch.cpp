#include "workbench/batch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <map>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"
#include "core/io/file.hpp"
#include "core/loop/local_jobs.hpp"
#include "workbench/terminal.hpp"

namespace beadwork {

namespace fs = std::filesystem;

namespace {

struct BatchArguments {
  DeckArguments deck;  // without its path
  std::vector<std::string> decks;
  std::string out, engine = "local";
  std::vector<std::string> variations;
  Words words;
  int jobs = 0, threads = 0;
  bool keep_going = false;
};

Shares shares_of(const BatchArguments& arguments, std::size_t runs) {
  const Shares wanted{arguments.jobs, arguments.threads};
  if (arguments.engine == "slurm") return {wanted.jobs, std::max(1, wanted.threads)};  // processors of other machines
  return wanted.among(runs);
}

/// Which deck it is varies first where there are several.
constexpr const char* deck_column = "deck";

std::string name_of(const std::string& deck) { return fs::path(deck).stem().string(); }

BatchRun run_of(const BatchArguments& arguments, const std::string& deck, const std::vector<Variation>& variations,
                const std::vector<std::string>& values) {
  BatchRun run;
  run.name = folder_name(variations, values);
  run.values = values;
  run.folder = fs::absolute(arguments.out) / run.name;
  run.deck = arguments.deck;
  run.deck.path = deck;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::string setting = variations[k].name + "=" + values[k];
    if (k > 0 || arguments.decks.size() == 1) run.deck.settings.push_back(setting);
    run.title += (k ? ", " : "") + setting;
  }
  if (values.empty()) run.title = run.name;
  return run;
}

void write_command(BatchRun& run, int threads, const Words& words) {
  run.command = {fs::canonical("/proc/self/exe").string(),
                 "run",
                 fs::absolute(run.deck.path).string(),
                 "--quiet",
                 "--label",
                 run.name,
                 "--batch",
                 command_line(words),
                 "--out",
                 run.folder.string(),
                 "--threads",
                 std::to_string(threads),
                 "--resume-or-begin"};
  for (const std::string& setting : run.deck.settings) run.command.insert(run.command.end(), {"--set", setting});
  if (run.deck.no_plugins) run.command.push_back("--no-plugins");
  for (const std::string& library : run.deck.libraries)
    run.command.insert(run.command.end(), {"--plugins", fs::absolute(library).string()});
}

std::vector<BatchRun> runs_of(const BatchArguments& arguments, const std::vector<Variation>& variations) {
  std::vector<BatchRun> runs;
  const auto all = combinations(variations);  // all of the first deck, then of the second ...
  const std::size_t each = all.size() / arguments.decks.size();
  for (std::size_t k = 0; k < all.size(); ++k)
    runs.push_back(run_of(arguments, arguments.decks[k / each], variations, all[k]));
  std::map<std::string, const BatchRun*> by_folder;
  for (const BatchRun& run : runs)
    if (const auto [twin, is_new] = by_folder.emplace(run.name, &run); !is_new)
      throw DeckFailure(fmt::format(
          "error: the runs with {} and with {} would write the same folder, '{}': give values, and decks, whose names "
          "differ in letters and digits",
          shell_quoted(twin->second->title), shell_quoted(run.title), (fs::path(arguments.out) / run.name).string()));
  return runs;
}

std::vector<Variation> variations_of(const BatchArguments& arguments) {
  std::vector<Variation> variations;
  if (arguments.decks.size() > 1) {
    variations.push_back({deck_column, {}});
    for (const std::string& deck : arguments.decks) variations.back().values.push_back(name_of(deck));
  }
  for (const std::string& text : arguments.variations) {
    variations.push_back(variation_of(text));
    for (std::size_t k = 0; k + 1 < variations.size(); ++k)
      if (variations[k].name == variations.back().name)
        throw DeckFailure(fmt::format("error: --vary {} is given twice", variations[k].name));
  }
  return variations;
}

int batch(const BatchArguments& arguments) {
  const std::vector<Variation> variations = variations_of(arguments);
  std::vector<BatchRun> runs = runs_of(arguments, variations);
  const auto [refused, mistakes] = check_decks(runs);
  write_error(mistakes);
  if (refused > 0 && !arguments.keep_going) {
    write_error(refused < runs.size() ? "nothing was run; --keep-going runs the others\n" : "nothing was run\n");
    return worst(runs);
  }
  const auto count = [&](const auto& which) {
    return static_cast<std::size_t>(std::count_if(runs.begin(), runs.end(), which));
  };
  const std::size_t done = count([](const BatchRun& run) { return run.done; });
  const std::size_t outdated = count([](const BatchRun& run) { return run.outdated; });
  OwnFolder folder(arguments.out, Manifest::Of::batch);
  const Shares shares = shares_of(arguments, runs.size() - done - refused);
  for (BatchRun& run : runs) write_command(run, shares.threads, arguments.words);
  say("{} runs, {} of them done already{}\n", runs.size(), done, refused ? fmt::format(", {} refused", refused) : "");
  if (outdated > 0) say("{} of them were done with other data files, and are run again\n", outdated);
  std::fflush(stdout);
  const fs::path table = folder.claim("batch.csv");
  if (arguments.engine == "slurm") {
    write_atomically(table, batch_table(variations, runs));
    submit_to_slurm(runs, shares.jobs, shares.threads, folder);
    std::erase_if(runs, [](const BatchRun& run) { return !run.refused; });  // the others have not run yet
    return worst(runs);
  }
  run_here(runs, shares.jobs, variations, table);
  if (worst(runs) == static_cast<int>(ExitCode::interrupted))
    say("interrupted; go on with: {}\n", command_line(arguments.words));
  say("{}\n", table.string());
  return worst(runs);
}

}  // namespace

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
  verb->add_flag("--keep-going", arguments->keep_going, "Runs those whose decks are in order, though others are not");
  verb->add_option("--engine", arguments->engine, "local: processes of this machine; slurm: an array of jobs")
      ->check(CLI::IsMember({"local", "slurm"}))
      ->capture_default_str();
  verb->callback([&chosen, arguments] { chosen = [arguments] { return batch(*arguments); }; });
}

}  // namespace beadwork
