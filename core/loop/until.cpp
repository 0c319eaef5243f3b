#include "core/loop/until.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/text.hpp"
#include "core/base/units.hpp"
#include "core/deck/read.hpp"

namespace beadwork {

namespace {

const std::vector<std::string> comparisons{"<", "<=", ">", ">="};

bool is_comparison(const std::string& word) {
  return std::find(comparisons.begin(), comparisons.end(), word) != comparisons.end();
}

bool compare(Real a, const std::string& how, Real b) {
  if (how == "<") return a < b;
  if (how == "<=") return a <= b;
  if (how == ">") return a > b;
  return a >= b;
}

}  // namespace

namespace {

/// Where " or " stands outside of brackets, and the end.
std::vector<std::size_t> ends_of_clauses(std::string_view text, std::string_view separator) {
  std::vector<std::size_t> ends;
  int open = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '(') ++open;
    if (text[i] == ')') --open;
    if (open == 0 && text.substr(i).starts_with(separator)) ends.push_back(i);
  }
  ends.push_back(text.size());
  return ends;
}

}  // namespace

std::optional<Until> Until::compile(const std::string& text, const Location& at, const Scope& scope,
                                    Complaints& complaints) {
  Until until;
  until.text_ = text;
  const std::string separator = " or ";
  constexpr std::size_t most = 100;
  std::size_t begin = 0;
  for (const std::size_t end : ends_of_clauses(text, separator)) {
    if (end < begin) continue;  // "1 or or 2"
    if (until.clauses_.size() == most) {
      complaints.error(at, fmt::format("'until' joins more than {} conditions by 'or'", most));
      return std::nullopt;
    }
    const auto made = clause(text.substr(begin, end - begin), locate(at, begin), scope, complaints);
    if (!made) return std::nullopt;
    until.clauses_.push_back(*made);
    begin = end + separator.size();
  }
  return until;
}

std::optional<Until::Clause> Until::clause(const std::string& text, const Location& at, const Scope& scope,
                                           Complaints& complaints) {
  const std::vector<std::string> words = split_words(text);
  if (words.size() >= 3 && words[1] == "of") return watched(words, text, at, scope, complaints);
  if (words.size() >= 2 && words[0] == "sensor" && !is_comparison(words[1]))
    return sensed(words, text, at, scope, complaints);
  const auto expression = Expression::compile(text, at, scope, Mark::variables(), complaints);
  if (!expression) return std::nullopt;
  Clause clause{What::condition, std::string(trim(text)), at, 0, {}, false, "", "", false, expression, {}};
  if (expression->is_condition()) return clause;
  const auto mark =
      Mark::of(*expression, "until", "a time, a number of steps, a displacement or a condition", text, at, complaints);
  if (!mark) return std::nullopt;
  clause.what = What::mark;
  clause.mark = *mark;
  return clause;
}

