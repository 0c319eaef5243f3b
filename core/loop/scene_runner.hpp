#pragma once
// Runs the scenes of a study, and calibrations: each as the program itself runs a deck, in a process and a folder of its
// own, several at once. What came of a scene is known by the hash of all that went in, so that nothing is run twice, and
// what a kill has stopped goes on.

#include <atomic>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/base/headway.hpp"
#include "core/base/log.hpp"
#include "core/loop/local_jobs.hpp"
#include "core/plugin/catalogue.hpp"
#include "core/plugin/runner.hpp"

namespace beadwork {

struct SceneRunnerOptions {
  std::filesystem::path program;  ///< beadwork
  std::filesystem::path folder;   ///< for the folders of the runs
  std::string command;            ///< that goes on with the study
  std::vector<std::string> libraries;
  Shares shares;
  const std::atomic<int>* interrupt = nullptr;
  Log log;
  TellHeadway progress = [](const Headway&) {};
};

class SceneRunner final : public Runner {
 public:
  /// `catalogue`: the plugins that the scenes will find; what they are made of counts as input.
  SceneRunner(SceneRunnerOptions options, const Catalogue& catalogue);
  std::vector<Outcome> run(const std::vector<Errand>& errands) override;

  std::size_t runs() const { return runs_; }    ///< that were run
  std::size_t known() const { return known_; }  ///< whose outcome was there
  Real loop_seconds() const;                    ///< that all of them have taken in their loops, whenever that was

 private:
  struct Scene;
  class Events;
  std::vector<Scene> scenes_of(const std::vector<Errand>& errands);
  Scene scene_of(const Errand& errand);
  Outcome outcome_of(const Scene& scene) const;
  std::vector<std::string> command_for(const Errand& errand, const Scene& scene, int threads) const;

  SceneRunnerOptions options_;
  std::string program_sum_;  ///< over the program and its libraries
  std::size_t runs_ = 0, known_ = 0;
  std::map<std::filesystem::path, Real> seconds_;  ///< of each folder
};

/// Over the program, its kernel and the plugin libraries that it has opened, as they are on the disk.
std::string sum_of_program(const std::filesystem::path& program, const Catalogue& catalogue);

}  // namespace beadwork
