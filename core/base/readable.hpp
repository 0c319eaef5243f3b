#pragma once
// Whether a file that a deck names is there.

#include <filesystem>
#include <string>

namespace beadwork {

/// Why a file cannot be read, as far as that shows before it is opened; or "".
std::string why_unreadable(const std::filesystem::path& file);

}  // namespace beadwork
