#pragma once
// What an earlier run left in a folder, and what that means for the next one there.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "core/loop/same_deck.hpp"

namespace beadwork {

class FormerRun {
 public:
  /// Reads summary.json; nothing is known of a run that has not begun, or whose summary cannot be read.
  explicit FormerRun(std::filesystem::path folder);

  bool is_done() const { return text("status") == "done"; }
  /// A text of its summary; empty where there is none.
  std::string text(const char* key) const;
  /// Whether the data files of its deck were the same as these.
  bool had(const FileSums& files) const;
  /// Whether it can be gone on with: it has a checkpoint, and was interrupted, killed, or stopped by the machine. What
  /// physics stopped would stop again. One that is done can be given another end, unless its data files have changed.
  bool can_go_on(const FileSums& files) const;

 private:
  std::filesystem::path folder_;
  nlohmann::json summary_;
};

}  // namespace beadwork
