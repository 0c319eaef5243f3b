#pragma once
// Reads single datasets of an HDF5 file into plain numbers, for who needs no frame: stored packings, tests.

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/types.hpp"

namespace beadwork {

struct Dataset {
  std::vector<std::size_t> extent;
  std::vector<Real> numbers;  ///< row by row
  std::string unit;           ///< empty where the file says nothing
  std::string long_name;
};

/// Throws MachineFailure if the file or the dataset cannot be read, or holds no numbers.
Dataset read_dataset(const std::filesystem::path& file, const std::string& name);
/// As above, of a scalar dataset of text.
std::string read_dataset_text(const std::filesystem::path& file, const std::string& name);

}  // namespace beadwork
