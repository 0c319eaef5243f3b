// The report of a study: what it found, and the curves that it is read from.

#include "core/io/file.hpp"
#include "core/io/manifest.hpp"
#include "core/loop/bounded_json.hpp"
#include "workbench/report/report.hpp"
#include "workbench/report/sections.hpp"
#include "workbench/report/text.hpp"

namespace beadwork {
namespace report {

namespace {

// The lines by which it told of its tests, as on the terminal; what is shown here stands in no other table.
std::string tests_of(Json& result) {
  if (!result.contains("tests") || !result["tests"].is_object()) return "";
  Json& tests = result["tests"];
  const Json lines = tests.contains("lines") ? tests["lines"] : Json::array();
  tests.erase("lines");
  std::string text;
  for (const Json& line : lines)
    if (line.is_string()) text += escaped(line.get<std::string>()) + "\n";
  return text.empty() ? "" : section("Tests", "<pre>" + text + "</pre>");
}

std::string study_page(const std::filesystem::path& folder) {
  Run study = open_curves(folder);
  Json result = study.summary.contains("result") ? study.summary["result"] : Json::object();
  const std::string title = escaped(study.scene.empty() ? name_of_folder(folder) : study.scene);
  const std::string kind = escaped(text_of(study.summary, "study", "study"));
  std::string notes;
  if (study.status != "done")
    notes = section("How it ended", "<p>" + escaped(text_of(study.summary, "exit_reason")) + "</p>");
  const std::string tests = kind == "law" ? "" : tests_of(result);
  return page_with(
      title + " – Beadwork", "<h1>" + title + "</h1><p>" + kind + " " + badge(study.status) + "</p>",
      notes + tests +
          (kind == "law" ? laws(study, result)
                         : section("Result", result.empty() ? "" : facts_table(result)) + curves(study, {})));
}

}  // namespace
}  // namespace report

bool is_study(const std::filesystem::path& folder) { return bounded_object(folder / "summary.json").contains("study"); }

std::string write_study_report(const std::filesystem::path& folder) {
  return report::put_page(folder, Manifest::Of::study, report::study_page(folder));
}

}  // namespace beadwork
