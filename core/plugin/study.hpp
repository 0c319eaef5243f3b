#pragma once
// Section <study>: runs whole scenes and learns from what comes of them. A deck that has one has nothing else.

#include <filesystem>
#include <functional>

#include "core/base/log.hpp"
#include "core/plugin/curve.hpp"
#include "core/plugin/plugin.hpp"
#include "core/plugin/runner.hpp"

namespace beadwork {

struct BatchPlan;

/// What a study is lent, and where it leaves what it finds.
struct StudyDesk {
  Runner& runner;
  std::filesystem::path folder;
  const Log& log;          ///< what has been found so far
  std::string provenance;  ///< program, version, deck and its hash, in a line
  /// Writes a file of the study's folder, and tells where it stands.
  std::function<std::filesystem::path(const std::string& name, std::string_view text)> write;
  /// A curve, as CSV and for the report: in SI, with one row for each of `rows`.
  std::function<void(const std::string& name, const CurvePlan& plan, const std::vector<std::vector<Real>>& rows)> curve;
  /// The result, a JSON object, for summary.json.
  std::function<void(const std::string& json)> result;
};

/// Either learns from runs what to run next (`conduct`: a calibration), or is a part of a batch, whose runs are known
/// before (`add_to`: a sweep, what is expected of it).
class Study : public Plugin {
 public:
  static constexpr Kind its_kind = Kind::study;
  Study() : Plugin(its_kind) {}
  virtual void conduct(const StudyDesk&) {}
  /// Whether it is a part of a batch; several such stand in one deck.
  virtual bool is_of_batch() const { return false; }
  virtual void add_to(BatchPlan&) const {}
};

}  // namespace beadwork
