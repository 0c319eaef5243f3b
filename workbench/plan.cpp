#include "workbench/plan.hpp"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"
#include "core/loop/forecast.hpp"
#include "core/loop/run.hpp"
#include "workbench/progress.hpp"
#include "workbench/terminal.hpp"
#include "workbench/verbs.hpp"

namespace beadwork {

namespace {

struct PlanArguments {
  DeckArguments deck;
  bool fill = false;
  int threads = 1;
};

// A folder that a trial needs and nobody keeps.
class Scratch {
 public:
  Scratch() {
    std::error_code error;
    std::string path = (std::filesystem::temp_directory_path(error) / "beadwork-plan-XXXXXX").string();
    if (error) throw MachineFailure(fmt::format("error: no folder for temporary files (TMPDIR): {}", error.message()));
    if (!::mkdtemp(path.data())) throw MachineFailure("error: cannot make a folder in " + path);
    path_ = path;
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::string duration(Real seconds) {
  if (seconds < 120) return fmt::format("{:.2g} s", seconds);
  if (seconds < 7200) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

std::string counts(const Domain& domain) {
  const auto megabytes = [](const Table& table) { return 1e-6 * static_cast<Real>(table.memory()); };
  std::string text =
      fmt::format("\nFilled\n  {:28} {:>10}  {:8.2f} MB\n", "elements", domain.size(), megabytes(domain.elements()));
  for (const auto& family : domain.families())
    text += fmt::format("  {:28} {:>10}  {:8.2f} MB\n", "bonds of '" + family->name() + "'", family->size(),
                        megabytes(family->rows()));
  for (const auto& [name, set] : domain.sets())
    text += fmt::format("  {:28} {:>10}\n", "set '" + name + "'", set.size());
  return text;
}

// Seconds that the watchers of a stage take; those that stand in a later one only have not been tried.
Real looks(const Stage& stage, Real steps, const Trial& trial) {
  Real seconds = 0;
  for (std::size_t w = 0; w < stage.watchers.size(); ++w) {
    const Watcher& watcher = *stage.watchers[w];
    const auto tried = std::find_if(trial.seconds_per_look.begin(), trial.seconds_per_look.end(),
                                    [&](const auto& look) { return look.first == &watcher; });
    if (tried == trial.seconds_per_look.end()) continue;
    const Real regular = watcher.every.given() ? std::floor(steps / static_cast<Real>(*watcher.every)) : 0;
    seconds += tried->second * (regular + static_cast<Real>(stage.marks[w].size()));
  }
  return seconds;
}

std::string times(const Scene& scene, const Trial& trial, int threads) {
  std::string text = fmt::format("\nTime\n  filling {}; time step {:.4g} s{}{}\n", duration(trial.fill_seconds),
                                 trial.time_step, trial.limited_by.empty() ? "" : ", ", trial.limited_by);
  text += fmt::format("  {:.3g} s per step ({} steps tried, {} thread{})", trial.seconds_per_step, trial.steps, threads,
                      threads == 1 ? "" : "s");
  for (const auto& [watcher, seconds] : trial.seconds_per_look)
    text += fmt::format(", {:.2g} s per look of {}", seconds, watcher->id());
  text += "\n";
  Real total = 0;
  for (const Stage& stage : scene.stages) {
    const auto steps = steps_of(*stage.until, stage.constraints(), 0, trial.time_step);
    if (!steps) {
      text += fmt::format("  stage '{}': its conditions alone tell when it ends\n", stage.name);
      continue;
    }
    const Real looking = looks(stage, *steps, trial);
    const Real all = *steps * trial.seconds_per_step + looking;
    total += all;
    text += fmt::format("  stage '{}': {:.0f} steps at most, about {}, of which {} for looks\n", stage.name, *steps,
                        duration(all), duration(looking));
  }
  if (scene.stages.size() > 1) text += fmt::format("  together about {}\n", duration(total));
  return text;
}

int plan(const PlanArguments& arguments) {
  const Loaded loaded = load_run(arguments.deck);
  Scene& scene = *loaded.scene;
  say("{}: scene '{}'\n\n{}", arguments.deck.path, scene.name, plan_text(scene));
  if (!arguments.fill) {
    say("\nWith --fill: numbers of elements and bonds, megabytes, time step, steps and wall time\n");
    return 0;
  }
  std::fflush(stdout);
  const Scratch scratch;
  RunFolder folder = RunFolder::fresh(scratch.path() / "run", false);
  RunOptions options;
  options.threads = arguments.threads;
  Progress progress([](const std::string&) {});
  options.log = Log([](const std::string&) {},
                    [&](const std::string& warning) {
                      progress.hide();
                      say_error("warning: {}\n", warning);
                    });
  options.progress = [&](const Headway& headway) { progress.show(headway); };
  Run run(scene, loaded.catalogue, folder, options);
  const Trial trial = run.trial(2);
  progress.hide();
  say("{}{}", counts(*scene.domain), times(scene, trial, arguments.threads));
  return 0;
}

}  // namespace

void add_plan(CLI::App& app, Chosen& chosen) {
  CLI::App* verb = app.add_subcommand("plan", "Says what a deck will do: phases, fields, memory, steps");
  verb->footer("Example: beadwork plan xml-cases/dcb/quick.xml --fill");
  auto arguments = std::make_shared<PlanArguments>();
  arguments->deck.add_to(*verb);
  verb->add_flag("--fill", arguments->fill,
                 "Makes the elements and bonds and tries some steps, for numbers, megabytes and times");
  verb->add_option("--threads", arguments->threads, "Number of threads for the trial")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  verb->callback([&chosen, arguments] { chosen = [arguments] { return plan(*arguments); }; });
}

}  // namespace beadwork
