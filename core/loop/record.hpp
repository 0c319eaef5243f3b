#pragma once
// What a run leaves: curves, frames, checkpoints, summary.json. Whatever ends it, the record is whole and says why.

#include <chrono>
#include <memory>
#include <optional>

#include "core/base/failure.hpp"
#include "core/io/checkpoint.hpp"
#include "core/io/curve_file.hpp"
#include "core/io/recorder.hpp"
#include "core/io/run_folder.hpp"
#include "core/loop/balance.hpp"
#include "core/loop/frame_now.hpp"
#include "core/loop/run_options.hpp"
#include "core/loop/same_deck.hpp"

namespace beadwork {

/// What a run did, for summary.json.
struct RunFigures {
  std::string status = "running";
  std::string exit_reason;
  std::optional<ExitCode> exit_code;  ///< once it has ended: by whose fault
  Real wall_seconds = 0,
       loop_seconds = 0;  ///< the loop's are those of steps and looks, without filling and checkpoints
  Real bond_updates = 0;
  std::vector<std::string> packing_reports;  ///< JSON objects
  std::vector<std::string> notes;            ///< what is to be known of the record, a sentence each
  QualityFigures quality;
};

class Record final : public CurveSink {
 public:
  using Clock = std::chrono::steady_clock;

  Record(RunState& state, const Catalogue& catalogue, RunFolder& folder, RunOptions& options, Fresh& fresh,
         Balance& balance);
  ~Record() override;

  /// Takes up the newest checkpoint; what is refused here leaves the folder as it was.
  void load();
  /// Opens run.h5, and cuts what comes after the checkpoint.
  void open();
  void row(const std::string& curve, const CurvePlan& plan, std::span<const Real> values) override;
  void frame(const FramePlan& plan);
  /// The frame of the step of the checkpoint, as it was then: what looked after it may have added to it.
  void frame_anew();

  void save();
  /// Tells how far the run has come, and saves, when it is time to; whether it saved.
  bool save_now_and_then(Clock::time_point now);
  /// Holds the room of the next checkpoint, where its part file will stand: when the disk is full it can still be
  /// written.
  void reserve_room() const;
  /// Of the newest checkpoint; nothing where there is none.
  std::optional<std::int64_t> saved_step() const { return saved_step_; }
  /// From the first step on it is this session that ends, one way or another.
  void note_step() { former_summary_.reset(); }

  /// An orderly end, for better or worse: the record is whole, and says why the run ended.
  void close(const std::string& status, ExitCode code, const std::string& reason);
  /// The machine gave out: what can still be kept is kept, each for itself.
  void rescue(const std::string& reason);

  RunFigures& figures() { return figures_; }

 private:
  void take_rows(CurveSink* sink) const;
  CurveFile begun(const std::string& curve, const CurvePlan& plan);
  RunMeta meta() const;
  std::vector<std::filesystem::path> curves_to_cut() const;
  std::string curve_ends();
  void check_restored(const CheckpointMeta& meta) const;
  std::optional<std::string> ended_summary() const;
  void leave_as_found() const;
  void show_progress();
  void write_summary();
  std::string summary() const;
  void say_largest_uses(bool failed) const;
  Real wall_seconds() const;

  RunState& state_;
  const Catalogue& catalogue_;
  RunFolder& folder_;
  RunOptions& options_;
  Fresh& fresh_;
  Balance& balance_;
  RunFigures figures_;
  FileSums files_;  ///< that the deck names for data
  std::map<std::string, CurveFile> curves_;
  std::map<std::string, CurveEnd> curve_ends_;  ///< when the newest checkpoint was written
  FrameNow frame_now_;
  std::optional<Recorder> recorder_;
  std::optional<std::string> former_summary_;  ///< of the run that is resumed, as long as no step has been made
  std::optional<std::int64_t> saved_step_;     ///< of the newest checkpoint
  Real wall_before_ = 0;                       ///< seconds of the sessions before a restart
  Clock::time_point began_, saved_, shown_;
};

}  // namespace beadwork
