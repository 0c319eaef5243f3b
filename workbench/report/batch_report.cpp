// The report of a batch: its table, and the curves of its runs laid over one another.

#include <algorithm>
#include <deque>
#include <map>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"
#include "core/io/file.hpp"
#include "core/io/manifest.hpp"
#include "workbench/report/report.hpp"
#include "workbench/report/sections.hpp"
#include "workbench/report/text.hpp"

namespace beadwork {
namespace report {

namespace {

namespace fs = std::filesystem;
using Row = std::vector<std::string>;

constexpr std::uintmax_t longest_table = std::uintmax_t{1} << 30;

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
  std::vector<Row> rows = rows_of(read_text(folder / "batch.csv", longest_table));
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

/// "young = 30 GPa, seed = 2": what tells this run from the others.
std::string label_of(const Batch& batch, const Row& run) {
  std::string label;
  for (std::size_t k = 1; k < batch.status; ++k) {
    const bool varies =
        std::any_of(batch.runs.begin(), batch.runs.end(), [&](const Row& other) { return other[k] != run[k]; });
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
    const bool linked = is_plain_name(run.front()) && fs::exists(folder / run.front() / "report.html", error);
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

/// What the runs recorded of curves, with what there is to say of it.
struct Found {
  std::deque<Curve> curves;  // do not move
  std::vector<std::string> names;
  std::map<std::string, std::vector<std::pair<std::string, const Curve*>>> by_name;
  std::string notes;
};

void add_run(const fs::path& place, const std::string& label, Found& found) {
  Run run = open_curves(place);
  for (Curve& curve : run.curves) {
    if (is_ledger(curve)) continue;
    if (!found.by_name.contains(curve.name)) found.names.push_back(curve.name);
    found.curves.push_back(std::move(curve));
    found.by_name[found.curves.back().name].emplace_back(label, &found.curves.back());
  }
  for (const std::string& sentence : run.notes) found.notes += "<li>" + escaped(label + ": " + sentence) + "</li>";
}

Found curves_of(const Batch& batch, const fs::path& folder) {
  Found found;
  for (const Row& row : batch.runs) {
    const std::string label = label_of(batch, row);
    std::error_code error;
    if (!is_plain_name(row.front()) || !fs::is_directory(folder / row.front(), error)) {
      found.notes += "<li>" + escaped(label) + " has not begun.</li>";
      continue;
    }
    try {
      add_run(folder / row.front(), label, found);
    } catch (const std::exception& failure) {
      found.notes += "<li>" + escaped(label + ": " + failure.what()) + "</li>";
    }
  }
  return found;
}

std::string batch_page(const fs::path& folder) {
  const Batch batch = batch_in(folder);
  Found found = curves_of(batch, folder);
  std::string charts;
  for (const std::string& name : found.names) charts += overlaid(found.by_name[name]);
  const std::string notes =
      found.notes.empty() ? "" : "<section class=\"notes\"><ul>" + found.notes + "</ul></section>\n";
  const std::string title = escaped(name_of_folder(folder));
  const std::string curves = charts.empty() ? "" : section("Curves", "<div class=\"charts\">" + charts + "</div>");
  return page_with(title + " – Beadwork",
                   "<h1>" + title + "</h1><p>" + plural(static_cast<std::int64_t>(batch.runs.size()), "run") + "</p>",
                   notes + curves + table(batch, folder));
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
