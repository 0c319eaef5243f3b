#pragma once
// The folder that a run writes, where its files stand, and which of them it made. One run at a time: the folder stays locked while
// this lives.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/file.hpp"
#include "core/io/manifest.hpp"

namespace beadwork {

/// Makes the folder that a "run" or a "batch" writes, where there is none. DeckFailure if something else stands there or the name can be none,
/// MachineFailure if the machine cannot.
void make_output_folder(const std::filesystem::path& root, std::string_view what);

class RunFolder {
 public:
  using Path = std::filesystem::path;

  /// Makes the folder, or takes an empty one. One that holds a run is refused unless `overwrite`, which removes the files that the
  /// run made and nothing else; one that holds something else is refused always. DeckFailure for what the user asks and should not
  /// get, MachineFailure for what the machine cannot do.
  static RunFolder fresh(const Path& root, bool overwrite);
  /// Takes the folder of a run that wrote a checkpoint, and changes nothing in it; DeckFailure if there is none.
  static RunFolder resume(const Path& root);
  /// Before a resumed run writes: removes what a kill left half written, and makes folders that are missing.
  void clear_leftovers() const;

  /// To be called before a file of the folder is made that has no place below. DeckFailure if somebody else's stands there.
  void claim(const Path& file);
  /// The files that runs made in a folder of this one, and that are there, sorted.
  std::vector<Path> made_in(const Path& folder);

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
  std::optional<Manifest> manifest_;  ///< always there once made
};

}  // namespace beadwork
