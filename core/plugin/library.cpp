#include "core/plugin/library.hpp"

#include <boost/dll/shared_library.hpp>

#include "core/base/failure.hpp"
#include "core/plugin/stamp.hpp"

namespace beadwork {

Library open_library(const std::filesystem::path& path) {
  boost::dll::fs::error_code error;
  auto* library = new boost::dll::shared_library;  // never unloaded, on purpose
  library->load(path,
                boost::dll::load_mode::rtld_now | boost::dll::load_mode::rtld_local, error);
  if (error) throw LibraryFailure(fmt::format("cannot open plugin library {}: {}", path.string(), error.message()));
  if (!library->has(stamp_entry) || !library->has(list_entry))
    throw LibraryFailure(fmt::format("{} is no plugin library: it lacks {} or {} (build it with beadwork_add_plugins)",
                                     path.string(), stamp_entry, list_entry));
  const std::string theirs = library->get<StampEntry>(stamp_entry)();
  const std::string ours = compiled_stamp();
  if (theirs != ours)
    throw LibraryFailure(fmt::format("plugin library {} does not fit this program: rebuild it\n  library: {}\n  program: {}",
                                     path.string(), theirs, ours));
  return {path, theirs, *library->get<ListEntry>(list_entry)()};
}

}  // namespace beadwork
