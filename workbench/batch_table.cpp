#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"
#include "workbench/batch.hpp"

namespace beadwork {

namespace {

using Json = nlohmann::json;

// What the run says of itself; empty where it has not begun.
Json summary_of(const BatchRun& run) {
  std::ifstream file(run.folder / "summary.json");
  Json json = file ? Json::parse(file, nullptr, false) : Json::object();
  return json.is_object() ? json : Json::object();
}

std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + "\"";
}

std::string number(const Json& json, const char* key) {
  return json.contains(key) && json[key].is_number() ? json[key].dump() : "";
}

std::string breaks(const Json& summary) {
  if (!summary.contains("breaks")) return "";
  long count = 0;
  for (const auto& each : summary["breaks"]) count += each.get<long>();
  return std::to_string(count);
}

std::string status_of(const BatchRun& run, const Json& summary) {
  if (run.code >= 0 && run.code != 0 && summary.value("status", "") == "running") return "failed";  // it could not say so
  return summary.value("status", run.code < 0 ? "waiting" : "failed");
}

}  // namespace

bool is_done(const BatchRun& run, const std::string& deck_sha256) {
  const Json summary = summary_of(run);
  if (summary.value("status", "") != "done") return false;
  if (summary.value("deck_sha256", "") == deck_sha256) return true;
  throw DeckFailure(fmt::format("error: '{}' holds a run of another deck or with other values: choose another --out, or remove it",
                                run.folder.string()));
}

bool can_resume(const BatchRun& run) {
  return std::filesystem::exists(run.folder / "checkpoint.h5") && summary_of(run).value("status", "") != "failed";
}

std::string batch_table(const std::vector<Variation>& variations, const std::vector<BatchRun>& runs) {
  std::string text = "run";
  for (const Variation& variation : variations) text += "," + field(variation.name);
  text += ",status,elements,steps,time [s],breaks,wall_seconds [s],exit_reason\n";
  for (const BatchRun& run : runs) {
    const Json summary = summary_of(run);
    text += field(run.name);
    for (const std::string& value : run.values) text += "," + field(value);
    text += fmt::format(",{},{},{},{},{},{},{}\n", status_of(run, summary), number(summary, "elements"), number(summary, "steps"),
                        number(summary, "time"), breaks(summary), number(summary, "wall_seconds"), field(summary.value("exit_reason", "")));
  }
  return text;
}

}  // namespace beadwork
