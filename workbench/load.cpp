#include <fmt/format.h>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"
#include "workbench/terminal.hpp"
#include "workbench/verbs.hpp"

namespace beadwork {

void DeckArguments::add_to(CLI::App& verb) {
  verb.add_option("deck", path, "The deck, an XML file")->required();
  add_options_to(verb);
}

void DeckArguments::add_options_to(CLI::App& verb) {
  verb.add_option("--set", settings, "Gives a parameter of the deck another value: name=value")
      ->allow_extra_args(false);
  verb.add_option("--plugins", libraries, "A plugin library, or a folder of them")->allow_extra_args(false);
  verb.add_flag("--no-plugins", no_plugins, "Loads no library that the deck itself names: for decks from elsewhere");
}

DeckRequest DeckArguments::request() const {
  DeckRequest request{path, {}, libraries, no_plugins};
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0)
      throw DeckFailure(fmt::format("error: --set wants name=value, got \"{}\"", setting));
    request.overrides.push_back({setting.substr(0, equals), setting.substr(equals + 1)});
  }
  return request;
}

std::string shown(const Fault& fault) {
  const std::string text = fault.what();
  if (fault.code() == ExitCode::interrupted) return text;
  return text.find("error: ") == std::string::npos ? "error: " + text : text;
}

Loaded load_checked(const DeckRequest& request) {
  Complaints complaints;
  Loaded loaded = load_scene(request, complaints);
  complaints.throw_if_any();
  if (complaints.warnings() > 0) write_error(complaints.text());
  return loaded;
}

Loaded load_run(const DeckArguments& arguments) {
  Loaded loaded = load_checked(arguments.request());
  refuse_study(loaded, arguments.path);
  return loaded;
}

void refuse_study(const Loaded& loaded, const std::string& path) {
  if (!loaded.scene || loaded.scene->studies.empty()) return;
  refuse(loaded.scene->studies.front()->at(),
         fmt::format("this deck holds a study, which runs scenes of its own. Do: beadwork calibrate {} --out FOLDER",
                     shell_quoted(path)));
}

}  // namespace beadwork
