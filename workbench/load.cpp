#include <fmt/format.h>

#include <cstdio>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"
#include "core/deck/read.hpp"
#include "workbench/verbs.hpp"

namespace beadwork {

void DeckArguments::add_to(CLI::App& verb) {
  verb.add_option("deck", path, "The deck, an XML file")->required();
  verb.add_option("--set", settings, "Gives a parameter of the deck another value: name=value")->allow_extra_args(false);
  verb.add_option("--plugins", libraries, "A plugin library, or a folder of them")->allow_extra_args(false);
}

std::string shown(const Fault& fault) {
  const std::string text = fault.what();
  if (fault.code() == ExitCode::interrupted) return text;
  return text.find("error: ") == std::string::npos ? "error: " + text : text;
}

Loaded load_scene(const DeckArguments& arguments) {
  Complaints complaints;
  Loaded loaded = load_scene(arguments, complaints);
  complaints.throw_if_any();
  if (complaints.warnings() > 0) std::fprintf(stderr, "%s", complaints.text().c_str());
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
  std::vector<std::filesystem::path> extra;
  if (const Attribute* plugins = loaded.deck->root->find("plugins"))
    if (const auto paths = read_paths(*plugins, loaded.deck->scope, complaints))
      for (const std::string& path : *paths) {
        extra.emplace_back(path);
        std::error_code unknown;
        if (!std::filesystem::exists(extra.back(), unknown))
          throw LibraryFailure(fmt::format("{}: error: no plugin library: there is no file {}", plugins->value_at.where(), path));
      }
  extra.insert(extra.end(), arguments.libraries.begin(), arguments.libraries.end());
  loaded.catalogue = Catalogue::open(extra);
  loaded.scene = Scene::assemble(*loaded.deck, loaded.catalogue, complaints);
  return loaded;
}

}  // namespace beadwork
