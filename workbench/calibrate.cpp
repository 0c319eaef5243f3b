// `calibrate`: conducts the study of a deck.

#include <fmt/format.h>

#include <cstdio>

#include "core/loop/bounded_json.hpp"
#include "core/loop/scene_runner.hpp"
#include "core/version.hpp"
#include "workbench/office.hpp"
#include "workbench/report/report.hpp"
#include "workbench/terminal.hpp"
#include "workbench/verbs.hpp"

namespace beadwork {

namespace {

namespace fs = std::filesystem;

struct CalibrateArguments {
  DeckArguments deck;
  std::string out, seeds, elements, density, tests;  // as they stand on the command line
  Words words;
  Shares shares;
  bool quiet = false;
  std::string batch, label;  // of a batch that has started this: its command, and what it calls this
  int tell = -1;             // socket that takes how far it has come; -1 if nobody asks
};

DeckRequest request_of(const CalibrateArguments& arguments) {
  DeckRequest request = arguments.deck.request();
  const auto give = [&](const char* name, const std::string& value) {
    if (!value.empty()) request.attributes.push_back({"calibration", name, value});
  };
  give("seeds", arguments.seeds);
  give("elements", arguments.elements);
  give("density", arguments.density);
  give("tests", arguments.tests);
  return request;
}

int calibrate(const CalibrateArguments& arguments) {
  heed_signals();
  const Loaded loaded = load_checked(request_of(arguments));
  if (loaded.scene->studies.empty())
    refuse(
        loaded.deck->root->at,
        fmt::format("this deck has no <study>: it is a scene. Do: beadwork run {} --out FOLDER", arguments.deck.path));
  Study& study = *loaded.scene->studies.front();
  if (study.is_of_batch()) refuse_study(loaded, arguments.deck.path);
  Office office(arguments.out, *loaded.scene, study.tag());
  const bool quiet = arguments.quiet;
  const auto tell_all = [quiet](const std::string& line) {
    if (!quiet) say("{}\n", line), std::fflush(stdout);
  };
  Progress progress(tell_all, !quiet);
  const std::string whose = arguments.label.empty() ? "" : "[" + arguments.label + "] ";
  const Log log([&](const std::string& line) { progress.hide(), tell_all(line); },
                [&](const std::string& line) { progress.hide(), say_error("{}warning: {}\n", whose, line); });
  SceneRunnerOptions options = runs_of(arguments, progress, log);
  if (!arguments.batch.empty()) options.command = arguments.batch;
  options.progress = [&](const Headway& headway) {
    progress.show(headway);
    tell_batch(arguments.tell, headway);
  };
  SceneRunner runner(options, loaded.catalogue);
  const StudyDesk desk{
      runner,
      fs::absolute(office.root()),
      log,
      fmt::format("beadwork {}, deck {}, SHA-256 {}", version, fs::path(arguments.deck.path).filename().string(),
                  loaded.scene->deck_sha256),
      [&](const std::string& name, std::string_view text) { return fs::absolute(office.write(name, text)); },
      [&](const std::string& name, const CurvePlan& plan, const auto& rows) { office.curve(name, plan, rows); },
      [&](const std::string& json) { office.take_result(bounded_json(json)); }};
  try {
    study.conduct(desk);
  } catch (const Fault& fault) {
    progress.hide();
    office.close(fault.code() == ExitCode::interrupted ? "interrupted" : "failed", fault.code(), fault.what(), runner);
    throw;
  }
  progress.hide();
  office.close("done", ExitCode::done, "done", runner);
  const std::string page = write_study_report(office.root());
  if (!quiet) say("{} scenes run, {} known already\n{}\n", runner.runs(), runner.known(), page);
  return 0;
}

}  // namespace

void add_calibrate(CLI::App& app, Chosen& chosen, const Words& words) {
  CLI::App* verb = app.add_subcommand(
      "calibrate", "Finds the parameters of bonds whose solid has the stiffness and strength of a material");
  verb->footer(
      "Example: beadwork calibrate xml-cases/calibration/epoxy.xml --out out/epoxy --seeds 3\n"
      "The result is a file of parameters, out/epoxy/epoxy.calibration.xml, that decks include. The same command again "
      "runs nothing that has been run; one that was stopped goes on.");
  auto arguments = std::make_shared<CalibrateArguments>();
  arguments->words = words;
  arguments->deck.add_to(*verb);
  verb->add_option("--out", arguments->out, "Folder for the results, and for the runs that they come of")->required();
  verb->add_option("--seeds", arguments->seeds, "Packings, in the place of 'seeds' of the deck");
  verb->add_option("--elements", arguments->elements, "Elements of a sample, in the place of 'elements' of the deck");
  verb->add_option("--density", arguments->density,
                   "Of the material, such as '1200 kg/m^3', in the place of the deck's");
  verb->add_option("--tests", arguments->tests,
                   "What the bonds that were found are put to, such as 'compression wave', in the place of the deck's");
  add_shares(*verb, arguments->shares);
  verb->add_flag("-q,--quiet", arguments->quiet, "Only warnings and errors on the terminal");
  verb->add_option("--batch", arguments->batch)->group("");  // these three are for batch
  verb->add_option("--label", arguments->label)->group("");
  verb->add_option("--tell", arguments->tell)->group("");
  verb->callback([&chosen, arguments] { chosen = [arguments] { return calibrate(*arguments); }; });
}

}  // namespace beadwork
