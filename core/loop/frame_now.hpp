#pragma once
// What is recorded as the frame of the present step. It is kept in checkpoints: what a kill has left may hold more,
// seen after the checkpoint, and a resumed run makes it what it was.

#include <optional>
#include <string>

#include "core/plugin/kinds.hpp"

namespace beadwork {

struct FrameNow {
  std::int64_t step = -1;
  int stage = 0;
  bool of_one_stage = true;  ///< false where the stage before had a part in it: its families may act no longer
  FramePlan plan;

  void add(const Moment& moment, const FramePlan& more);
  bool is_of(const Moment& moment) const { return step == moment.step; }
  /// Whether it can be recorded anew from the state as it is.
  bool can_be_made_anew(const Moment& moment) const { return is_of(moment) && stage == moment.stage && of_one_stage; }

  std::string json() const;
  /// Nothing where it is no such text.
  static std::optional<FrameNow> of(const std::string& json);
};

}  // namespace beadwork
