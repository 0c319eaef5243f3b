#include "workbench/trade/tried.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/text.hpp"
#include "workbench/report/results.hpp"

namespace beadwork::trade {

namespace {

Real mean_of(const std::vector<Real>& numbers) {
  Real sum = 0;
  for (const Real x : numbers) sum += x;
  return sum / static_cast<Real>(numbers.size());
}

}  // namespace

Quantities usual_quantities(const Outcome& outcome) {
  Quantities names;
  for (const auto& [name, value] : results_of(outcome.folder))
    if (name.find(": largest ") != std::string::npos || name.starts_with("result: parameters: ")) names.push_back(name);
  return names;
}

Tried tried(const std::string& name, const std::vector<Override>& values, const Outcome& outcome,
            const Quantities& quantities) {
  Tried one;
  one.name = name;
  one.values = values;
  one.done = outcome.is_done();
  one.refused = outcome.code == ExitCode::deck;
  if (!one.done) one.reason = outcome.reason;
  one.seconds = outcome.number("loop_seconds");
  const Results results = results_of(outcome.folder);
  for (const auto& [known, value] : results) {
    const auto number = parse_number(value);
    if (number) one.numbers.push_back(known);
    if (number && known.find(": final ") != std::string::npos) one.ends.push_back(*number);
  }
  if (one.ends.empty()) one.ends = {outcome.number("time")};
  for (const std::string& quantity : quantities) {
    const auto found =
        std::find_if(results.begin(), results.end(), [&](const auto& result) { return result.first == quantity; });
    const auto value = found == results.end() ? std::nullopt : parse_number(found->second);
    one.quantities.push_back(value.value_or(NAN));
  }
  return one;
}

Real error_of(const Tried& one, const Tried& reference) {
  Real worst = 0;
  for (std::size_t k = 0; k < reference.quantities.size(); ++k) {
    const Real error = std::abs(one.quantities[k] / reference.quantities[k] - 1);
    if (!one.done || !(error >= 0)) return std::numeric_limits<Real>::infinity();
    worst = std::max(worst, error);
  }
  return worst;
}

bool ends_elsewhere(const Tried& one, const Tried& reference) {
  constexpr Real little = 0.02;
  for (std::size_t k = 0; k < std::min(one.ends.size(), reference.ends.size()); ++k)
    if (std::abs(one.ends[k] - reference.ends[k]) > little * std::abs(reference.ends[k])) return true;
  return false;
}

Real scatter_of(const std::vector<Tried>& seeds) {
  Real worst = 0;
  std::vector<const Tried*> done;
  for (const Tried& each : seeds)
    if (each.done && std::none_of(each.quantities.begin(), each.quantities.end(), [](Real x) { return std::isnan(x); }))
      done.push_back(&each);
  if (done.size() < 2) return 0;
  for (std::size_t k = 0; k < done.front()->quantities.size(); ++k) {
    std::vector<Real> numbers;
    for (const Tried* each : done) numbers.push_back(each->quantities[k]);
    const Real mean = mean_of(numbers);
    for (Real& x : numbers) x = (x - mean) * (x - mean);
    const Real variance = mean_of(numbers) * static_cast<Real>(numbers.size()) / static_cast<Real>(numbers.size() - 1);
    worst = std::max(worst, std::sqrt(variance) / std::abs(mean));
  }
  return worst;
}

std::vector<const Tried*> front_of(const std::vector<Tried>& all) {
  std::vector<const Tried*> front;
  for (const Tried& one : all) {
    if (!std::isfinite(one.error)) continue;
    const bool beaten = std::any_of(all.begin(), all.end(), [&](const Tried& other) {
      return other.seconds <= one.seconds && other.error <= one.error &&
             (other.seconds < one.seconds || other.error < one.error);
    });
    if (!beaten) front.push_back(&one);
  }
  std::sort(front.begin(), front.end(), [](const Tried* a, const Tried* b) { return a->seconds < b->seconds; });
  return front;
}

const Tried* fastest_within(const std::vector<Tried>& all, Real error) {
  const Tried* best = nullptr;
  for (const Tried& one : all)
    if (one.error <= error && (!best || one.seconds < best->seconds)) best = &one;
  return best;
}

ResultTable table_of(const std::vector<Tried>& all, const Quantities& quantities, const Tried& base) {
  ResultTable table{{"setting", "time in the loop [s]", "times as fast", "error [percent]", "on the front"}, {}};
  table.head.insert(table.head.end(), quantities.begin(), quantities.end());
  table.head.emplace_back("exit_reason");
  const auto front = front_of(all);
  for (const Tried& one : all) {
    const bool is_best = std::find(front.begin(), front.end(), &one) != front.end();
    std::vector<std::string> row{
        one.name, fmt::format("{:.4g}", one.seconds), one.done ? fmt::format("{:.3g}", base.seconds / one.seconds) : "",
        std::isfinite(one.error) ? fmt::format("{:.4g}", 100 * one.error) : "", is_best ? "yes" : ""};
    for (const Real x : one.quantities) row.push_back(std::isnan(x) ? "" : format_number(x));
    row.push_back(one.reason);
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace beadwork::trade
