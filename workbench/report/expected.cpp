#include "workbench/report/expected.hpp"

#include <algorithm>

#include "core/loop/bounded_json.hpp"
#include "workbench/report/overlay.hpp"
#include "workbench/report/quoted_rows.hpp"
#include "workbench/report/sections.hpp"
#include "workbench/report/text.hpp"

namespace beadwork::report {

namespace {

namespace fs = std::filesystem;

/// By their names in the head: what a later version adds does no harm.
class ClaimRow {
 public:
  ClaimRow(const Row& head, const Row& row) : head_(head), row_(row) {}
  std::string operator[](const char* column) const {
    const auto place = static_cast<std::size_t>(std::find(head_.begin(), head_.end(), column) - head_.begin());
    return place < row_.size() ? row_[place] : "";
  }

 private:
  const Row& head_;
  const Row& row_;
};

std::string band_of(const ClaimRow& claim) {
  const std::string from = claim["from"], to = claim["to"];
  if (from.empty() && to.empty()) return "";
  if (to.empty()) return "at least " + from;
  if (from.empty()) return "at most " + to;
  return from + " to " + to;
}

std::string ours(const ClaimRow& claim) {
  const std::string mean = claim["mean"], scatter = claim["scatter"];
  const std::string count = claim["of"] == "1" ? "" : " (" + claim["runs"] + " of " + claim["of"] + ")";
  if (mean.empty()) return claim["remark"];
  return mean + (scatter.empty() ? "" : " ± " + scatter) + count;
}

std::string verdict_of(const ClaimRow& claim) {
  const std::string verdict = claim["verdict"];
  const char* badge = verdict == "in" ? "done" : verdict == "out" || verdict == "failed" ? "failed" : "other";
  return std::string("<span class=\"badge ") + badge + "\">" + escaped(verdict) + "</span>";
}

std::string name_in(const Json& figure) { return escaped(text_of(figure, "name") + ": " + text_of(figure, "says")); }

/// The names of its runs that are names of folders of the batch, and stand there.
std::vector<std::string> runs_in(const Json& figure, const fs::path& batch) {
  std::vector<std::string> runs;
  if (!figure.contains("runs") || !figure["runs"].is_array()) return runs;
  for (const Json& each : figure["runs"]) {
    std::error_code error;
    const std::string name = each.is_string() ? each.get<std::string>() : "";
    if (!name.empty() && name.find("..") == std::string::npos && name.front() != '/' &&
        fs::is_directory(batch / name, error))
      runs.push_back(name);
  }
  return runs;
}

std::string curves_in(const Json& figure, const fs::path& batch) {
  Overlay overlay;
  for (const std::string& run : runs_in(figure, batch)) overlay.add(batch / run, run.substr(run.find('/') + 1));
  const std::string chart = overlay.chart(text_of(figure, "curve"));
  return chart.empty() ? "<p>None of its runs has this curve.</p>" : "<div class=\"charts\">" + chart + "</div>";
}

std::string pictures_in(const Json& figure, const fs::path& batch) {
  std::string out;
  for (const std::string& name : runs_in(figure, batch)) {
    Run run = open_run(batch / name);
    const std::string link = "<p><a href=\"" + escaped(name) + "/report.html\">" + escaped(name) + "</a></p>";
    if (!run.recorded || run.recorded->frames().empty()) continue;
    if (const std::string stills = still_pictures(run, chosen(run.recorded->frames())); !stills.empty())
      out += link + stills;
  }
  return out.empty() ? "<p>None of its runs has pictures.</p>" : out;
}

std::string figure_in(const Json& figure, const fs::path& batch) {
  try {
    return "<h3>" + name_in(figure) + "</h3>" +
           (figure.contains("curve") ? curves_in(figure, batch) : pictures_in(figure, batch));
  } catch (const std::exception& problem) {
    return "<h3>" + name_in(figure) + "</h3><p>It cannot be shown (" + escaped(problem.what()) + ").</p>";
  }
}

}  // namespace

std::string claims_of(const fs::path& batch) {
  std::error_code error;
  if (!fs::is_regular_file(batch / "claims.csv", error)) return "";
  const std::vector<Row> rows = quoted_rows(batch / "claims.csv");
  if (rows.size() < 2) return "";
  std::string body;
  for (std::size_t r = 1; r < rows.size(); ++r) {
    const ClaimRow claim(rows.front(), rows[r]);
    const std::string source = claim["source"];
    body += "<tr title=\"" + escaped(claim["read"]) + "\"><th>" + escaped(claim["claim"]) + "</th><td>" +
            escaped(claim["says"] + (source.empty() ? "" : " (" + source + ")")) + "</td><td>" +
            escaped(claim["printed"]) + "</td><td>" + escaped(band_of(claim)) + "</td><td>" + escaped(ours(claim)) +
            "</td><td>" + verdict_of(claim) + "</td></tr>\n";
  }
  return section(
      "Claims",
      "<div style=\"overflow-x:auto\"><table class=\"claims\"><thead><tr><th>claim</th><th>what</th><th>printed</th>"
      "<th>band</th><th>here</th><th>in its band</th></tr></thead><tbody>" +
          body + "</tbody></table></div>");
}

std::string figures_of(const fs::path& batch) {
  const Json json = bounded_object(batch / "figures.json");
  if (!json.contains("figures") || !json["figures"].is_array()) return "";
  std::string body;
  for (const Json& figure : json["figures"])
    if (figure.is_object()) body += figure_in(figure, batch);
  return section("Figures", body);
}

}  // namespace beadwork::report
