#include "core/loop/mark.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/text.hpp"
#include "core/base/units.hpp"

namespace beadwork {

namespace {

template <class F>
Real largest(std::span<const Constraint> constraints, const std::string& set, const F& value) {
  Real largest = 0;
  for (const Constraint& c : constraints)
    if (c.pulls() && (set.empty() || c.set == set)) largest = std::max(largest, std::abs(value(c)));
  return largest;
}

}  // namespace

Real driven_displacement(std::span<const Constraint> constraints, const std::string& set, Real from, Real to) {
  return largest(constraints, set,
                 [&](const Constraint& c) { return c.at(to).displacement - c.at(from).displacement; });
}

Real driven_force(std::span<const Constraint> constraints, const std::string& set) {
  return largest(constraints, set, [](const Constraint& c) -> Real { return c.reaction; });
}

std::optional<Real> reach_of(std::span<const Constraint> constraints, const std::string& set) {
  std::optional<Real> reach;
  for (const Constraint& c : constraints)
    if (c.pulls() && (set.empty() || c.set == set)) reach = std::max(reach.value_or(0), c.reach);
  return reach;
}

const std::vector<Variable>& Mark::variables() {
  static const std::vector<Variable> three{{"time", find_unit("s")->dimension},
                                           {"step", find_unit("1")->dimension},
                                           {"displacement", find_unit("m")->dimension}};
  return three;
}

std::optional<Mark> Mark::of(const Expression& quantity, const std::string& attribute, const std::string& wanted,
                             const std::string& text, const Location& at, Complaints& complaints) {
  const std::vector<Real> anywhere(variables().size(), 0);
  const Real value = quantity.evaluate(anywhere);
  for (std::size_t v = 0; v < variables().size(); ++v) {
    if (!(quantity.dimension() == variables()[v].dimension)) continue;
    const auto words = split_words(text);
    const bool has_unit = words.size() == 2 && parse_number(words[0]) && find_unit(words[1]);
    if (static_cast<What>(v) == What::steps && (value != std::floor(value) || has_unit)) {
      complaints.error(
          at, fmt::format("'{}' wants a whole number of steps, or a time or displacement with its unit, got \"{}\"{}",
                          attribute, text, has_unit ? "; turns are not waited for: give the time that they take" : ""));
      return std::nullopt;
    }
    if (value >= 0) return Mark{static_cast<What>(v), value, text, at};
    complaints.error(at, fmt::format("'{}' must be >= 0, got \"{}\"", attribute, text));
    return std::nullopt;
  }
  complaints.error(
      at, fmt::format("'{}' wants {}, got \"{}\" which is {}", attribute, wanted, text, quantity.dimension().name()));
  return std::nullopt;
}

std::vector<Mark> Mark::list(const std::string& text, const std::string& attribute, const Location& at,
                             const Scope& scope, Complaints& complaints) {
  constexpr std::size_t most = 10'000;
  std::vector<Mark> marks;
  const std::vector<std::string> pieces = split(text, ',');
  if (pieces.size() > most) {
    complaints.error(at, fmt::format("'{}' has more than {} moments", attribute, most));
    return marks;
  }
  Location next = at;
  for (const std::string& piece : pieces) {
    const std::string word(trim(piece));
    const Location place = locate(next, word.empty() ? 0 : piece.find(word));
    next = locate(next, piece.size() + 1);
    if (word.empty()) {
      complaints.error(place, fmt::format("'{}' wants moments such as \"0.3 mm, 1 ms\", got \"{}\"", attribute, text));
      continue;
    }
    if (word == "end") continue;  // every watcher looks at the end
    const auto quantity = Expression::compile(word, place, scope, {}, complaints);
    if (!quantity) continue;
    if (const auto mark =
            of(*quantity, attribute, "a time, a number of steps or a displacement", word, place, complaints))
      marks.push_back(*mark);
  }
  return marks;
}

std::string Mark::si() const {
  static constexpr const char* units[] = {"s", "1", "m"};
  return format_quantity(value, units[static_cast<int>(what)]);
}

std::string Mark::words() const {
  const std::vector<std::string> parts = split_words(text);
  const bool is_plain =
      parts.size() <= 2 && parse_number(parts.front()) && find_unit(parts.size() == 1 ? "1" : parts.back());
  const std::string amount = is_plain ? text : fmt::format("{} = {}", text, si());
  if (what == What::steps) return amount + (value == 1 ? " step" : " steps");
  return amount + (what == What::time ? " of time" : " of displacement");
}

std::string Mark::why_never(std::span<const Constraint> constraints) const {
  if (what != What::displacement || value == 0) return "";
  const auto reach = reach_of(constraints, "");
  if (!reach) return "waits for a displacement, but nothing in <load> is pulled";
  constexpr Real rounding = 1e-9;
  if (*reach >= (1 - rounding) * value) return "";
  return fmt::format("waits for a displacement of {}, but what is pulled moves {} at most", text,
                     format_quantity(*reach, "m"));
}

std::optional<Real> Mark::time(const Moment& moment, std::span<const Constraint> constraints, Real until) const {
  if (what == What::steps) return std::nullopt;
  if (what == What::time) {
    const Real time = moment.stage_start + value;
    return time > moment.time && time <= until ? std::optional(time) : std::nullopt;
  }
  const auto has_come = [&](Real time) {
    return driven_displacement(constraints, "", moment.stage_start, time) >= value;
  };
  if (has_come(moment.time) || !has_come(until)) return std::nullopt;
  Real before = moment.time, after = until;
  for (Real middle = 0.5 * (before + after); middle > before && middle < after; middle = 0.5 * (before + after))
    (has_come(middle) ? after : before) = middle;
  return after;
}

bool Mark::reached(const Moment& moment, std::span<const Constraint> constraints) const {
  const Real time = moment.time - moment.stage_start;
  switch (what) {
    // Half a step of tolerance: the sum of many time steps ends a little beside a round number.
    case What::time: return time >= value - 0.5 * moment.time_step;
    case What::steps: return static_cast<Real>(moment.step - moment.stage_step) >= value;
    case What::displacement: {
      const auto gone = [&](Real until) { return driven_displacement(constraints, "", moment.stage_start, until); };
      return std::max(gone(moment.time), gone(moment.time + 0.5 * moment.time_step)) >= value;
    }
  }
  return false;
}

}  // namespace beadwork
