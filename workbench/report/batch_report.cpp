// The report of a batch: its table, and the curves of its runs laid over one another.

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/failure.hpp"
#include "core/io/file.hpp"
#include "workbench/report/report.hpp"
#include "workbench/report/sections.hpp"
#include "workbench/report/text.hpp"

namespace beadwork {
namespace report {

namespace {

namespace fs = std::filesystem;
using Row = std::vector<std::string>;

/// Rows of a CSV file whose fields may be quoted, with commas and line breaks in them.
std::vector<Row> rows_of(const std::string& text) {
  std::vector<Row> rows;
  Row row;
  std::string field;
  bool quoted = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (quoted && c == '"' && k + 1 < text.size() && text[k + 1] == '"') {
      field += text[++k];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (!quoted && (c == ',' || c == '\n')) {
      row.push_back(std::move(field));
      field.clear();
      if (c == '\n') rows.push_back(std::move(row)), row.clear();
    } else {
      field += c;
    }
  }
  return rows;
}

/// The table, and where its own columns stand: those between "run" and "status" are parameters.
struct Batch {
  Row names;
  std::vector<Row> runs;
  std::size_t status = 0;
};

Batch batch_in(const fs::path& folder) {
  Batch batch;
  std::vector<Row> rows = rows_of(read_text(folder / "batch.csv"));
  const auto refuse = [&] { throw MachineFailure("'" + (folder / "batch.csv").string() + "' is not the table of a batch"); };
  if (rows.empty() || rows.front().front() != "run") refuse();
  batch.names = std::move(rows.front());
  batch.status = static_cast<std::size_t>(std::find(batch.names.begin(), batch.names.end(), "status") - batch.names.begin());
  if (batch.status == batch.names.size()) refuse();
  for (std::size_t r = 1; r < rows.size(); ++r)
    if (rows[r].size() == batch.names.size()) batch.runs.push_back(std::move(rows[r]));
  return batch;
}

bool is_plain_name(const std::string& name) { return !name.empty() && name.find('/') == std::string::npos && name != "." && name != ".."; }

/// "young = 30 GPa, seed = 2": what tells this run from the others.
std::string label_of(const Batch& batch, const Row& run) {
  std::string label;
  for (std::size_t k = 1; k < batch.status; ++k) {
    const bool varies = std::any_of(batch.runs.begin(), batch.runs.end(), [&](const Row& other) { return other[k] != run[k]; });
    if (varies) label += (label.empty() ? "" : ", ") + batch.names[k] + " = " + run[k];
  }
  return label.empty() ? run.front() : label;
}

std::string cell(const std::string& text) {
  double value = 0;
  std::size_t read = 0;
  try {
    value = std::stod(text, &read);
  } catch (const std::exception&) {
    read = 0;
  }
  const bool is_number = read > 0 && read == text.size() && std::isfinite(value);
  return "<td>" + (is_number ? number(value) : escaped(text)) + "</td>";
}

std::string table(const Batch& batch, const fs::path& folder) {
  std::string head, body;
  for (const std::string& name : batch.names) head += "<th>" + escaped(name) + "</th>";
  for (const Row& run : batch.runs) {
    const bool linked = is_plain_name(run.front()) && fs::exists(folder / run.front() / "report.html");
    body += "<tr><th>" + (linked ? "<a href=\"" + escaped(run.front()) + "/report.html\">" + escaped(run.front()) + "</a>" : escaped(run.front())) + "</th>";
    for (std::size_t k = 1; k < run.size(); ++k) body += k == batch.status ? "<td>" + badge(run[k]) + "</td>" : cell(run[k]);
    body += "</tr>\n";
  }
  return section("Runs", "<div style=\"overflow-x:auto\"><table><thead><tr>" + head + "</tr></thead><tbody>" + body + "</tbody></table></div>");
}

std::string batch_page(const fs::path& folder) {
  const Batch batch = batch_in(folder);
  std::vector<std::pair<std::string, Run>> runs;
  std::string missing;
  for (const Row& row : batch.runs) {
    const fs::path place = folder / row.front();
    if (!is_plain_name(row.front()) || !fs::is_directory(place)) {
      missing += "<li>" + escaped(label_of(batch, row)) + " has not begun.</li>";
      continue;
    }
    try {
      runs.emplace_back(label_of(batch, row), open_run(place));
    } catch (const MachineFailure& failure) {
      missing += "<li>" + escaped(failure.what()) + "</li>";
    }
  }
  std::vector<std::string> names;
  std::map<std::string, std::vector<std::pair<std::string, const Curve*>>> by_name;
  for (const auto& [label, run] : runs)
    for (const Curve& curve : run.curves) {
      if (is_ledger(curve)) continue;
      if (!by_name.contains(curve.name)) names.push_back(curve.name);
      by_name[curve.name].emplace_back(label, &curve);
    }
  std::string charts;
  for (const std::string& name : names) charts += overlaid(by_name[name]);
  const std::string notes = missing.empty() ? "" : "<section class=\"notes\"><ul>" + missing + "</ul></section>\n";
  const std::string title = escaped(fs::weakly_canonical(folder).filename().string());
  const std::string curves = charts.empty() ? "" : section("Curves", "<div class=\"charts\">" + charts + "</div>");
  return page_with(title + " – Beadwork", "<h1>" + title + "</h1><p>" + plural(static_cast<std::int64_t>(batch.runs.size()), "run") + "</p>",
                   notes + curves + table(batch, folder));
}

}  // namespace
}  // namespace report

bool is_batch(const std::filesystem::path& folder) {
  std::error_code error;
  return std::filesystem::is_regular_file(folder / "batch.csv", error) && !std::filesystem::exists(folder / "summary.json", error);
}

std::string write_batch_report(const std::filesystem::path& batch_folder) {
  const std::filesystem::path file = batch_folder / "report.html";
  write_atomically(file, report::batch_page(batch_folder));
  return file.string();
}

}  // namespace beadwork
