#include "core/base/readable.hpp"

#include <unistd.h>

namespace beadwork {

std::string why_unreadable(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) return "there is no such file";
  if (std::filesystem::is_directory(status)) return "it is a folder";
  if (!std::filesystem::is_regular_file(status)) return "it is no ordinary file";
  if (::access(file.c_str(), R_OK) != 0) return "it may not be read";
  return {};
}

}  // namespace beadwork
