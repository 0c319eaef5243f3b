// `law`: what one bond of a deck does, in tension, compression, shear, bending and torsion.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "core/base/text.hpp"
#include "core/deck/read.hpp"
#include "core/io/manifest.hpp"
#include "core/loop/bounded_json.hpp"
#include "workbench/law/results.hpp"
#include "workbench/office.hpp"
#include "workbench/report/report.hpp"
#include "workbench/terminal.hpp"
#include "workbench/verbs.hpp"

namespace beadwork {

namespace {

namespace fs = std::filesystem;

struct LawArguments {
  DeckArguments deck;
  std::string out, radius;
  std::vector<std::string> families;
  law::Reach reach;
  bool overwrite = false;
  Words words;
  Shares shares;
};

std::vector<law::Family> asked_for(const LawArguments& arguments, const Loaded& loaded) {
  std::vector<law::Family> all = law::families_of(*loaded.scene);
  if (all.empty())
    refuse(loaded.deck->root->at,
           "this deck has neither a <bond> nor a <contact> between elements, so there is no law to be shown");
  if (arguments.families.empty()) return all;
  std::vector<std::string> known;
  for (const law::Family& each : all) known.push_back(each.name);
  for (const std::string& name : arguments.families)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw DeckFailure(fmt::format("error: --family: the deck has no family '{}'{}", name, did_you_mean(name, known)));
  std::erase_if(all, [&](const law::Family& each) {
    return std::find(arguments.families.begin(), arguments.families.end(), each.name) == arguments.families.end();
  });
  return all;
}

// "5 um", or that of the first and that of the second element: "5 um, 20 um".
law::Pair radii_of(const std::string& text) {
  const auto source = std::make_shared<const Source>(Source{"--radius", text});
  std::vector<Real> radii;
  Complaints complaints;
  std::size_t offset = 0;
  for (const std::string& piece : split(text, ',')) {
    const Location at{source, 1, static_cast<int>(offset) + 1, offset};
    const auto value = read_quantity({"--radius", std::string(trim(piece)), at, at}, "m", {}, complaints);
    if (value && !(*value > 0)) complaints.error(at, fmt::format("a radius must be > 0 m, got \"{}\"", trim(piece)));
    if (value) radii.push_back(*value);
    offset += piece.size() + 1;
  }
  complaints.throw_if_any();
  if (radii.size() > 2) throw DeckFailure(fmt::format("error: --radius wants one length or two, got \"{}\"", text));
  return {radii.front(), radii.back()};
}

// What a former `law` has finished is replaced where that is asked for; what others have made is left alone.
void refuse_former(const LawArguments& arguments) {
  const auto former = bounded_object(fs::path(arguments.out) / "summary.json");
  const auto list = Manifest::read(arguments.out, Manifest::Of::study);
  if (!list) return;
  const std::string study = former.value("study", "law");
  if (study != "law")
    throw DeckFailure(fmt::format("folder '{}' holds a {}; choose another --out", arguments.out, study));
  if (former.value("status", "") == "done" && !arguments.overwrite)
    throw DeckFailure(fmt::format("folder '{}' already holds laws; choose another, or add --overwrite to replace them",
                                  arguments.out));
}

// Of a filling for its radii alone: what it says of the packing is nobody's concern.
RunOptions filling_options(const SceneRunnerOptions& options) {
  RunOptions filling;
  filling.commands = {options.command, options.command};
  filling.interrupt = options.interrupt;
  filling.progress = options.progress;
  return filling;
}

int show_laws(const LawArguments& arguments) {
  heed_signals();
  const Loaded loaded = load_run(arguments.deck);
  const std::vector<law::Family> families = asked_for(arguments, loaded);
  std::vector<law::Pair> pairs;
  if (!arguments.radius.empty()) pairs.assign(families.size(), radii_of(arguments.radius));
  refuse_former(arguments);
  Office office(arguments.out, *loaded.scene, "law", Office::Former::removed);
  Progress progress([](const std::string& line) { say("{}\n", line), std::fflush(stdout); });
  const Log log = log_beside(progress);
  const SceneRunnerOptions options = runs_of(arguments, progress, log);
  SceneRunner runner(options, loaded.catalogue);
  const auto write = [&](const std::string& name, std::string_view text) {
    return fs::absolute(office.write(name, text));
  };
  std::vector<law::Trial> trials;
  try {
    if (pairs.empty()) pairs = law::pairs_of(loaded, families, filling_options(options), log);
    trials = law::trials_of(families, pairs, arguments.reach);
    law::run(trials, {*loaded.scene, runner, options.libraries, write});
    law::put_curves(trials, office);
  } catch (const Fault& fault) {
    progress.hide();
    office.close(fault.code() == ExitCode::interrupted ? "interrupted" : "failed", fault.code(), fault.what(), runner);
    throw;
  }
  progress.hide();
  office.take_result(law::result_of(families, trials));
  const ExitCode code = law::worst_of(trials);
  office.close(code == ExitCode::done ? "done" : "failed", code, code == ExitCode::done ? "done" : "see the result",
               runner);
  say("{}", law::table_of(families, trials));
  say("{} scenes run, {} known already\n{}\n", runner.runs(), runner.known(), write_study_report(office.root()));
  return static_cast<int>(code);
}

}  // namespace

void add_law(CLI::App& app, Chosen& chosen, const Words& words) {
  CLI::App* verb = app.add_subcommand(
      "law", "Shows what one bond of each family does: tension, compression, shear, bending, torsion, forth and back");
  verb->footer(
      "Example: beadwork law xml-cases/dcb/quick.xml --out out/laws --family interface --radius '0.25 mm'\n"
      "Two elements and one bond, with the deck's parameters and criteria of failure, run by the deck's own plugins. "
      "Curves, pictures, decks and a report stand in the folder.");
  auto arguments = std::make_shared<LawArguments>();
  arguments->words = words;
  arguments->deck.add_to(*verb);
  verb->add_option("--out", arguments->out, "Folder for the results, and for the runs that they come of")->required();
  verb->add_option("--family", arguments->families, "Family of bonds or contacts; all of the deck where absent")
      ->allow_extra_args(false);
  verb->add_option("--radius", arguments->radius,
                   "Of the two elements, such as '5 um', or of each, '5 um, 20 um'; where absent the mean of those "
                   "that the family joins");
  constexpr double least = 1e-6, half_a_turn = 3.1;
  verb->add_option("--strain", arguments->reach.strain,
                   "How far the elements are moved at most, over the distance of their centres")
      ->check(CLI::Range(least, 100.0));
  verb->add_option("--angle", arguments->reach.angle, "How far they are turned at most, in rad")
      ->check(CLI::Range(least, half_a_turn));
  verb->add_flag("--overwrite", arguments->overwrite, "Replaces the laws that stand in the folder");
  verb->add_option("--jobs", arguments->shares.jobs, "Runs at once; where absent as many as there are processors for")
      ->check(CLI::Range(1, 1024));
  verb->callback([&chosen, arguments] { chosen = [arguments] { return show_laws(*arguments); }; });
}

}  // namespace beadwork
