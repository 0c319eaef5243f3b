#include "workbench/batch_claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"
#include "core/base/utf8.hpp"
#include "core/io/file.hpp"
#include "workbench/terminal.hpp"

namespace beadwork {

namespace {

using Values = std::vector<std::pair<std::string, std::string>>;

const std::string* value_in(const Values& values, const std::string& name) {
  const auto found = std::find_if(values.begin(), values.end(), [&](const auto& each) { return each.first == name; });
  return found == values.end() ? nullptr : &found->second;
}

std::string sweep_of(const BatchRun& run) {
  const std::size_t slash = run.name.find('/');
  return slash == std::string::npos ? "" : run.name.substr(0, slash);
}

bool is_chosen(const ChosenRuns& chosen, const BatchRun& run) {
  if (sweep_of(run) != chosen.sweep) return false;
  return std::all_of(chosen.where.begin(), chosen.where.end(), [&](const ChosenRuns::Wanted& wanted) {
    const std::string* value = value_in(run.values, wanted.parameter);
    return value && std::find(wanted.values.begin(), wanted.values.end(), *value) != wanted.values.end();
  });
}

void refuse_none(const ChosenRuns& chosen, const std::vector<BatchRun>& runs) {
  std::vector<std::string> sweeps;
  for (const BatchRun& run : runs) sweeps.push_back(sweep_of(run));
  if (std::find(sweeps.begin(), sweeps.end(), chosen.sweep) == sweeps.end())
    refuse(chosen.at, fmt::format("there is no sweep '{}'{}", chosen.sweep, did_you_mean(chosen.sweep, sweeps)));
  for (const ChosenRuns::Wanted& wanted : chosen.where)
    for (const std::string& value : wanted.values)
      if (runs_chosen({chosen.sweep, {{wanted.parameter, {value}}}, chosen.at}, runs).empty())
        refuse(chosen.at, fmt::format("no run of '{}' has {} = {}", chosen.sweep, wanted.parameter, value));
  if (runs_chosen(chosen, runs).empty())
    refuse(chosen.at, fmt::format("no run of '{}' has all these values at once", chosen.sweep));
}

// ---- Numbers

CurveTable curve_of(const BatchRun& run, const std::string& name) {
  constexpr std::uintmax_t longest = std::uintmax_t{1} << 31;
  try {
    return parse_table(read_text(run.folder / "curves" / (name + ".csv"), longest));
  } catch (const MachineFailure&) {  // there is no such curve
    return {};
  }
}

std::optional<Quantity> divided(const std::optional<Quantity>& a, const std::optional<Quantity>& b) {
  if (!a || !b || b->value == 0) return std::nullopt;
  return Quantity{a->value / b->value, a->dimension / b->dimension};
}

/// From the table of the batch: "energy: stored" is in its column "energy: stored [J]".
std::optional<Quantity> number_in_column(const BatchRun& run, const std::string& column) {
  for (const auto& [name, value] : run.results) {
    const std::size_t open = name.rfind(" [");
    if (name != column && (open == std::string::npos || name.substr(0, open) != column)) continue;
    const auto unit = open == std::string::npos ? Unit{} : find_unit(name.substr(open + 2, name.size() - open - 3));
    const auto number = parse_number(value);
    if (number && unit) return Quantity{unit->to_si(*number), unit->dimension};
  }
  return std::nullopt;
}

std::optional<Quantity> number_of(const ClaimPlan& claim, const BatchRun& run) {
  if (claim.curve.empty()) return number_in_column(run, claim.column);
  const CurveTable curve = curve_of(run, claim.curve);
  const auto number = read_from(curve, claim.reading);
  return claim.over ? divided(number, read_from(curve, *claim.over)) : number;
}

bool have_the_same_seeds(const BatchRun& one, const BatchRun& other) {
  return std::all_of(one.values.begin(), one.values.end(), [&](const auto& each) {
    if (!is_seed(each.first)) return true;
    const std::string* its = value_in(other.values, each.first);
    return its && *its == each.second;
  });
}

/// Of one run, with all that it is divided by and multiplied with.
std::optional<Quantity> claimed_number(const ClaimPlan& claim, const BatchRun& run, const std::vector<BatchRun>& runs) {
  auto number = number_of(claim, run);
  if (number && claim.beside) {
    std::optional<Quantity> other;
    for (const std::size_t k : runs_chosen(*claim.beside, runs))
      if (runs[k].done && have_the_same_seeds(run, runs[k])) other = number_of(claim, runs[k]);
    number = divided(number, other);
  }
  if (number && claim.times) {
    const Quantity factor = claim.times->quantity();
    number = Quantity{number->value * factor.value, number->dimension * factor.dimension};
  }
  return number;
}

// ---- What came of it

struct Found {
  std::vector<double> values;  ///< in SI
  Dimension dimension;
  bool is_mixed = false;  ///< of several kinds: the claim's columns differ from run to run

