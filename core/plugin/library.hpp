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
  std::filesystem::path named = {};  ///< as a deck has to name it; empty where it is found without
};

/// The instruction sets beyond the processor's baseline for which libraries exist in variants, widest first, of those
/// that this processor has and that the environment variable BEADWORK_INSTRUCTIONS (baseline, avx2 or avx512: the
/// widest allowed) does not rule out. Throws LibraryFailure if it names no such set.
std::vector<std::string> instruction_sets();

/// The variant of a library for the widest of `sets` that there is: folder/avx2/name beside folder/name; or itself.
std::filesystem::path widest_variant(const std::filesystem::path& path, const std::vector<std::string>& sets);

/// The program's own libraries are opened at once; any other first in a child, since a damaged file can end the process
/// that loads it.
enum class Trust { none, own };

/// Throws LibraryFailure if it cannot be opened, is no plugin library, or was built for another kernel (then with both
/// stamps).
Library open_library(const std::filesystem::path& path, Trust trust = Trust::none);

}  // namespace beadwork
