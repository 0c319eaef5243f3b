#include "core/plugin/blame.hpp"

#include <fmt/format.h>

#include <new>

#include "core/base/failure.hpp"
#include "core/plugin/plugin.hpp"

namespace beadwork {

void blame(const std::string& whose) {
  try {
    throw;
  } catch (const Fault&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw MachineFailure(whose + ": there is not enough memory for what it asks");
  } catch (const std::exception& error) {
    throw PhysicsFailure(whose + ": " + error.what());
  } catch (...) {
    throw PhysicsFailure(whose + ": it threw something that is no std::exception");
  }
}

std::string whose(const Plugin& plugin, const char* function) {
  return fmt::format("{}: error: plugin {} failed in {}", plugin.at().where(), plugin.id(), function);
}

}  // namespace beadwork
