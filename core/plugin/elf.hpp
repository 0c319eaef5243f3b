#pragma once
// Whether a file is a whole shared library for this processor. The system's loader trusts what it opens: of a file that
// was cut off it maps more than there is, and dies of it.

#include <filesystem>
#include <string>

namespace beadwork {

/// Why the loader should not see this file, as the end of a sentence: "it is cut off: it says ... bytes but has ...";
/// empty if it may.
std::string why_no_shared_library(const std::filesystem::path& file);

}  // namespace beadwork
