#pragma once
// The curves of several runs, laid over one another.

#include <deque>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "workbench/report/run.hpp"

namespace beadwork::report {

class Overlay {
 public:
  /// What stands there of a run; what cannot be read is noted.
  void add(const std::filesystem::path& folder, const std::string& label);
  void note(const std::string& sentence);
  /// A section of this title, nothing where there are no curves.
  std::string charts(const std::string& title = "Curves") const;
  /// The chart of one curve; nothing where no run has it.
  std::string chart(const std::string& name) const;
  /// Section of what there is to say of the runs, nothing where there is nothing.
  std::string notes() const;

 private:
  std::deque<Curve> curves_;        // do not move
  std::vector<std::string> names_;  // in the order in which they were met
  std::map<std::string, std::vector<std::pair<std::string, const Curve*>>> by_name_;
  std::string notes_;
};

}  // namespace beadwork::report
