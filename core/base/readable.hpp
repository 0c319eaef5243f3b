#pragma once
// Whether a file that a deck names is there, without an exception whatever the file system says of its name.

#include <filesystem>
#include <string>

namespace beadwork {

/// Why nothing of that name can be read, as far as that shows before it is opened ("there is no such file", "File name
/// too long", "Permission denied"); or "".
std::string why_unreachable(const std::filesystem::path& place);

/// The same for what must be an ordinary file.
std::string why_unreadable(const std::filesystem::path& file);

/// The one name by which a file is known, however it is reached; where the file system cannot tell, the path itself.
std::string canonical_path(const std::string& file);

}  // namespace beadwork
