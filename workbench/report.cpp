#include "workbench/report/report.hpp"

#include "workbench/terminal.hpp"
#include "workbench/verbs.hpp"

namespace beadwork {

void add_report(CLI::App& app, Chosen& chosen) {
  CLI::App* verb = app.add_subcommand("report",
                                      "Writes report.html of a run (curves, energy balance, packing, pictures) or of a "
                                      "batch (its table, curves over one another) or of a study");
  verb->footer("Example: beadwork report out/dcb");
  auto folder = std::make_shared<std::string>();
  auto view = std::make_shared<std::string>();
  verb->add_option("folder", *folder, "Folder of a run, of a batch or of a study")->required();
  verb->add_option("--view", *view,
                   "Axis along which the pictures look; where absent, as the snapshots say, or as shows most")
      ->check(CLI::IsMember({"x", "y", "z"}));
  verb->callback([&chosen, folder, view] {
    chosen = [folder, view] {
      say("{}\n", is_batch(*folder)   ? write_batch_report(*folder)
                  : is_study(*folder) ? write_study_report(*folder)
                                      : write_report(*folder, *view));
      return 0;
    };
  });
}

}  // namespace beadwork
