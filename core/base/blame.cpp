#include "core/base/blame.hpp"

#include <new>

#include "core/base/failure.hpp"

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

}  // namespace beadwork
