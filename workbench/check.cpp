#include "core/base/text.hpp"
#include "workbench/terminal.hpp"
#include "workbench/verbs.hpp"

namespace beadwork {

void add_check(CLI::App& app, Chosen& chosen) {
  CLI::App* verb = app.add_subcommand("check", "Checks a deck without running it");
  verb->footer("Example: beadwork check xml-cases/dcb/quick.xml");
  auto arguments = std::make_shared<DeckArguments>();
  auto verbose = std::make_shared<bool>(false);
  arguments->add_to(*verb);
  verb->add_flag("-v,--verbose", *verbose, "Prints the deck with every value in SI and every default written out");
  verb->callback([&chosen, arguments, verbose] {
    chosen = [arguments, verbose] {
      const Loaded loaded = load_checked(arguments->request());
      if (*verbose) write_out(loaded.scene->resolved);
      const auto& studies = loaded.scene->studies;
      const bool has_runs = !studies.empty() && studies.front()->is_of_batch();
      say("{}: no errors{}\n", arguments->path,
          has_runs ? "; the decks of its runs are checked by: beadwork batch " + shell_quoted(arguments->path) +
                         " --out FOLDER --dry-run"
                   : "");
      return 0;
    };
  });
}

}  // namespace beadwork
