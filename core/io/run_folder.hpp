#pragma once
// The folder that a run writes, and where its files stand. One run at a time: the folder stays locked while this lives.

#include <filesystem>
#include <string>

#include "core/io/file.hpp"

namespace beadwork {

class RunFolder {
 public:
  using Path = std::filesystem::path;

  /// Makes the folder, or takes an empty one. One that holds a run is refused unless `overwrite`, which removes what
  /// a run writes and nothing else; one that holds something else is refused always. DeckFailure for what the user
  /// asks and should not get, MachineFailure for what the machine cannot do.
  static RunFolder fresh(const Path& root, bool overwrite);
  /// Takes the folder of a run that wrote a checkpoint; DeckFailure if there is none.
  static RunFolder resume(const Path& root);

  const Path& root() const { return root_; }
  Path summary() const { return root_ / "summary.json"; }
  Path resolved() const { return root_ / "resolved.xml"; }
  Path record() const { return root_ / "run.h5"; }
  Path view() const { return root_ / "run.xmf"; }
  Path log() const { return root_ / "run.log"; }
  Path checkpoint() const { return root_ / "checkpoint.h5"; }
  Path frames() const { return root_ / "frames"; }
  Path curves() const { return root_ / "curves"; }
  Path curve(const std::string& name) const { return curves() / (name + ".csv"); }

 private:
  explicit RunFolder(Path root) : root_(std::move(root)) {}
  void lock();

  Path root_;
  Descriptor lock_;
};

}  // namespace beadwork
