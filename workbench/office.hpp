#pragma once
// The folder of a study: what is written into it, and how it went.

#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/failure.hpp"
#include "core/io/own_folder.hpp"
#include "core/loop/scene.hpp"
#include "core/loop/scene_runner.hpp"
#include "core/plugin/curve.hpp"
#include "workbench/progress.hpp"
#include "workbench/signals.hpp"
#include "workbench/verbs.hpp"

namespace beadwork {

class Office {
 public:
  using Json = nlohmann::ordered_json;

  /// Takes the folder; `study` is what is conducted, by name. Where it begins anew, what a former one has made is removed,
  /// but for the runs that it comes of.
  enum class Former { kept, removed };
  Office(const std::filesystem::path& out, const Scene& scene, const std::string& study, Former former = Former::kept);

  std::filesystem::path write(const std::string& name, std::string_view text);
  /// A curve, as CSV and for the report: in SI, with one row for each of `rows`.
  void curve(const std::string& name, const CurvePlan& plan, const std::vector<std::vector<Real>>& rows);
  void take_result(Json result) { summary_["result"] = std::move(result); }
  void close(const std::string& status, ExitCode code, const std::string& reason, const SceneRunner& runner);

  const std::filesystem::path& root() const { return folder_.root(); }

 private:
  OwnFolder folder_;
  Json summary_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

/// --jobs and --threads of a verb that runs scenes; `jobs` says what holds where --jobs is absent.
void add_shares(CLI::App& verb, Shares& shares, const std::string& jobs = "as many as there are processors for");

/// Says and warns on the terminal, where the bar of progress makes room for it.
Log log_beside(Progress& progress);

/// How the runs of a study are made: its command line (`out`, `words`, `deck`, `shares`) says where and with what.
template <class Arguments>
SceneRunnerOptions runs_of(const Arguments& arguments, Progress& progress, const Log& log) {
  SceneRunnerOptions options;
  options.program = std::filesystem::canonical("/proc/self/exe");
  options.folder = std::filesystem::absolute(arguments.out) / "runs";
  options.command = command_line(arguments.words);
  for (const std::string& library : arguments.deck.libraries)
    options.libraries.push_back(std::filesystem::absolute(library));
  options.shares = arguments.shares;
  options.interrupt = &interrupted;
  options.log = log;
  options.progress = [&](const Headway& headway) { progress.show(headway); };
  return options;
}

}  // namespace beadwork
