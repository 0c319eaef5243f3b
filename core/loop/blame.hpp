#pragma once
// What a plugin throws in the middle of a run says who threw it, and when.

#include <fmt/format.h>

#include "core/plugin/blame.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork {

/// Does `task`, a call of this plugin.
template <class F>
decltype(auto) blaming(const Plugin& plugin, const Moment& moment, const F& task) {
  try {
    return task();
  } catch (...) {
    blame(fmt::format("{}: error: step {}: plugin {} failed", plugin.at().where(), moment.step, plugin.id()));
  }
}

}  // namespace beadwork
