#include "core/base/location.hpp"

namespace beadwork {

std::string Location::where() const {
  if (!source) return {};
  std::string text = source->path;
  if (line > 0) text += ":" + std::to_string(line);
  if (line > 0 && column > 0) text += ":" + std::to_string(column);
  return text;
}

}  // namespace beadwork
