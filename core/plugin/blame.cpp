#include "core/plugin/blame.hpp"

#include <fmt/format.h>

#include "core/plugin/plugin.hpp"

namespace beadwork {

std::string whose(const Plugin& plugin, const char* function) {
  return fmt::format("{}: error: plugin {} failed in {}", plugin.at().where(), plugin.id(), function);
}

}  // namespace beadwork
