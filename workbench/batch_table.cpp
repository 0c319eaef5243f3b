#include <fmt/format.h>

#include <algorithm>

#include "core/base/failure.hpp"
#include "core/io/file.hpp"
#include "core/loop/bounded_json.hpp"
#include "core/loop/former_run.hpp"
#include "workbench/batch.hpp"

namespace beadwork {

namespace {

using Json = nlohmann::json;

constexpr const char* own_columns[] = {"status", "elements",         "steps",      "time [s]",
                                       "breaks", "wall_seconds [s]", "exit_reason"};

// What the run says of itself; empty where it has not begun.
Json summary_of(const BatchRun& run) { return bounded_object<Json>(run.folder / "summary.json"); }

std::string text(const Json& json, const char* key) {
  return json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : "";
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
  if (!run.missing.empty()) return "skipped";
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
  const Json summary = run.refused || !run.missing.empty() ? Json::object() : summary_of(run);
  const std::string reason =
      run.missing.empty() ? text(summary, "exit_reason") : fmt::format("needs '{}', which is not done", run.missing);
  run.row = {status_of(run, summary),
             number(summary, "elements"),
             number(summary, "steps"),
             number(summary, "time"),
             breaks(summary),
             number(summary, "wall_seconds"),
             reason};
}

Results cells_of(const BatchRun& run) {
  Results cells(run.values.begin(), run.values.end());
  for (std::size_t k = 0; k < std::min(std::size(own_columns), run.row.size()); ++k)
    cells.emplace_back(own_columns[k], run.row[k]);
  cells.insert(cells.end(), run.results.begin(), run.results.end());
  return cells;
}

ResultTable batch_table(const std::vector<BatchRun>& runs) {
  const std::vector<std::string> parameters = parameters_of(runs), columns = columns_of(runs);
  const auto value_in = [](const auto& pairs, const std::string& name) {
    const auto found = std::find_if(pairs.begin(), pairs.end(), [&](const auto& each) { return each.first == name; });
    return found == pairs.end() ? "" : found->second;
  };
  ResultTable table{{"run"}, {}};
  table.head.insert(table.head.end(), parameters.begin(), parameters.end());
  table.head.insert(table.head.end(), std::begin(own_columns), std::end(own_columns));
  table.head.insert(table.head.end(), columns.begin(), columns.end());
  for (const BatchRun& run : runs) {
    std::vector<std::string> row{run.name};
    for (const std::string& name : parameters) row.push_back(value_in(run.values, name));
    row.insert(row.end(), run.row.begin(), run.row.end());
    for (const std::string& column : columns) row.push_back(value_in(run.results, column));
    table.rows.push_back(std::move(row));
  }
  return table;
}

void write_tables(const std::vector<BatchRun>& runs, OwnFolder& folder) {
  const ResultTable table = batch_table(runs), means = batch_means(runs);
  write_atomically(folder.claim("batch.csv"), csv_of(table));
  write_result_tables(folder.claim("batch.h5"), {{"runs", table}, {"means", means}});
  const std::filesystem::path place = folder.claim("means.csv");  // now: a file of somebody else's is told before hours
  std::error_code error;
  if (!means.rows.empty() || std::filesystem::exists(place, error)) write_atomically(place, csv_of(means));
}

}  // namespace beadwork
