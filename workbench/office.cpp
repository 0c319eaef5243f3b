#include "workbench/office.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "core/io/file.hpp"
#include "core/loop/json_text.hpp"
#include "core/loop/summary.hpp"
#include "core/version.hpp"
#include "workbench/terminal.hpp"

namespace beadwork {

namespace fs = std::filesystem;

Office::Office(const fs::path& out, const Scene& scene, const std::string& study, Former former)
    : folder_(out, Manifest::Of::study), summary_{{"name", scene.name},
                                                  {"study", study},
                                                  {"status", "running"},
                                                  {"exit_reason", ""},
                                                  {"deck_sha256", scene.deck_sha256},
                                                  {"version", version}} {
  if (former == Former::removed) folder_.clear();
  write("resolved.xml", scene.resolved);
}

fs::path Office::write(const std::string& name, std::string_view text) {
  const fs::path file = folder_.claim(name);
  fs::create_directories(file.parent_path());
  write_atomically(file, text);
  return file;
}

void Office::curve(const std::string& name, const CurvePlan& plan, const std::vector<std::vector<Real>>& rows) {
  std::string text;
  for (const auto& [column, unit] : plan.columns)
    text += fmt::format("{}{} [{}]", text.empty() ? "" : ",", column, unit);
  text += "\n";
  for (const auto& row : rows) text += fmt::format("{}\n", fmt::join(row, ","));
  write("curves/" + name + ".csv", text);
  write("curves/" + name + ".json", curve_json(plan));
}

void Office::close(const std::string& status, ExitCode code, const std::string& reason, const SceneRunner& runner) {
  summary_["status"] = status;
  summary_["exit_reason"] = reason;
  summary_["exit_code"] = static_cast<int>(code);
  summary_["runs"] = {{"run", runner.runs()}, {"known", runner.known()}};
  summary_["loop_seconds"] = runner.loop_seconds();
  summary_["wall_seconds"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
  write("summary.json", json_text(summary_, 2) + "\n");
}

void add_shares(CLI::App& verb, Shares& shares, const std::string& jobs) {
  verb.add_option("--jobs", shares.jobs, "Runs at once; where absent " + jobs)->check(CLI::Range(1, 1024));
  verb.add_option("--threads", shares.threads,
                  "Threads of each run; where absent the processors that it may use, shared out among the runs at once")
      ->check(CLI::Range(1, 1024));
}

Log log_beside(Progress& progress) {
  return {[&progress](const std::string& line) {
            progress.hide();
            say("{}\n", line);
            std::fflush(stdout);
          },
          [&progress](const std::string& line) {
            progress.hide();
            say_error("warning: {}\n", line);
          }};
}

}  // namespace beadwork