// "force of SET < 2 percent of its maximum", "displacement of SET >= 1 mm"
std::optional<Until::Clause> Until::watched(const std::vector<std::string>& words, const std::string& text,
                                            const Location& at, const Scope& scope, Complaints& complaints) {
  Clause clause{
      What::watched, std::string(trim(text)), at, 0, {}, words[0] == "force", words[2], "", false, std::nullopt, {}};
  if ((words[0] != "force" && words[0] != "displacement") || words.size() < 5 || !is_comparison(words[3])) {
    complaints.error(
        at, fmt::format("'until' wants \"force of SET < VALUE\" or \"displacement of SET > VALUE\", got \"{}\"", text));
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
  if (quantity->has_dimension(find_unit(unit)->dimension)) return clause;
  complaints.error(at, fmt::format("'until' compares {} with {}, got \"{}\"", clause.of_maximum ? "a share" : words[0],
                                   wanted_by(unit), trim(value)));
  return std::nullopt;
}

// "sensor NAME > 3 MPa"
std::optional<Until::Clause> Until::sensed(const std::vector<std::string>& words, const std::string& text,
                                           const Location& at, const Scope& scope, Complaints& complaints) {
  if (words.size() < 4 || !is_comparison(words[2])) {
    complaints.error(at, fmt::format("'until' wants \"sensor NAME > VALUE\", got \"{}\"", trim(text)));
    return std::nullopt;
  }
  const std::size_t name = text.find(words[1], text.find(words[0]) + words[0].size());
  const std::size_t sign = text.find(words[2], name + words[1].size());
  const std::size_t value = text.find_first_not_of(blanks, sign + words[2].size());
  const auto quantity = Expression::compile(trim(text.substr(value)), locate(at, value), scope, {}, complaints);
  if (!quantity) return std::nullopt;
  Clause clause{
      What::sensor, std::string(trim(text)), at, quantity->evaluate(), {}, false, "", words[2], false, quantity, {}};
  clause.awaited = {words[1],
                    locate(at, name),
                    quantity->dimension(),
                    std::string(trim(text.substr(value))),
                    locate(at, value),
                    quantity->dimension().is_plain() && clause.value == 0};
  return clause;
}

std::string Until::Clause::words() const { return what == What::mark ? mark.words() : text; }

std::string Until::Clause::si() const {
  if (what == What::mark) return mark.si();
  if (what == What::condition) return condition->text();
  if (what == What::sensor)
    return fmt::format("sensor {} {} {}", awaited.name, comparison,
                       format_quantity(Quantity{value, awaited.dimension}));
  const std::string limit =
      of_maximum ? format_number(value) + " of its maximum" : format_quantity(value, watches_force ? "N" : "m");
  return fmt::format("{} of {} {} {}", watches_force ? "force" : "displacement", set, comparison, limit);
}

namespace {

// Sizes of the variable, from tiny to huge, of this sign, between these limits: whether one of them meets the
// condition.
bool is_met(const Expression& condition, std::size_t variable, Real sign, Real from, Real to) {
  std::vector<Real> values(Mark::variables().size(), 0);
  const auto meets = [&](Real size) {
    values[variable] = sign * size;
    return size >= from && size <= to && condition.evaluate(values) == 1;
  };
  constexpr int parts = 4096;
  for (int k = 0; std::isfinite(to) && k <= parts; ++k)
    if (meets(from + (to - from) * k / parts)) return true;
  bool any = meets(0);
  for (Real size = 1e-30; size < 1e30 && !any; size *= 1.01) any = meets(size);
  return any;
}

// A condition on this variable alone that is met only where the variable never gets. One that is met nowhere that we
// look is let be.
bool is_out_of_reach(const Expression& condition, std::size_t variable, Real reach) {
  for (std::size_t v = 0; v < Mark::variables().size(); ++v)
    if (condition.uses(v) != (v == variable)) return false;
  if (is_met(condition, variable, 1, 0, reach)) return false;
  return is_met(condition, variable, -1, 0, std::numeric_limits<Real>::infinity()) ||
         is_met(condition, variable, 1, std::nextafter(reach, std::numeric_limits<Real>::infinity()),
                std::numeric_limits<Real>::infinity());
}

std::string why_out_of_reach(const Expression& condition, Real reach) {
  for (const Mark::What never_negative : {Mark::What::time, Mark::What::steps, Mark::What::displacement}) {
    const auto variable = static_cast<std::size_t>(never_negative);
    const Real limit = never_negative == Mark::What::displacement ? reach : std::numeric_limits<Real>::infinity();
    if (!is_out_of_reach(condition, variable, limit)) continue;
    return std::isfinite(limit)
               ? fmt::format("waits for a displacement that meets it, but what is pulled moves {} at most",
                             format_quantity(limit, "m"))
               : fmt::format("can never be met: the {} is never negative", Mark::variables()[variable].name);
  }
  return "";
}

}  // namespace

// Forces and displacements are magnitudes; what is to fall below a value must have been above it.
std::string Until::Clause::why_never(std::span<const Constraint> constraints) const {
  if (what == What::mark) return mark.why_never(constraints);
  const bool falls = comparison.starts_with('<');
  const auto reach = reach_of(constraints, what == What::watched ? set : "");
  if (what == What::condition) {
    const auto displacement = static_cast<std::size_t>(Mark::What::displacement);
    if (condition->uses(displacement) && !reach) return "waits for a displacement, but nothing in <load> is pulled";
    for (const Expression& part : condition->parts())
      if (const std::string why = why_out_of_reach(part, reach.value_or(0)); !why.empty()) return why;
    for (std::size_t v = 0; v < Mark::variables().size(); ++v)
      if (condition->uses(v)) return "";
    return fmt::format("wants a condition on time, step or displacement, \"{}\" never changes", text);
  }
  if (!reach) return fmt::format("watches set '{}', which nothing in <load> drives", set);
  if (falls && (value < 0 || (value == 0 && comparison == "<")))
    return fmt::format("can never be met: a {} is never negative", watches_force ? "force" : "displacement");
  if (!falls && of_maximum && (value > 1 || (value == 1 && comparison == ">")))
    return "can never be met: nothing is above its maximum";
  if (of_maximum || watches_force || *reach > value || (comparison == ">=" && *reach == value)) return "";
  return fmt::format("waits for a displacement {} {}, but set '{}' moves {} at most", comparison,
                     format_quantity(value, "m"), set, format_quantity(*reach, "m"));
}

std::string Until::si() const {
  std::vector<std::string> all;
  for (const Clause& clause : clauses_) all.push_back(clause.si());
  return join(all, " or ");
}

std::vector<Until::Prospect> Until::prospects(
    std::span<const Constraint> constraints,
    const std::function<std::string(const std::string& name)>& why_untold) const {
  std::vector<Prospect> all;
  for (const Clause& clause : clauses_)
    if (clause.what == What::sensor)
      all.push_back({clause.awaited.at, why_untold(clause.awaited.name)});
    else
      all.push_back({clause.at, clause.why_never(constraints)});
  return all;
}

std::vector<Peak> peaks_of(std::span<const Constraint> constraints) {
  std::vector<Peak> peaks;
  for (const Constraint& c : constraints)
    if (c.pulls() && std::none_of(peaks.begin(), peaks.end(), [&](const Peak& p) { return p.set == c.set; }))
      peaks.push_back({c.set, {}, {}});
  return peaks;
}

void raise(std::vector<Peak>& peaks, const Moment& moment, std::span<const Constraint> constraints) {
  for (Peak& peak : peaks) {
    peak.force = std::max<Real>(peak.force, driven_force(constraints, peak.set));
    peak.displacement =
        std::max<Real>(peak.displacement, driven_displacement(constraints, peak.set, moment.stage_start, moment.time));
  }
}

bool Until::holds(const Clause& clause, const Moment& moment, std::span<const Constraint> constraints,
                  std::span<const Peak> peaks, const Told& told) {
  const Real time = moment.time - moment.stage_start;
  const auto steps = static_cast<Real>(moment.step - moment.stage_step);
  switch (clause.what) {
    case What::mark: return clause.mark.reached(moment, constraints);
    case What::watched: {
      const auto peak = std::find_if(peaks.begin(), peaks.end(), [&](const Peak& p) { return p.set == clause.set; });
      if (peak == peaks.end()) return false;
      const Real largest = clause.watches_force ? peak->force : peak->displacement;
      const Real limit = clause.of_maximum ? clause.value * largest : clause.value;
      if (clause.comparison[0] == '<' && !(largest > limit)) return false;
      const Real value = clause.watches_force
                             ? driven_force(constraints, clause.set)
                             : driven_displacement(constraints, clause.set, moment.stage_start, moment.time);
      return compare(value, clause.comparison, limit);
    }
    case What::sensor: {
      const std::optional<Real> value = told(clause.awaited.name);
      return value && compare(*value, clause.comparison, clause.value);
    }
    case What::condition: {
      const Real values[] = {time, steps, driven_displacement(constraints, "", moment.stage_start, moment.time)};
      return clause.condition->evaluate(values) == 1;
    }
  }
  return false;
}

bool Until::reached(const Moment& moment, std::span<const Constraint> constraints, std::span<const Peak> peaks,
                    const Told& told) const {
  for (const Clause& clause : clauses_) {
    if (!holds(clause, moment, constraints, peaks, told)) continue;
    met_ = clause.words();
    return true;
  }
  return false;
}

std::vector<Until::Awaited> Until::awaited() const {
  std::vector<Awaited> all;
  for (const Clause& clause : clauses_)
    if (clause.what == What::sensor) all.push_back(clause.awaited);
  return all;
}

bool Until::is_foreseeable() const {
  return std::all_of(clauses_.begin(), clauses_.end(), [](const Clause& c) { return c.what == What::mark; });
}

std::optional<Real> Until::first(Mark::What what) const {
  for (const Clause& c : clauses_)
    if (c.what == What::mark && c.mark.what == what) return c.mark.value;
  return std::nullopt;
}

std::optional<Real> Until::time() const { return first(Mark::What::time); }

std::optional<std::int64_t> Until::steps() const {
  const auto steps = first(Mark::What::steps);
  if (!steps) return std::nullopt;
  return static_cast<std::int64_t>(*steps);
}

std::optional<Real> Until::displacement() const {
  for (const Clause& c : clauses_) {
    if (c.what == What::mark && c.mark.what == Mark::What::displacement) return c.mark.value;
    if (c.what == What::watched && !c.watches_force && c.comparison[0] == '>') return c.value;
  }
  return std::nullopt;
}

}  // namespace beadwork
