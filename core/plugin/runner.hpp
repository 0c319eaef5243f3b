#pragma once
// What runs whole scenes for a study: a deck and values of its parameters go in, what came of it comes out.

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/base/curve_table.hpp"
#include "core/base/failure.hpp"
#include "core/base/types.hpp"
#include "core/deck/deck.hpp"

namespace beadwork {

/// A scene to be run.
struct Errand {
  std::string name;  ///< "tension-x, seed 2": what it is called where one waits for it
  std::filesystem::path deck;
  std::vector<Override> overrides = {};
};

/// What came of a scene. One that failed is an outcome too: whoever asked decides what that means.
struct Outcome {
  ExitCode code = ExitCode::done;
  std::string reason;            ///< why it ended
  std::filesystem::path folder;  ///< what it wrote stands there
  bool was_known = false;        ///< it had been run before, with all that went into it the same
  /// Each number of summary.json by its way there, "packing/0/coordination", "breaks/axial".
  std::map<std::string, Real> numbers = {};
  std::map<std::string, CurveTable> curves = {};  ///< by name, in SI

  bool is_done() const { return code == ExitCode::done; }
  /// The column of a curve; empty where there is none.
  std::span<const Real> column(const std::string& curve, const std::string& name) const;
  /// NaN where there is none.
  Real number(const std::string& name) const;
};

class Runner {
 public:
  virtual ~Runner() = default;
  /// All of them, several at once, each in a process and in a folder of its own; outcomes in the order of the errands.
  /// What has been run before is not run again. Throws Interrupted; MachineFailure or LibraryFailure where it is not the
  /// scene that failed.
  virtual std::vector<Outcome> run(const std::vector<Errand>& errands) = 0;
};

}  // namespace beadwork