  double mean() const {
    double sum = 0;
    for (const double x : values) sum += x;
    return sum / static_cast<double>(values.size());
  }
  double scatter() const {
    double square = 0;
    for (const double x : values) square += (x - mean()) * (x - mean());
    return std::sqrt(square / static_cast<double>(values.size() - 1));
  }
};

Found found_by(const ClaimPlan& claim, const std::vector<BatchRun>& runs) {
  Found found;
  for (const std::size_t k : runs_chosen(claim.of, runs)) {
    const auto number = runs[k].done ? claimed_number(claim, runs[k], runs) : std::nullopt;
    if (!number) continue;
    found.is_mixed = found.is_mixed || (!found.values.empty() && !(found.dimension == number->dimension));
    found.values.push_back(number->value);
    found.dimension = number->dimension;
  }
  return found;
}

bool is_of(const Amount& bound, const Dimension& dimension) { return bound.unit.dimension == dimension; }

std::string verdict_on(const ClaimPlan& claim, const Found& found, bool any_done) {
  if (found.values.empty()) return any_done ? "not met" : "not run";  // what is asked for never happened
  if (found.is_mixed) return "several kinds of quantity";
  if (!claim.from && !claim.to) return "no band";
  for (const auto& bound : {claim.from, claim.to})
    if (bound && !is_of(*bound, found.dimension)) return fmt::format("the band is not in {}", found.dimension.name());
  const bool holds = (!claim.from || found.mean() >= claim.from->quantity().value) &&
                     (!claim.to || found.mean() <= claim.to->quantity().value);
  return holds ? "in" : "out";
}

/// In the unit of the band, with four digits.
std::string shown(double si, const Dimension& dimension, const ClaimPlan& claim) {
  for (const auto& bound : {claim.from, claim.to, parse_amount(claim.printed)})
    if (bound && is_of(*bound, dimension))
      return Amount{*parse_number(fmt::format("{:.4g}", bound->unit.from_si(si))), bound->unit_name, bound->unit}
          .text();
  return format_quantity(Quantity{*parse_number(fmt::format("{:.4g}", si)), dimension});
}

std::string what_is_read(const ClaimPlan& claim) {
  if (claim.curve.empty()) return claim.column;
  std::string text = claim.curve + ": " + claim.reading.text;
  if (claim.over) text += ", over " + claim.over->text;
  if (claim.times) text += ", times " + claim.times->text();
  return text;
}

nlohmann::ordered_json json_of(const FigurePlan& figure, const std::vector<BatchRun>& runs) {
  nlohmann::ordered_json json{{"name", safe_text(figure.name)}, {"says", safe_text(figure.says)}};
  if (!figure.curve.empty()) json["curve"] = safe_text(figure.curve);
  json["runs"] = nlohmann::ordered_json::array();
  for (const std::size_t k : runs_chosen(figure.of, runs)) json["runs"].push_back(safe_text(runs[k].name));
  return json;
}

}  // namespace

std::vector<std::size_t> runs_chosen(const ChosenRuns& chosen, const std::vector<BatchRun>& runs) {
  std::vector<std::size_t> places;
  for (std::size_t k = 0; k < runs.size(); ++k)
    if (is_chosen(chosen, runs[k])) places.push_back(k);
  return places;
}

void refuse_claims_of_none(const BatchPlan& plan, const std::vector<BatchRun>& runs) {
  for (const ClaimPlan& claim : plan.claims) {
    refuse_none(claim.of, runs);
    if (claim.beside) refuse_none(*claim.beside, runs);
  }
  for (const FigurePlan& figure : plan.figures) refuse_none(figure.of, runs);
}

ResultTable claims_table(const std::vector<ClaimPlan>& claims, const std::vector<BatchRun>& runs) {
  ResultTable table{{"claim", "says", "source", "printed", "from", "to", "mean", "scatter", "runs", "verdict", "read"},
                    {}};
  for (const ClaimPlan& claim : claims) {
    const auto chosen = runs_chosen(claim.of, runs);
    const bool any_done = std::any_of(chosen.begin(), chosen.end(), [&](std::size_t k) { return runs[k].done; });
    const Found found = found_by(claim, runs);
    const auto amount = [&](double si) { return shown(si, found.dimension, claim); };
    const std::size_t count = found.is_mixed ? 0 : found.values.size();
    table.rows.push_back({claim.name, claim.says, claim.source, claim.printed, claim.from ? claim.from->text() : "",
                          claim.to ? claim.to->text() : "", count > 0 ? amount(found.mean()) : "",
                          count > 1 ? amount(found.scatter()) : "", std::to_string(found.values.size()),
                          verdict_on(claim, found, any_done), what_is_read(claim)});
  }
  return table;
}

void write_claims(const BatchPlan& plan, const std::vector<BatchRun>& runs, OwnFolder& folder) {
  if (!plan.figures.empty()) {
    nlohmann::ordered_json figures = nlohmann::ordered_json::array();
    for (const FigurePlan& figure : plan.figures) figures.push_back(json_of(figure, runs));
    write_atomically(folder.claim("figures.json"), nlohmann::ordered_json{{"figures", figures}}.dump(1) + "\n");
  }
  if (plan.claims.empty()) return;
  const ResultTable table = claims_table(plan.claims, runs);
  write_atomically(folder.claim("claims.csv"), csv_of(table));
  std::map<std::string, int> verdicts;
  for (const auto& row : table.rows) ++verdicts[row[table.head.size() - 2]];
  say("claims: {} in their bands, {} out of them, {} others\n", verdicts["in"], verdicts["out"],
      static_cast<int>(table.rows.size()) - verdicts["in"] - verdicts["out"]);
}

}  // namespace beadwork
