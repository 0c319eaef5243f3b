#pragma once
// A shared library of plugins: opened, its stamp compared, its list taken. Never unloaded: objects of its classes may
// outlive everything else.

#include <filesystem>
#include <string>
#include <vector>

#include "core/plugin/plugin.hpp"

namespace beadwork {

/// What the C entry points of a library are called and look like.
inline constexpr const char* stamp_entry = "beadwork_stamp";
inline constexpr const char* list_entry = "beadwork_plugins";
using StampEntry = const char*();
using ListEntry = const std::vector<PluginEntry>*();

struct Library {
  std::filesystem::path path;
  std::string version;  ///< of the kernel it was built for
  std::vector<PluginEntry> entries;
};

/// Throws LibraryFailure if it cannot be opened, is no plugin library, or was built for another kernel (then with both
/// stamps).
Library open_library(const std::filesystem::path& path);

}  // namespace beadwork
