#pragma once

#include <string>
#include <string_view>

namespace beadwork {

/// The SHA-256 of some bytes, in 64 hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace beadwork
