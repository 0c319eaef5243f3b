#pragma once
// A check sum at the end of a file, behind what its format reads, so that every damaged byte is recognised before the
// file is believed.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace beadwork {

/// The line to append to these bytes.
std::string check_sum_trailer(std::span<const std::byte> bytes);

/// Throws MachineFailure if the file cannot be read, or its last line does not fit what stands before it.
void verify_check_sum(const std::filesystem::path& file);

}  // namespace beadwork
