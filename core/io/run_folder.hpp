#pragma once
// The folder that a run writes, where its files stand, and which of them it made. One run at a time: the folder stays
// locked while this lives.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/file.hpp"
#include "core/io/manifest.hpp"

namespace beadwork {

/// Makes the folder that a "run" or a "batch" writes, where there is none. DeckFailure if something else stands there
/// or the name can be none, MachineFailure if the machine cannot.
void make_output_folder(const std::filesystem::path& root, std::string_view what);

class RunFolder {
 public:
  using Path = std::filesystem::path;

  /// Makes the folder, or takes an empty one. One that holds a run is refused unless `overwrite`, and stays as it is
  /// until the new one takes over; one that holds something else is refused always. DeckFailure for what the user asks
  /// and should not get, MachineFailure for what the machine cannot do.
  static RunFolder fresh(const Path& root, bool overwrite);
  /// Removes the files that a former run made, and nothing else: to be called when the new one is known to begin.
  void take_over();
  /// Whether a former run still stands here.
  bool holds_former() const { return former_.has_value(); }
  /// Takes the folder of a run that wrote a checkpoint, and changes nothing in it; DeckFailure if there is none.
  static RunFolder resume(const Path& root);
  /// Before a resumed run writes: removes what a kill left half written, and makes folders that are missing.
  void clear_leftovers() const;

  /// To be called before a file of the folder is made that has no place below. DeckFailure if somebody else's stands
  /// there.
  void claim(const Path& file);
  /// The files that runs made in a folder of this one, and that are there, sorted.
  std::vector<Path> made_in(const Path& folder);

  const Path& root() const { return root_; }
  Path summary() const { return root_ / "summary.json"; }
  Path resolved() const { return root_ / "resolved.xml"; }
  Path record() const { return root_ / "run.h5"; }
  Path view() const { return root_ / "run.xmf"; }
  /// Of this run; beside that of the former run until this one begins.
  Path log() const;
  Path checkpoint() const { return root_ / "checkpoint.h5"; }
  Path frames() const { return root_ / "frames"; }
  Path curves() const { return root_ / "curves"; }
  Path curve(const std::string& name) const { return curves() / (name + ".csv"); }

 private:
  explicit RunFolder(Path root) : root_(std::move(root)) {}
  void lock();
  void begin();

  Path root_;
  Descriptor lock_;
  std::optional<Manifest> manifest_;  ///< always there once the run has begun
  std::optional<Manifest> former_;    ///< of the run that is to be replaced, until this one begins
};

}  // namespace beadwork
