#pragma once
// What somebody else's code throws says whose it is.

#include <string>

namespace beadwork {

/// To be called where anything has been caught: throws it again. A Fault explains itself and goes on as it is, and so does
/// want of memory; anything else, an int too, becomes a PhysicsFailure: `whose` + ": " + what was thrown.
[[noreturn]] void blame(const std::string& whose);

}  // namespace beadwork
