#pragma once
// What a plugin throws says whose it is: which plugin, where in the deck, and in which of its functions.

#include <string>

namespace beadwork {

class Plugin;

/// To be called where anything has been caught: throws it again. A Fault explains itself and goes on as it is, and so
/// does want of memory; anything else, an int too, becomes a PhysicsFailure: `whose` + ": " + what was thrown.
[[noreturn]] void blame(const std::string& whose);
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
