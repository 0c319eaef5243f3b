#include <fmt/format.h>

#include "core/base/failure.hpp"
#include "core/base/readable.hpp"
#include "core/base/text.hpp"
#include "core/deck/read.hpp"
#include "workbench/terminal.hpp"
#include "workbench/verbs.hpp"

namespace beadwork {

void DeckArguments::add_to(CLI::App& verb) {
  verb.add_option("deck", path, "The deck, an XML file")->required();
  verb.add_option("--set", settings, "Gives a parameter of the deck another value: name=value")
      ->allow_extra_args(false);
  verb.add_option("--plugins", libraries, "A plugin library, or a folder of them")->allow_extra_args(false);
  verb.add_flag("--no-plugins", no_plugins, "Loads no library that the deck itself names: for decks from elsewhere");
}

std::string shown(const Fault& fault) {
  const std::string text = fault.what();
  if (fault.code() == ExitCode::interrupted) return text;
  return text.find("error: ") == std::string::npos ? "error: " + text : text;
}

namespace {

// Those of the deck's 'plugins'.
std::vector<std::filesystem::path> named_libraries(const Deck& deck, bool none, Complaints& complaints) {
  const Attribute* named = deck.root->find("plugins");
  if (!named) return {};
  const auto paths = read_paths(*named, deck.scope, complaints);
  if (!paths) return {};
  if (none) {
    complaints.warning(named->value_at, "these libraries are not loaded (--no-plugins), so their plugins are unknown");
    return {};
  }
  std::vector<std::filesystem::path> libraries;
  for (const std::string& path : *paths) {
    const std::string why = why_unreachable(path);
    std::error_code error;
    if (std::filesystem::status(path, error).type() == std::filesystem::file_type::not_found)
      throw LibraryFailure(
          fmt::format("{}: error: no plugin library: there is no file {}", named->value_at.where(), path));
    if (!why.empty()) refuse(named->value_at, fmt::format("cannot read plugin library \"{}\": {}", path, why));
    libraries.emplace_back(path);
  }
  return libraries;
}

}  // namespace

Loaded load_scene(const DeckArguments& arguments) {
  Complaints complaints;
  Loaded loaded = load_scene(arguments, complaints);
  complaints.throw_if_any();
  if (complaints.warnings() > 0) write_error(complaints.text());
  return loaded;
}

Loaded load_scene(const DeckArguments& arguments, Complaints& complaints) {
  std::vector<Override> overrides;
  for (const std::string& setting : arguments.settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0)
      throw DeckFailure(fmt::format("error: --set wants name=value, got \"{}\"", setting));
    overrides.push_back({setting.substr(0, equals), setting.substr(equals + 1)});
  }
  Loaded loaded;
  loaded.deck = read_deck(arguments.path, overrides, complaints);
  if (!loaded.deck) return loaded;
  std::vector<std::filesystem::path> extra = named_libraries(*loaded.deck, arguments.no_plugins, complaints);
  extra.insert(extra.end(), arguments.libraries.begin(), arguments.libraries.end());
  loaded.catalogue = Catalogue::open(extra);
  loaded.scene = Scene::assemble(*loaded.deck, loaded.catalogue, complaints);
  return loaded;
}

}  // namespace beadwork
