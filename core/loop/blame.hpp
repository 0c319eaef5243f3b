#pragma once
// What a plugin throws in the middle of a run says who threw it, and when.

#include <fmt/format.h>

#include <new>

#include "core/base/failure.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork {

/// Does `task`, a call of this plugin. What is a Fault already explains itself; anything else becomes a PhysicsFailure.
template <class F>
decltype(auto) blaming(const Plugin& plugin, const Moment& moment, const F& task) {
  try {
    return task();
  } catch (const Fault&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw PhysicsFailure(fmt::format("{}: error: step {}: plugin {} failed: {}", plugin.at().where(), moment.step, plugin.id(), error.what()));
  }
}

}  // namespace beadwork
