#include <fmt/format.h>

#include <algorithm>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"
#include "core/base/utf8.hpp"
#include "core/loop/bounded_json.hpp"
#include "core/loop/former_run.hpp"
#include "workbench/batch.hpp"

namespace beadwork {

namespace {

using Json = nlohmann::json;

// What the run says of itself; empty where it has not begun.
Json summary_of(const BatchRun& run) { return bounded_object<Json>(run.folder / "summary.json"); }

std::string text(const Json& json, const char* key) {
  return json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : "";
}

// Whatever a parameter, a curve or a run is called: the table is UTF-8.
std::string quoted_field(const std::string& raw) {
  const std::string text = safe_text(raw);
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
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
  if (!summary.contains("breaks") || !summary["breaks"].is_object()) return "";
  std::int64_t count = 0;
  for (const auto& each : summary["breaks"])
    if (each.is_number_integer()) count += each.get<std::int64_t>();
  return std::to_string(count);
}

std::string status_of(const BatchRun& run, const Json& summary) {
  if (run.refused) return "refused";
  const std::string said = text(summary, "status");
  if (run.code > 0 && said == "running") return "failed";  // it could not say so
  return !said.empty() ? said : run.code < 0 ? "waiting" : "failed";
}

// Columns in the order in which the runs first have them, those of one run together.
std::vector<std::string> columns_of(const std::vector<BatchRun>& runs) {
  std::vector<std::string> columns;
  for (const BatchRun& run : runs) {
    auto behind = columns.begin();
    for (const auto& [name, value] : run.results) {
      const auto there = std::find(columns.begin(), columns.end(), name);
      behind = there != columns.end() ? there + 1 : columns.insert(behind, name) + 1;
    }
  }
  return columns;
}

}  // namespace

bool is_done(BatchRun& run) {
  const FormerRun former(run.folder);
  if (!former.is_done()) return false;
  if (former.text("deck_sha256") != run.deck_sha256)
    throw DeckFailure(
        fmt::format("error: '{}' holds a run of another deck or with other values: choose another --out, or remove it",
                    run.folder.string()));
  run.outdated = !former.had(run.files);
  return !run.outdated;
}

void note_row(BatchRun& run) {
  const Json summary = run.refused ? Json::object() : summary_of(run);
  run.row = {
      status_of(run, summary), number(summary, "elements"),     number(summary, "steps"),    number(summary, "time"),
      breaks(summary),         number(summary, "wall_seconds"), text(summary, "exit_reason")};
}

std::string batch_table(const std::vector<Variation>& variations, const std::vector<BatchRun>& runs) {
  const std::vector<std::string> columns = columns_of(runs);
  std::string table = "run";
  for (const Variation& variation : variations) table += "," + quoted_field(variation.name);
  table += ",status,elements,steps,time [s],breaks,wall_seconds [s],exit_reason";
  for (const std::string& column : columns) table += "," + quoted_field(column);
  table += "\n";
  for (const BatchRun& run : runs) {
    table += quoted_field(run.name);
    for (const std::string& value : run.values) table += "," + quoted_field(value);
    for (const std::string& cell : run.row) table += "," + quoted_field(cell);
    for (const std::string& column : columns) {
      const auto found = std::find_if(run.results.begin(), run.results.end(),
                                      [&](const auto& result) { return result.first == column; });
      table += "," + (found == run.results.end() ? "" : quoted_field(found->second));
    }
    table += "\n";
  }
  return table;
}

}  // namespace beadwork
