#pragma once
// What can go wrong, by whose fault: the type decides the exit code of the program (docs/concepts.md, "Errors").

#include <stdexcept>
#include <string>

namespace beadwork {

enum class ExitCode { done = 0, machine = 1, deck = 2, physics = 3, library = 4, interrupted = 5 };

class Fault : public std::runtime_error {
 public:
  Fault(ExitCode code, const std::string& what) : std::runtime_error(what), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

struct DeckFailure : Fault {
  explicit DeckFailure(const std::string& what) : Fault(ExitCode::deck, what) {}
};
struct PhysicsFailure : Fault {
  explicit PhysicsFailure(const std::string& what) : Fault(ExitCode::physics, what) {}
};
struct LibraryFailure : Fault {
  explicit LibraryFailure(const std::string& what) : Fault(ExitCode::library, what) {}
};
struct Interrupted : Fault {
  explicit Interrupted(const std::string& what) : Fault(ExitCode::interrupted, what) {}
};
struct MachineFailure : Fault {
  explicit MachineFailure(const std::string& what) : Fault(ExitCode::machine, what) {}
};

}  // namespace beadwork
