#include "workbench/report/report.hpp"

#include "workbench/terminal.hpp"
#include "workbench/verbs.hpp"

namespace beadwork {

namespace {

std::string report_of(const std::string& folder, const std::string& view) {
  if (is_batch(folder)) return write_batch_report(folder);
  if (is_study(folder)) return write_study_report(folder);
  return write_report(folder, view);
}

std::string comparison_of(const std::vector<std::string>& folders, const std::string& file) {
  for (const std::string& folder : folders)
    if (is_batch(folder) || is_study(folder))
      throw DeckFailure(fmt::format("error: '{}' holds several runs; a comparison is of single ones, such as '{}/NAME'",
                                    folder, folder));
  return write_comparison({folders.begin(), folders.end()}, file);
}

}  // namespace

void add_report(CLI::App& app, Chosen& chosen) {
  CLI::App* verb = app.add_subcommand("report",
                                      "Writes report.html of a run (curves, energy balance, packing, pictures) or of a "
                                      "batch (its table, curves over one another) or of a study; of several runs a "
                                      "comparison");
  verb->footer(
      "Example: beadwork report out/dcb\n"
      "beadwork report out/a out/b out/c --out comparison.html lays their curves over one another and tells what "
      "differs "
      "in their decks and results.");
  auto folders = std::make_shared<std::vector<std::string>>();
  auto view = std::make_shared<std::string>();
  auto file = std::make_shared<std::string>("comparison.html");
  verb->add_option("folder", *folders, "Folder of a run, of a batch or of a study; several of runs are compared")
      ->required();
  const CLI::Option* out = verb->add_option("--out", *file, "File of a comparison")->capture_default_str();
  verb->add_option("--view", *view,
                   "Axis along which the pictures look; where absent, as the snapshots say, or as shows most")
      ->check(CLI::IsMember({"x", "y", "z"}));
  verb->callback([&chosen, folders, view, file, out] {
    if (folders->size() == 1 && out->count() > 0)
      throw CLI::ValidationError("--out", "is the file of a comparison; the report of one run stands in its folder");
    if (folders->size() > 1 && !view->empty())
      throw CLI::ValidationError("--view", "is for the pictures of one run; a comparison has none");
    chosen = [folders, view, file] {
      say("{}\n", folders->size() > 1 ? comparison_of(*folders, *file) : report_of(folders->front(), *view));
      return 0;
    };
  });
}

}  // namespace beadwork
