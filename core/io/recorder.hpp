#pragma once
// Records frames into run.h5, which can be opened at any moment, after a kill as well: each frame is a file of its
// own that never changes, run.h5 links to them and is replaced as a whole, and an orderly end copies all into one file
// (docs/decisions/run-h5.md).

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/domain/domain.hpp"
#include "core/io/run_folder.hpp"
#include "core/io/xdmf.hpp"

namespace beadwork {

/// What run.h5 says of the run as a whole.
struct RunMeta {
  std::string name;
  std::string deck;      ///< text as it was read
  std::string resolved;  ///< text with every value in SI
  std::string deck_sha256;
  std::vector<std::string> overrides;  ///< "name=value" of the command line
  std::vector<std::string> files;      ///< "sha256  path" of those that the deck names for data
  std::string version;
  std::vector<std::string> plugins;  ///< "section/tag version path-of-library"
  int threads = 1;
  std::uint64_t seed = 0;
  std::string packing;  ///< report on the packing, as JSON
};

struct FrameStamp {
  std::int64_t step = 0;
  Real time = 0;  ///< [s]
  Index stage = 0;
};

struct FamilyRequest {
  const BondTable* table = nullptr;
  std::string law;                     ///< tag of the law
  std::vector<const Column*> columns;  ///< besides id, ends and state, which are always written
};

struct FrameRequest {
  std::vector<const Column*> elements;  ///< besides id, position and radius, which are always written
  std::vector<FamilyRequest> bonds;     ///< families to write
  bool picture = false;                 ///< the report is to draw this frame
  std::string view = {};                ///< axes along which it looks, "z y"; empty: it chooses
};

class Recorder {
 public:
  /// Writes a run.h5 that has no frames yet.
  static Recorder fresh(RunFolder& folder, RunMeta meta, const Domain& domain);
  /// Takes up the frames up to and with `step` and drops later ones; breaks are those of the domain, as loaded.
  /// Everything is looked at before anything is changed. What is damaged is kept under another name (run.h5.damaged),
  /// and told in `notes`.
  static Recorder resume(RunFolder& folder, RunMeta meta, const Domain& domain, std::int64_t step);

  /// Adds a frame. A second request at the same step adds its columns to the first one's.
  void write(const FrameStamp& stamp, const FrameRequest& request, const Domain& domain);
  /// Brings the log of breaks in run.h5 up to date without a frame.
  void write_breaks(const Domain& domain);
  /// For an orderly end, as the last call: makes run.h5 one file that needs no other. Returns false, with run.h5 and
  /// the frames left as they are and `reason` set, if that cannot be done (disk full).
  bool consolidate(const Domain& domain, std::string& reason);
  /// What was found damaged and set aside, a sentence each.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  struct Source {
    std::string file;            ///< relative to the folder
    std::string group;           ///< inside that file
    std::vector<XdmfPart> view;  ///< the frame's part of run.xmf
  };

  using Path = std::filesystem::path;
  /// What stands in the folder of a run that is to go on.
  struct Found {
    std::map<std::int64_t, Source> frames;  ///< up to the step from which it goes on
    std::vector<Path> later;                ///< frames after it
    std::vector<Path> damaged;
    bool keep_record = false;  ///< run.h5 holds frames itself
  };

  Recorder(RunFolder& folder, RunMeta meta);
  Found survey(std::int64_t step);
  void look_into(const Path& file, const std::string& frames_in, const std::string& as, std::int64_t step,
                 Found& found);
  void take_up(Found found);
  std::vector<Path> frame_files() const;
  Path place_for_record() const;
  void keep_damaged(const Path& file);
  std::uintmax_t write_one_file(const std::filesystem::path& part, const Domain& domain) const;
  std::uintmax_t room_for_one_file() const;
  void write_master(const Domain& domain) const;
  void write_view() const;
  void require_open() const;

  RunFolder* folder_;
  Path root_, record_, view_, frames_folder_;
  RunMeta meta_;
  std::map<std::int64_t, Source> frames_;  ///< by step
  FrameRequest latest_;
  std::int64_t latest_step_ = -1;
  bool closed_ = false;  ///< consolidated
  std::vector<std::string> notes_;
};

}  // namespace beadwork
