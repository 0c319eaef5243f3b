#pragma once
// The folder of a study: what is written into it, and how it went.

#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/failure.hpp"
#include "core/io/own_folder.hpp"
#include "core/loop/scene.hpp"
#include "core/loop/scene_runner.hpp"
#include "core/plugin/curve.hpp"

namespace beadwork {

class Office {
 public:
  using Json = nlohmann::ordered_json;

  /// Takes the folder; `study` is what is conducted, by name. Where it begins anew, what a former one has made is removed,
  /// but for the runs that it comes of.
  enum class Former { kept, removed };
  Office(const std::filesystem::path& out, const Scene& scene, const std::string& study, Former former = Former::kept);

  std::filesystem::path write(const std::string& name, std::string_view text);
  /// A curve, as CSV and for the report: in SI, with one row for each of `rows`.
  void curve(const std::string& name, const CurvePlan& plan, const std::vector<std::vector<Real>>& rows);
  void take_result(Json result) { summary_["result"] = std::move(result); }
  void close(const std::string& status, ExitCode code, const std::string& reason, const SceneRunner& runner);

  const std::filesystem::path& root() const { return folder_.root(); }

 private:
  OwnFolder folder_;
  Json summary_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

}  // namespace beadwork
