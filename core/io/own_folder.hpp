#pragma once
// The folder of a batch or a study: one at a time writes there, and only over what a former one has made.

#include <filesystem>
#include <optional>
#include <string>

#include "core/io/manifest.hpp"

namespace beadwork {

class OwnFolder {
 public:
  /// Makes the folder, or takes one that is there. DeckFailure if it can be none, or if another one writes there.
  OwnFolder(const std::filesystem::path& root, Manifest::Of of);
  /// Where a file stands that is to be written now. DeckFailure if somebody else's is there.
  std::filesystem::path claim(const std::string& name);
  /// Removes the files that a former one has made here, and nothing else.
  void clear();
  const std::filesystem::path& root() const { return root_; }

 private:
  std::filesystem::path root_;
  Manifest::Of of_;
  Descriptor lock_;
  std::optional<Manifest> list_;  ///< once there is one
};

/// Whether some process is writing this folder.
bool is_busy(const std::filesystem::path& folder);
/// The process that has locked a file or folder, where the system tells: "process 4711", or "another process".
std::string holder_of(const std::filesystem::path& path);

}  // namespace beadwork
