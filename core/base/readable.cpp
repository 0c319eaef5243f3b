#include "core/base/readable.hpp"

#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstring>

namespace beadwork {

namespace fs = std::filesystem;

std::string why_unreachable(const fs::path& place) {
  std::error_code error;
  const auto status = fs::status(place, error);
  if (status.type() == fs::file_type::not_found) return "there is no such file";
  if (!fs::status_known(status)) return error.message();
  if (::access(place.c_str(), R_OK) != 0) return errno == EACCES ? "it may not be read" : std::strerror(errno);
  return {};
}

std::string why_unreadable(const fs::path& file) {
  if (std::string why = why_unreachable(file); !why.empty()) return why;
  std::error_code error;
  if (fs::is_directory(file, error)) return "it is a folder";
  if (!fs::is_regular_file(file, error)) return "it is no ordinary file";
  return {};
}

std::string canonical_path(const std::string& file) {
  std::error_code error;
  const fs::path canonical = file.size() > PATH_MAX ? fs::path() : fs::weakly_canonical(file, error);
  return error || canonical.empty() ? file : canonical.string();
}

}  // namespace beadwork
