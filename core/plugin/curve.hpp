#pragma once
// A curve of a watcher: a table that grows by a row now and then and ends up as a CSV file. It is a member of the
// watcher, like a parameter, so that its file, its columns and how it is drawn are known before the run.

#include <initializer_list>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/plugin/param.hpp"

namespace beadwork {

class Watcher;

/// What the columns of a curve are, and how it is drawn.
struct CurvePlan {
  std::vector<std::pair<std::string, std::string>> columns = {};  ///< (name, unit), behind step and time
  std::string title = {};
  std::string x = {};  ///< column on the abscissa; empty is time
  std::vector<std::string> y = {};
  std::string kind = {};  ///< "ledger" for an energy balance, "histogram" for classes
};

/// Where rows go. The first row of a curve opens its file, and what its plan says from then on is not heard.
class CurveSink {
 public:
  virtual ~CurveSink() = default;
  virtual void row(const std::string& curve, const CurvePlan& plan, std::span<const Real> values) = 0;
};

class Curve {
 public:
  /// `name` gives the name of the curve, and so of its file.
  Curve(Watcher* owner, const Param<std::string>& name, CurvePlan declared);
  Curve(const Curve&) = delete;
  Curve& operator=(const Curve&) = delete;

  /// What follows from the deck is added in Plugin::choose, and what is known only in the run before the first row.
  CurvePlan plan;

  const Param<std::string>& name() const { return name_; }
  /// A value for each of the columns, in SI.
  void row(std::span<const Real> values) const;
  void row(std::initializer_list<Real> values) const { row(std::span<const Real>(values.begin(), values.size())); }
  /// For the loop: where rows go from now on, nullptr for nowhere.
  void write_to(CurveSink* sink) { sink_ = sink; }

 private:
  const Param<std::string>& name_;
  CurveSink* sink_ = nullptr;
};

}  // namespace beadwork
