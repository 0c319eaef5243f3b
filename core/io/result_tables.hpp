#pragma once
// Tables of results, a row for each run: as CSV for people, as HDF5 for programs.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace beadwork {

struct ResultTable {
  std::vector<std::string> head;  ///< "young", "force: largest force [N]"
  std::vector<std::vector<std::string>> rows;
};

/// A line of such a file.
std::string csv_line(const std::vector<std::string>& cells);
/// UTF-8, whatever the cells hold; in quotes where that is needed.
std::string csv_of(const ResultTable& table);

/// A group for each table, a dataset for each column under its name (with '-' for '/', and without its unit): real numbers
/// with the attribute `unit` where all cells that are not empty are numbers (nan where one is empty), or quantities of one
/// kind such as "30 GPa" (in SI); text otherwise. The attribute `columns` of a group has their order. Throws MachineFailure.
void write_result_tables(const std::filesystem::path& file,
                         const std::vector<std::pair<std::string, ResultTable>>& tables);

}  // namespace beadwork
