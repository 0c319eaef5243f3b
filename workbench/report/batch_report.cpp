// The report of a batch: its table, and the curves of its runs laid over one another.

#include <algorithm>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"
#include "core/io/file.hpp"
#include "core/io/manifest.hpp"
#include "workbench/report/expected.hpp"
#include "workbench/report/overlay.hpp"
#include "workbench/report/quoted_rows.hpp"
#include "workbench/report/report.hpp"
#include "workbench/report/sections.hpp"
#include "workbench/report/text.hpp"

namespace beadwork {
namespace report {

namespace {

namespace fs = std::filesystem;
/// The table, and where its own columns stand: those between "run" and "status" are parameters.
struct Batch {
  Row names;
  std::vector<Row> runs;
  std::size_t status = 0;
};

Batch batch_in(const fs::path& folder) {
  Batch batch;
  std::vector<Row> rows = quoted_rows(folder / "batch.csv");
  const auto refuse = [&] {
    throw MachineFailure("'" + (folder / "batch.csv").string() + "' is not the table of a batch");
  };
  if (rows.empty() || rows.front().front() != "run") refuse();
  batch.names = std::move(rows.front());
  batch.status =
      static_cast<std::size_t>(std::find(batch.names.begin(), batch.names.end(), "status") - batch.names.begin());
  if (batch.status == batch.names.size()) refuse();
  for (std::size_t r = 1; r < rows.size(); ++r)
    if (rows[r].size() == batch.names.size()) batch.runs.push_back(std::move(rows[r]));
  return batch;
}

bool is_plain_name(const std::string& name) {
  return !name.empty() && name.find('/') == std::string::npos && name != "." && name != "..";
}

/// "beams" of "beams/young=1-GPa"; empty where the run stands in no sweep.
std::string sweep_of(const Row& run) {
  const std::size_t slash = run.front().find('/');
  return slash == std::string::npos ? "" : run.front().substr(0, slash);
}

/// Whether the run's folder lies in that of the batch, or in that of its sweep.
bool is_inside(const Row& run) {
  const std::string sweep = sweep_of(run);
  return sweep.empty() ? is_plain_name(run.front())
                       : is_plain_name(sweep) && is_plain_name(run.front().substr(sweep.size() + 1));
}

/// "young = 30 GPa, seed = 2": what tells this run from the others.
std::string label_of(const Batch& batch, const Row& run) {
  std::string label;
  for (std::size_t k = 1; k < batch.status; ++k) {
    const bool varies = std::any_of(batch.runs.begin(), batch.runs.end(), [&](const Row& other) {
      return sweep_of(other) == sweep_of(run) && other[k] != run[k];
    });
    if (varies) label += (label.empty() ? "" : ", ") + batch.names[k] + " = " + run[k];
  }
  return label.empty() ? run.front() : label;
}

std::string cell(const std::string& text) {
  const auto value = parse_number(text);
  return "<td>" + (value ? number(*value) : escaped(text)) + "</td>";
}

std::string table(const Batch& batch, const fs::path& folder) {
  std::string head, body;
  for (const std::string& name : batch.names) head += "<th>" + escaped(name) + "</th>";
  for (const Row& run : batch.runs) {
    std::error_code error;  // of a name that is too long
    const bool linked = is_inside(run) && fs::exists(folder / run.front() / "report.html", error);
    body += "<tr><th>" +
            (linked ? "<a href=\"" + escaped(run.front()) + "/report.html\">" + escaped(run.front()) + "</a>"
                    : escaped(run.front())) +
            "</th>";
    for (std::size_t k = 1; k < run.size(); ++k)
      body += k == batch.status ? "<td>" + badge(run[k]) + "</td>" : cell(run[k]);
    body += "</tr>\n";
  }
  return section("Runs", "<div style=\"overflow-x:auto\"><table><thead><tr>" + head + "</tr></thead><tbody>" + body +
                             "</tbody></table></div>");
}

std::vector<std::string> sweeps_of(const Batch& batch) {
  std::vector<std::string> sweeps;
  for (const Row& run : batch.runs)
    if (std::find(sweeps.begin(), sweeps.end(), sweep_of(run)) == sweeps.end()) sweeps.push_back(sweep_of(run));
  return sweeps;
}

/// Of one sweep.
Overlay curves_of(const Batch& batch, const std::string& sweep, const fs::path& folder) {
  Overlay overlay;
  for (const Row& row : batch.runs) {
    if (sweep_of(row) != sweep) continue;
    const std::string label = label_of(batch, row);
    std::error_code error;
    if (is_inside(row) && fs::is_directory(folder / row.front(), error))
      overlay.add(folder / row.front(), label);
    else
      overlay.note(label + " has not begun.");
  }
  return overlay;
}

/// Means over seeds; nothing where there are none.
std::string means(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_regular_file(folder / "means.csv", error)) return "";
  std::string head, body;
  const std::vector<Row> rows = quoted_rows(folder / "means.csv");
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::string line;
    for (const std::string& field : rows[r]) line += r ? cell(field) : "<th>" + escaped(field) + "</th>";
    (r ? body : head) += "<tr>" + line + "</tr>\n";
  }
  return section("Means and scatter over seeds", "<div style=\"overflow-x:auto\"><table><thead>" + head +
                                                     "</thead><tbody>" + body + "</tbody></table></div>");
}

std::string batch_page(const fs::path& folder) {
  const Batch batch = batch_in(folder);
  std::string notes, charts;
  for (const std::string& sweep : sweeps_of(batch)) {
    const Overlay curves = curves_of(batch, sweep, folder);
    notes += curves.notes();
    charts += curves.charts(sweep.empty() ? "Curves" : "Curves of " + sweep);
  }
  const std::string title = escaped(name_of_folder(folder));
  return page_with(title + " – Beadwork",
                   "<h1>" + title + "</h1><p>" + plural(static_cast<std::int64_t>(batch.runs.size()), "run") + "</p>",
                   notes + claims_of(folder) + figures_of(folder) + charts + means(folder) + table(batch, folder));
}

}  // namespace
}  // namespace report

bool is_batch(const std::filesystem::path& folder) {
  std::error_code error;
  return std::filesystem::is_regular_file(folder / "batch.csv", error) &&
         !std::filesystem::exists(folder / "summary.json", error);
}

std::string write_batch_report(const std::filesystem::path& batch_folder) {
  const std::string page = report::batch_page(batch_folder);
  return report::put_page(batch_folder, Manifest::Of::batch, page);
}

}  // namespace beadwork
