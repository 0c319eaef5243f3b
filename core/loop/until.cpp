#include "core/loop/until.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/text.hpp"
#include "core/base/units.hpp"
#include "core/deck/read.hpp"

namespace beadwork {

namespace {

Location further(const Location& at, std::size_t offset) {
  Location place = at;
  place.column += static_cast<int>(offset);
  place.offset += offset;
  return place;
}

bool compare(Real a, const std::string& how, Real b) {
  if (how == "<") return a < b;
  if (how == "<=") return a <= b;
  if (how == ">") return a > b;
  return a >= b;
}

template <class F>
Real largest(std::span<const Constraint> constraints, const std::string& set, const F& value) {
  Real largest = 0;
  for (const Constraint& c : constraints)
    if (c.driven && (set.empty() || c.set == set)) largest = std::max(largest, std::abs(value(c)));
  return largest;
}

}  // namespace

Real driven_displacement(std::span<const Constraint> constraints, const std::string& set, Real time) {
  return largest(constraints, set, [&](const Constraint& c) { return c.motion(time).displacement; });
}

Real driven_force(std::span<const Constraint> constraints, const std::string& set) {
  return largest(constraints, set, [](const Constraint& c) { return c.reaction; });
}

std::optional<Until> Until::compile(const std::string& text, const Location& at, const Scope& scope, Complaints& complaints) {
  Until until;
  until.text_ = text;
  const std::string separator = " or ";
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    const auto made = clause(text.substr(begin, end - begin), further(at, begin), scope, complaints);
    if (!made) return std::nullopt;
    if (!made->set.empty()) until.sets_.push_back(made->set);
    until.clauses_.push_back(*made);
    begin = end + separator.size();
  }
  return until;
}

std::optional<Until::Clause> Until::clause(const std::string& text, const Location& at, const Scope& scope,
                                           Complaints& complaints) {
  const std::vector<std::string> words = split_words(text);
  if (words.size() >= 3 && words[1] == "of") return watched(words, text, at, scope, complaints);
  const std::vector<Variable> variables{{"time", find_unit("s")->dimension},
                                        {"step", find_unit("1")->dimension},
                                        {"displacement", find_unit("m")->dimension}};
  const auto expression = Expression::compile(text, at, scope, variables, complaints);
  if (!expression) return std::nullopt;
  Clause clause{What::condition, std::string(trim(text)), 0, false, "", "", false, expression};
  if (expression->is_condition()) return clause;
  const std::vector<Real> anywhere(variables.size(), 0);
  clause.value = expression->evaluate(anywhere);
  for (std::size_t v = 0; v < variables.size(); ++v) {
    if (!(expression->dimension() == variables[v].dimension)) continue;
    clause.what = v == 0 ? What::time : v == 1 ? What::steps : What::displacement;
    if (clause.value >= 0) return clause;
    complaints.error(at, fmt::format("'until' must be >= 0, got \"{}\"", text));
    return std::nullopt;
  }
  complaints.error(at, fmt::format("'until' wants a time, a number of steps, a displacement or a condition, got \"{}\" which is {}",
                                   text, expression->dimension().name()));
  return std::nullopt;
}

// "force of SET < 2 percent of its maximum", "displacement of SET >= 1 mm"
std::optional<Until::Clause> Until::watched(const std::vector<std::string>& words, const std::string& text, const Location& at,
                                            const Scope& scope, Complaints& complaints) {
  Clause clause{What::watched, std::string(trim(text)), 0, words[0] == "force", words[2], "", false, std::nullopt};
  const std::vector<std::string> comparisons{"<", "<=", ">", ">="};
  if ((words[0] != "force" && words[0] != "displacement") || words.size() < 5 ||
      std::find(comparisons.begin(), comparisons.end(), words[3]) == comparisons.end()) {
    complaints.error(at, fmt::format("'until' wants \"force of SET < VALUE\" or \"displacement of SET > VALUE\", got \"{}\"", text));
    return std::nullopt;
  }
  clause.comparison = words[3];
  std::string value = text.substr(text.find(" " + words[3] + " ") + words[3].size() + 2);
  const std::string tail = "of its maximum";
  if (const std::size_t found = value.find(tail); found != std::string::npos) {
    clause.of_maximum = true;
    value.erase(found);
  }
  const auto quantity = Expression::compile(trim(value), at, scope, {}, complaints);
  if (!quantity) return std::nullopt;
  clause.value = quantity->evaluate();
  const std::string unit = clause.of_maximum ? "1" : clause.watches_force ? "N" : "m";
  if (quantity->dimension() == find_unit(unit)->dimension) return clause;
  complaints.error(at, fmt::format("'until' compares {} with {}, got \"{}\"", clause.of_maximum ? "a share" : words[0],
                                   wanted_by(unit), trim(value)));
  return std::nullopt;
}

std::size_t Until::memory() const { return clauses_.size(); }

bool Until::holds(const Clause& clause, const Moment& moment, std::span<const Constraint> constraints, Real& maximum) {
  const Real time = moment.time - moment.stage_start;
  const auto steps = static_cast<Real>(moment.step - moment.stage_step);
  switch (clause.what) {
    // Half a step of tolerance: the sum of many time steps ends a little beside a round number.
    case What::time: return time >= clause.value - 0.5 * moment.time_step;
    case What::steps: return steps >= clause.value;
    case What::displacement: {
      const Real now = driven_displacement(constraints, "", time);
      const Real next = driven_displacement(constraints, "", time + 0.5 * moment.time_step);
      return std::max(now, next) >= clause.value;
    }
    case What::watched: {
      const Real value = clause.watches_force ? driven_force(constraints, clause.set)
                                              : driven_displacement(constraints, clause.set, time);
      maximum = std::max(maximum, value);
      return compare(value, clause.comparison, clause.of_maximum ? clause.value * maximum : clause.value);
    }
    case What::condition: {
      const Real values[] = {time, steps, driven_displacement(constraints, "", time)};
      return clause.condition->evaluate(values) == 1;
    }
  }
  return false;
}

bool Until::reached(const Moment& moment, std::span<const Constraint> constraints, std::span<Real> maxima) const {
  bool any = false;
  for (std::size_t c = 0; c < clauses_.size(); ++c)
    if (holds(clauses_[c], moment, constraints, maxima[c]) && !any) {
      any = true;
      met_ = clauses_[c].text;
    }
  return any;
}

std::optional<Real> Until::time() const {
  for (const Clause& c : clauses_)
    if (c.what == What::time) return c.value;
  return std::nullopt;
}

std::optional<std::int64_t> Until::steps() const {
  for (const Clause& c : clauses_)
    if (c.what == What::steps) return static_cast<std::int64_t>(c.value);
  return std::nullopt;
}

std::optional<Real> Until::displacement() const {
  for (const Clause& c : clauses_)
    if (c.what == What::displacement || (c.what == What::watched && !c.watches_force && c.comparison[0] == '>')) return c.value;
  return std::nullopt;
}

}  // namespace beadwork
