#pragma once
// Tables whose fields may be quoted, with commas and line breaks in them.

#include <filesystem>
#include <string>
#include <vector>

namespace beadwork::report {

using Row = std::vector<std::string>;

/// The rows of a CSV file. MachineFailure if it cannot be read.
std::vector<Row> quoted_rows(const std::filesystem::path& file);

}  // namespace beadwork::report
