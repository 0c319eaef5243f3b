#pragma once
// A packing as a table of text, as spreadsheets and other programs write it.

#include <filesystem>

#include "core/base/pause.hpp"
#include "core/io/packing_columns.hpp"
#include "core/io/packing_file.hpp"

namespace beadwork {

/// Reads a table with a line for each element. Cells stand apart by semicolons, commas, tabs or blanks; lines that
/// begin with # are remarks. The first other line may name the columns (packing_columns.hpp), or a remark in front of
/// it that names places and sizes; what is named neither there nor by `form.columns` is x y z radius. Throws
/// DeckFailure with line and column.
StoredPacking read_packing_text(const std::filesystem::path& file, const TextForm& form, const Pause& pause);

}  // namespace beadwork
