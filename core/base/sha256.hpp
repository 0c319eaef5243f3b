#pragma once

#include <string>
#include <string_view>

namespace beadwork {

/// The SHA-256 of some bytes, in 64 hexadecimal digits.
std::string sha256(std::string_view bytes);
/// That of a file's bytes. MachineFailure if it cannot be read.
std::string sha256_of_file(const std::string& path);

}  // namespace beadwork
