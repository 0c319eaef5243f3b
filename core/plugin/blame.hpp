#pragma once
// What a plugin throws says whose it is: which plugin, where in the deck, and in which of its functions.

#include "core/base/blame.hpp"

namespace beadwork {

class Plugin;

/// "deck.xml:3:5: error: plugin bond.rope failed in check"
std::string whose(const Plugin& plugin, const char* function);

/// Does `task`, a call of this function of the plugin's.
template <class F>
decltype(auto) blaming(const Plugin& plugin, const char* function, const F& task) {
  try {
    return task();
  } catch (...) {
    blame(whose(plugin, function));
  }
}

}  // namespace beadwork
