#include "core/plugin/catalogue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/dll/runtime_symbol_info.hpp>
#include <cstdlib>

#include "core/base/failure.hpp"
#include "core/base/readable.hpp"
#include "core/base/text.hpp"
#include "core/plugin/blame.hpp"

namespace beadwork {

namespace fs = std::filesystem;

namespace {

std::vector<fs::path> libraries_in(const fs::path& place) {
  std::error_code error;
  if (!fs::is_directory(place, error)) return {place};
  std::vector<fs::path> found;
  for (auto file = fs::directory_iterator(place, error); !error && file != fs::directory_iterator();
       file.increment(error))
    if (file->path().extension() == ".so") found.push_back(file->path());
  if (error)
    throw LibraryFailure(fmt::format("cannot look for plugin libraries in {}: {}", place.string(), error.message()));
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

std::filesystem::path kernel_library() { return boost::dll::this_line_location().string(); }

Catalogue Catalogue::open(const std::vector<fs::path>& extra) {
  std::vector<fs::path> places = extra;
  if (const char* variable = std::getenv("BEADWORK_PLUGINS"))
    for (const std::string& place : split(variable, ':'))
      if (!place.empty()) places.emplace_back(place);
  const fs::path core = kernel_library();
  places.push_back(fs::canonical(core).parent_path() / "beadwork");

  const std::vector<std::string> sets = instruction_sets();
  Catalogue catalogue;
  std::vector<fs::path> opened;
  for (const fs::path& place : places) {
    for (const fs::path& path : libraries_in(place)) {
      const fs::path real = widest_variant(canonical_path(path.string()), sets);
      if (std::find(opened.begin(), opened.end(), real) != opened.end()) continue;
      opened.push_back(real);
      const bool is_own = &place == &places.back();
      Library library = open_library(real, is_own ? Trust::own : Trust::none);
      if (!is_own) library.named = fs::absolute(path).lexically_normal();
      catalogue.add(std::move(library));
      for (const std::string& set : sets)
        if (real.parent_path().filename() == set) catalogue.instructions_ = set;
    }
  }
  return catalogue;
}

void Catalogue::add(Library library) {
  for (const PluginEntry& entry : library.entries) {
    const auto [there, fresh] =
        entries_.try_emplace({entry.kind, entry.tag}, Place{entry, library.path, library.named});
    if (!fresh)
      throw LibraryFailure(fmt::format("<{}> <{}> is in two plugin libraries: {} and {}. Remove or rename one of them",
                                       kind_name(entry.kind), entry.tag, there->second.library.string(),
                                       library.path.string()));
  }
  libraries_.push_back(std::move(library));
}

const PluginEntry* Catalogue::find(Kind kind, const std::string& tag) const {
  const auto found = entries_.find({kind, tag});
  return found == entries_.end() ? nullptr : &found->second.entry;
}

std::unique_ptr<Plugin> Catalogue::make(Kind kind, const std::string& tag, const std::string& at) const {
  const PluginEntry* found = find(kind, tag);
  if (!found) return nullptr;
  try {
    return found->make();
  } catch (...) {
    blame(fmt::format("{}error: plugin {}.{} of {} failed in its constructor", at.empty() ? "" : at + ": ",
                      kind_name(kind), tag, library_of(kind, tag)));
  }
}

std::vector<std::string> Catalogue::tags(Kind kind) const {
  std::vector<std::string> names;
  for (const auto& [key, place] : entries_)
    if (key.first == kind) names.push_back(key.second);
  return names;
}

std::vector<Kind> Catalogue::kinds_of(const std::string& tag) const {
  std::vector<Kind> kinds;
  for (const auto& [key, place] : entries_)
    if (key.second == tag) kinds.push_back(key.first);
  return kinds;
}

std::string Catalogue::library_of(Kind kind, const std::string& tag) const {
  const auto found = entries_.find({kind, tag});
  return found == entries_.end() ? "" : found->second.library.string();
}

std::string Catalogue::named_library(Kind kind, const std::string& tag) const {
  const auto found = entries_.find({kind, tag});
  return found == entries_.end() ? "" : found->second.named.string();
}

}  // namespace beadwork
