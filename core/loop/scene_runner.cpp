#include "core/loop/scene_runner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/sha256.hpp"
#include "core/base/text.hpp"
#include "core/io/file.hpp"
#include "core/loop/bounded_json.hpp"
#include "core/loop/former_run.hpp"
#include "core/loop/load.hpp"

namespace beadwork {

namespace fs = std::filesystem;

struct SceneRunner::Scene {
  std::string name;
  fs::path folder;
  std::string refusal;  ///< what is wrong with its deck
  bool is_study = false;
  bool was_known = false;
};

namespace {

using Json = nlohmann::ordered_json;

// All numbers of an object and of what it holds, by the way there.
void add_numbers(const Json& json, const std::string& way, std::map<std::string, Real>& numbers) {
  if (json.is_number()) numbers[way] = json.get<Real>();
  if (!json.is_structured()) return;
  for (const auto& [key, value] : json.items()) add_numbers(value, way.empty() ? key : way + "/" + key, numbers);
}

std::map<std::string, CurveTable> curves_in(const fs::path& folder) {
  constexpr std::uintmax_t longest = std::uintmax_t{1} << 31;
  std::map<std::string, CurveTable> curves;
  std::error_code error;
  for (fs::directory_iterator it(folder / "curves", error), end; !error && it != end; it.increment(error))
    if (it->path().extension() == ".csv" && it->is_regular_file(error))
      curves[it->path().stem().string()] = parse_table(read_text(it->path(), longest));
  return curves;
}

// Whether it has come to an end that would come again.
bool has_ended(const fs::path& folder) {
  const FormerRun former(folder);
  if (former.is_done()) return true;
  const Json summary = bounded_object(folder / "summary.json");
  return former.text("status") == "failed" && summary.contains("exit_code") &&
         (summary["exit_code"] == static_cast<int>(ExitCode::physics) ||
          summary["exit_code"] == static_cast<int>(ExitCode::deck));
}

}  // namespace

std::string sum_of_program(const fs::path& program, const Catalogue& catalogue) {
  std::string sums = sha256_of_file(program.string()) + sha256_of_file(kernel_library().string());
  for (const Library& library : catalogue.libraries()) sums += sha256_of_file(library.path.string());
  return sha256(sums);
}

SceneRunner::SceneRunner(SceneRunnerOptions options, const Catalogue& catalogue)
    : options_(std::move(options)), program_sum_(sum_of_program(options_.program, catalogue)) {}

SceneRunner::Scene SceneRunner::scene_of(const Errand& errand) {
  Scene scene{errand.name, {}, "", false, false};
  Complaints complaints;
  const Loaded loaded = load_scene({errand.deck.string(), errand.overrides, options_.libraries, false}, complaints);
  std::string input = program_sum_;
  if (loaded.deck) input += loaded.deck->sha256;
  if (complaints.errors() > 0) scene.refusal = complaints.text();
  if (loaded.scene) {
    scene.is_study = !loaded.scene->studies.empty();
    for (const auto& [path, sum] : file_sums(loaded.scene->files())) input += sum;
  }
  constexpr std::size_t digits = 16;
  scene.folder = options_.folder / (as_file_name(errand.name) + "_" + sha256(input).substr(0, digits));
  scene.was_known = scene.refusal.empty() && has_ended(scene.folder);
  return scene;
}

// One after the other: decks are read through libraries that know no threads.
std::vector<SceneRunner::Scene> SceneRunner::scenes_of(const std::vector<Errand>& errands) {
  std::vector<Scene> scenes;
  for (const Errand& errand : errands) {
    if (options_.interrupt && *options_.interrupt) break;
    scenes.push_back(scene_of(errand));
  }
  return scenes;
}

std::vector<std::string> SceneRunner::command_for(const Errand& errand, const Scene& scene, int threads) const {
  std::vector<std::string> command{options_.program.string(),
                                   scene.is_study ? "calibrate" : "run",
                                   errand.deck.string(),
                                   "--quiet",
                                   "--batch",
                                   options_.command,
                                   "--out",
                                   scene.folder.string(),
                                   "--threads",
                                   std::to_string(threads)};
  if (scene.is_study)
    command.insert(command.end(), {"--jobs", "1"});  // the same command goes on with what there is
  else
    command.push_back("--resume-or-begin");
  for (const Override& each : errand.overrides) command.insert(command.end(), {"--set", each.name + "=" + each.value});
  for (const std::string& library : options_.libraries) command.insert(command.end(), {"--plugins", library});
  return command;
}

Outcome SceneRunner::outcome_of(const Scene& scene) const {
  if (!scene.refusal.empty()) return {ExitCode::deck, scene.refusal, scene.folder};
  const Json summary = bounded_object(scene.folder / "summary.json");
  const FormerRun former(scene.folder);
  Outcome outcome{ExitCode::done, former.text("exit_reason"), scene.folder, scene.was_known};
  if (!former.is_done()) outcome.code = ExitCode(summary.value("exit_code", static_cast<int>(ExitCode::machine)));
  add_numbers(summary, "", outcome.numbers);
  outcome.curves = curves_in(scene.folder);
  return outcome;
}

// What is heard of those that run.
class SceneRunner::Events final : public JobEvents {
 public:
  Events(const SceneRunnerOptions& options, std::vector<Job>& jobs, std::size_t all)
      : options_(options), jobs_(jobs), before_(all - jobs.size()), all_(all) {}

