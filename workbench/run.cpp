#include "core/loop/run.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>

#include "core/base/failure.hpp"
#include "core/base/processors.hpp"
#include "core/base/text.hpp"
#include "core/loop/former_run.hpp"
#include "core/version.hpp"
#include "workbench/progress.hpp"
#include "workbench/run_log.hpp"
#include "workbench/signals.hpp"
#include "workbench/verbs.hpp"

namespace beadwork {

namespace {

struct RunArguments {
  DeckArguments deck;
  std::string out, batch;
  Words words;
  std::string label;  // of a run that a batch has started: stands before its lines
  int tell = -1;      // socket that takes how far it has come; -1 if nobody asks
  bool overwrite = false, resume = false, resume_or_begin = false, quiet = false;
  int threads = 0;
  double checkpoint_minutes = 10;
};

std::string instructions_of(const Library& library) {
  const auto sets = instruction_sets();
  const std::string folder = library.path.parent_path().filename().string();
  return std::find(sets.begin(), sets.end(), folder) == sets.end() ? "baseline" : folder;
}

int run(const RunArguments& arguments) {
  heed_signals();
  Loaded loaded = load_run(arguments.deck);
  if (interrupted) throw Interrupted("interrupted before the run began; nothing is written");
  const bool resume = arguments.resume || (arguments.resume_or_begin &&
                                           FormerRun(arguments.out).can_go_on(file_sums(loaded.scene->files())));
  const bool overwrite = arguments.overwrite || arguments.resume_or_begin;
  RunFolder folder = resume ? RunFolder::resume(arguments.out) : RunFolder::fresh(arguments.out, overwrite);
  if (arguments.resume_or_begin) folder.take_over();  // a batch has decided already
  const auto log = make_run_log(folder.log(), resume, arguments.quiet, arguments.label);
  Progress progress([&](const std::string& line) { log->info(line); }, !arguments.quiet);

  RunOptions options;
  options.threads = arguments.threads > 0 ? arguments.threads : allowed_processors();
  options.resume = resume;
  options.commands = commands_of(arguments.words, arguments.batch);
  options.checkpoint_seconds = 60 * arguments.checkpoint_minutes;
  options.interrupt = &interrupted;
  options.log = Log(
      [&](const std::string& line) {
        progress.hide();
        log->info(line);
      },
      [&](const std::string& line) {
        progress.hide();
        log->warn("warning: " + line);
      });
  options.progress = [&](const Headway& headway) {
    progress.show(headway);
    tell_batch(arguments.tell, headway);
  };

  log->info("beadwork {} runs {} on {} thread{} ({} instructions) into {}", version, arguments.deck.path,
            options.threads, options.threads == 1 ? "" : "s", loaded.catalogue.instructions(), arguments.out);
  for (const Library& library : loaded.catalogue.libraries())
    note_in_file(*log, fmt::format("plugins: {}, {} instructions, built for {}", library.path.string(),
                                   instructions_of(library), library.version));
  Run job(*loaded.scene, loaded.catalogue, folder, options);
  try {
    job.all();
  } catch (const Fault& fault) {
    progress.hide();
    log->error("{}", shown(fault));
    return static_cast<int>(fault.code());
  } catch (const std::exception& error) {
    progress.hide();
    log->error("error: {}", error.what());
    return static_cast<int>(ExitCode::machine);
  }
  progress.hide();
  const RunFigures& figures = job.figures();
  log->info("done: {} in {:.1f} s ({:.1f} s in the loop, {:.3g} million bond updates/s)", figures.exit_reason,
            figures.wall_seconds, figures.loop_seconds,
            figures.loop_seconds > 0 ? 1e-6 * figures.bond_updates / figures.loop_seconds : 0);
  return 0;
}

}  // namespace

void add_run(CLI::App& app, Chosen& chosen, const Words& words) {
  const CLI::Validator minutes(
      [](const std::string& text) {
        const auto number = parse_number(text);
        return number && *number > 0 ? std::string() : "a number of minutes > 0 is wanted, got \"" + text + "\"";
      },
      "MINUTES > 0");
  CLI::App* verb = app.add_subcommand("run", "Runs a deck");
  verb->footer("Example: beadwork run xml-cases/dcb/quick.xml --out out/dcb --threads 2");
  auto arguments = std::make_shared<RunArguments>();
  arguments->words = words;
  arguments->deck.add_to(*verb);
  verb->add_option("--out", arguments->out, "Folder for the results")->required();
  CLI::Option* overwrite =
      verb->add_flag("--overwrite", arguments->overwrite, "Replaces the results of an earlier run");
  CLI::Option* resume =
      verb->add_flag("--resume", arguments->resume, "Goes on from the newest checkpoint in the folder")
          ->excludes(overwrite);
  verb->add_flag("--resume-or-begin", arguments->resume_or_begin,
                 "Goes on from the checkpoint of a run that was interrupted, killed or stopped by the machine; where "
                 "there is none, begins as --overwrite does")
      ->excludes(overwrite)
      ->excludes(resume);
  verb->add_flag("-q,--quiet", arguments->quiet, "Only warnings and errors on the terminal");
  verb->add_option("--batch", arguments->batch, "The command of the batch that runs this")
      ->group("");  // for no user: hidden
  verb->add_option("--threads", arguments->threads,
                   "Number of threads; as many as there are processors that it may use where absent")
      ->check(CLI::Range(1, 1024));
  verb->add_option("--checkpoint-minutes", arguments->checkpoint_minutes,
                   "Wall time between checkpoints; the first comes after a minute at most")
      ->check(minutes)
      ->capture_default_str();
  verb->add_option("--label", arguments->label)->group("");  // these two are for batch
  verb->add_option("--tell", arguments->tell)->group("");
  verb->callback([&chosen, arguments] { chosen = [arguments] { return run(*arguments); }; });
}

}  // namespace beadwork
