#include <fmt/format.h>

#include <algorithm>

#include "core/base/failure.hpp"
#include "core/base/readable.hpp"
#include "core/base/text.hpp"
#include "core/io/file.hpp"
#include "workbench/terminal.hpp"
#include "workbench/verbs.hpp"

namespace beadwork {

namespace {

/// A setting a line; what begins with # is a remark.
std::vector<Override> settings_in(const std::string& file) {
  constexpr std::uintmax_t longest = 1 << 20;
  if (const std::string why = why_unreadable(file); !why.empty())
    throw DeckFailure(fmt::format("error: cannot read the settings '{}': {}", file, why));
  std::string text = read_text(file, longest);
  if (text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
  std::vector<Override> all;
  int number = 0;
  for (const std::string& raw : split(text, '\n')) {
    const std::string line(trim(raw));
    ++number;
    if (line.empty() || line.starts_with('#')) continue;
    all.push_back(setting_of(line, fmt::format("{}:{}: name=value is wanted, got \"{}\"", file, number, line)));
    all.back() = {std::string(trim(all.back().name)), std::string(trim(all.back().value))};
  }
  return all;
}

}  // namespace

Override setting_of(const std::string& text, const std::string& complaint) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) throw DeckFailure("error: " + complaint);
  return {text.substr(0, equals), text.substr(equals + 1)};
}

void DeckArguments::add_to(CLI::App& verb) {
  verb.add_option("deck", path, "The deck, an XML file")->required();
  add_options_to(verb);
}

void DeckArguments::add_options_to(CLI::App& verb) {
  verb.add_option("--set", settings, "Gives a parameter of the deck another value: name=value")
      ->allow_extra_args(false);
  verb.add_option("--settings", files, "File of such settings, a line each; --set goes before what it says")
      ->allow_extra_args(false);
  verb.add_option("--plugins", libraries, "A plugin library, or a folder of them")->allow_extra_args(false);
  verb.add_flag("--no-plugins", no_plugins, "Loads no library that the deck itself names: for decks from elsewhere");
}

DeckRequest DeckArguments::request() const {
  DeckRequest request{path, {}, libraries, no_plugins};
  for (const std::string& setting : settings)
    request.overrides.push_back(setting_of(setting, fmt::format("--set wants name=value, got \"{}\"", setting)));
  const std::vector<Override> typed = request.overrides;
  for (const std::string& file : files)
    for (const Override& each : settings_in(file))  // twice in files is refused like twice in --set
      if (std::none_of(typed.begin(), typed.end(), [&](const Override& other) { return other.name == each.name; }))
        request.overrides.push_back(each);
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
  const Study& study = *loaded.scene->studies.front();
  refuse(study.at(),
         fmt::format("this deck holds a study, which runs scenes of its own. Do: beadwork {} {} --out FOLDER{}",
                     study.is_of_batch() ? "batch" : "calibrate", shell_quoted(path),
                     study.is_of_batch() ? "; what it would run: --dry-run" : ""));
}

}  // namespace beadwork