  void ended(std::size_t job, const JobEnd& end) override {
    ++ended_;
    worst_ = std::max(worst_, end.code == static_cast<int>(ExitCode::interrupted) ? 1 : 0);
    const bool is_outcome = end.code == 0 || end.code == static_cast<int>(ExitCode::physics) ||
                            end.code == static_cast<int>(ExitCode::deck) ||
                            end.code == static_cast<int>(ExitCode::interrupted);
    if (!is_outcome && failure_.empty())
      failure_ =
          fmt::format("error: {}: {}, see {}", jobs_[job].name, end.how, (jobs_[job].folder / "run.log").string());
  }
  void is_held_up(std::size_t job, const std::string& why) override {
    options_.log.say(fmt::format("{}: {}", jobs_[job].name, why));
  }
  bool was_done_elsewhere(std::size_t job) override {
    if (!has_ended(jobs_[job].folder)) return false;
    ++ended_;
    return true;
  }
  void at_work(const std::vector<JobShare>& jobs) override {
    const auto done = static_cast<double>(before_ + ended_);
    options_.progress({.work = "study",
                       .detail = fmt::format("{} of {} runs done, {} at work", before_ + ended_, all_, jobs.size()),
                       .share = (done + sum_of(jobs)) / static_cast<double>(all_)});
  }

  bool any_interrupted() const { return worst_ > 0; }
  const std::string& failure() const { return failure_; }

 private:
  const SceneRunnerOptions& options_;
  const std::vector<Job>& jobs_;
  std::size_t before_, all_, ended_ = 0;
  int worst_ = 0;
  std::string failure_;
};

std::vector<Outcome> SceneRunner::run(const std::vector<Errand>& errands) {
  const std::vector<Scene> scenes = scenes_of(errands);
  std::vector<Job> jobs;
  std::map<fs::path, bool> asked_for;  // two errands may be the same
  std::vector<std::size_t> of_jobs;
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    if (scenes[k].was_known) ++known_;
    if (scenes[k].was_known || !scenes[k].refusal.empty() || asked_for[scenes[k].folder]) continue;
    asked_for[scenes[k].folder] = true;
    jobs.push_back({scenes[k].name, scenes[k].folder, {}});
    of_jobs.push_back(k);
  }
  const Shares shares = options_.shares.among(jobs.size());
  for (std::size_t k = 0; k < jobs.size(); ++k)
    jobs[k].command = command_for(errands[of_jobs[k]], scenes[of_jobs[k]], shares.threads);
  Events events(options_, jobs, errands.size());
  LocalJobs(shares.jobs, Voice::silent, options_.interrupt).run(jobs, events);
  runs_ += jobs.size();
  if ((options_.interrupt && *options_.interrupt) || events.any_interrupted())
    throw Interrupted(fmt::format("interrupted; go on with: {}", options_.command));
  if (!events.failure().empty()) throw MachineFailure(events.failure());
  std::vector<Outcome> outcomes;
  for (const Scene& scene : scenes) {
    outcomes.push_back(outcome_of(scene));
    seconds_[scene.folder] = outcomes.back().number("loop_seconds");
  }
  return outcomes;
}

Real SceneRunner::loop_seconds() const {
  Real sum = 0;
  for (const auto& [folder, seconds] : seconds_)
    if (std::isfinite(seconds)) sum += seconds;  // none of a scene that was refused
  return sum;
}

}  // namespace beadwork
