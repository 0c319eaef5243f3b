#include "workbench/batch_claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

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

bool is_chosen(const ChosenRuns& chosen, const BatchRun& run) {
  if (run.sweep != chosen.sweep) return false;
  return std::all_of(chosen.where.begin(), chosen.where.end(), [&](const ChosenRuns::Wanted& wanted) {
    const std::string* value = value_in(run.values, wanted.parameter);
    return value && std::find(wanted.values.begin(), wanted.values.end(), *value) != wanted.values.end();
  });
}

void refuse_none(const ChosenRuns& chosen, const std::vector<BatchRun>& runs) {
  std::vector<std::string> sweeps;
  for (const BatchRun& run : runs) sweeps.push_back(run.sweep);
  if (std::find(sweeps.begin(), sweeps.end(), chosen.sweep) == sweeps.end())
    refuse(chosen.at, fmt::format("there is no sweep '{}'{}", chosen.sweep, did_you_mean(chosen.sweep, sweeps)));
  for (const ChosenRuns::Wanted& wanted : chosen.where)
    for (const std::string& value : wanted.values)
      if (runs_chosen({chosen.sweep, {{wanted.parameter, {value}}}, chosen.at}, runs).empty())
        refuse(chosen.at, fmt::format("no run of '{}' has {} = {}", chosen.sweep, wanted.parameter, value));
  if (runs_chosen(chosen, runs).empty())
    refuse(chosen.at, fmt::format("no run of '{}' has all these values at once", chosen.sweep));
}

bool have_the_same_seeds(const BatchRun& one, const BatchRun& other) {
  const auto seeds_of = [](const BatchRun& run) {
    Values seeds;
    for (const auto& each : run.values)
      if (is_seed(each.first)) seeds.push_back(each);
    return seeds;
  };
  return seeds_of(one) == seeds_of(other);
}

std::vector<std::size_t> partners_of(const ClaimPlan& claim, const BatchRun& run, const std::vector<BatchRun>& runs) {
  std::vector<std::size_t> partners = runs_chosen(*claim.beside, runs);
  std::erase_if(partners, [&](std::size_t k) { return !have_the_same_seeds(run, runs[k]); });
  return partners;
}

/// A mean over anything but seeds would be one of different things.
void refuse_mixed(const ClaimPlan& claim, const std::vector<BatchRun>& runs) {
  const auto chosen = runs_chosen(claim.of, runs);
  const BatchRun& first = runs[chosen.front()];
  for (const std::size_t k : chosen)
    for (const auto& [name, value] : runs[k].values)
      if (const std::string* its = value_in(first.values, name); !is_seed(name) && its && *its != value)
        refuse(claim.of.at, fmt::format("these runs differ in '{}' ({} and {}), and a claim speaks of such that differ "
                                        "in their seeds only: say more in 'where'",
                                        name, *its, value));
  if (!claim.beside) return;
  for (const std::size_t k : chosen)
    if (const auto partners = partners_of(claim, runs[k], runs); partners.size() != 1)
      refuse(claim.beside->at, fmt::format("'beside' names {} runs with the seeds of {}, and one is wanted",
                                           partners.size(), runs[k].title));
}

// ---- Numbers

using Why = NumberRead::Why;

NumberRead not_there(std::string reason) { return {Why::not_there, {}, std::move(reason)}; }

NumberRead divided(const NumberRead& a, const NumberRead& b) {
  if (a.why != Why::read) return a;
  if (b.why != Why::read) return b;
  if (b.number.value == 0) return not_there("it is divided by 0");
  return {Why::read, {a.number.value / b.number.value, a.number.dimension / b.number.dimension}, {}};
}

/// From the table of the batch: "energy: stored" is in its column "energy: stored [J]".
NumberRead number_in_column(const BatchRun& run, const std::string& column) {
  for (const auto& [name, value] : cells_of(run)) {
    const std::size_t open = name.rfind(" [");
    if (name != column && (open == std::string::npos || name.substr(0, open) != column)) continue;
    const auto unit = open == std::string::npos ? Unit{} : find_unit(name.substr(open + 2, name.size() - open - 3));
    const auto amount = parse_amount(value);
    if (!amount || !unit) return not_there("'" + column + "' is \"" + value + "\", no number");
    if (!amount->unit_name.empty()) return {Why::read, amount->quantity(), {}};
    return {Why::read, {unit->to_si(amount->value), unit->dimension}, {}};
  }
  return not_there("there is no column '" + column + "'");
}

NumberRead number_on_curve(const ClaimPlan& claim, const BatchRun& run) {
  constexpr std::uintmax_t longest = std::uintmax_t{1} << 31;
  try {
    const CurveTable curve = parse_table(read_text(run.folder / "curves" / (claim.curve + ".csv"), longest));
    const NumberRead number = read_from(curve, claim.reading);
    return claim.over ? divided(number, read_from(curve, *claim.over)) : number;
  } catch (const MachineFailure& failure) {
    return not_there(failure.what());
  }
}

NumberRead number_of(const ClaimPlan& claim, const BatchRun& run) {
  if (!run.done) return not_there("'" + run.name + "' is not done");
  return claim.curve.empty() ? number_in_column(run, claim.column) : number_on_curve(claim, run);
}

/// Of one run, with all that it is divided by and multiplied with.
NumberRead claimed_number(const ClaimPlan& claim, const BatchRun& run, const std::vector<BatchRun>& runs) {
  NumberRead read = number_of(claim, run);
  if (claim.beside) read = divided(read, number_of(claim, runs[partners_of(claim, run, runs).front()]));
  if (read.why == Why::read && claim.times) {
    const Quantity factor = claim.times->quantity();
    read.number = {read.number.value * factor.value, read.number.dimension * factor.dimension};
  }
  return read;
}

// ---- What came of it

struct Found {
  std::size_t chosen = 0, done = 0, failed = 0;
  std::vector<double> values;  ///< in SI
  Dimension dimension;
  bool is_unreached = false;  ///< some run is done, and its curve never comes there
  std::string reason;         ///< why a run that is done gave no number

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
    ++found.chosen;
    found.failed += runs[k].code > 0 || runs[k].refused;
    if (!runs[k].done) continue;
    ++found.done;
    const NumberRead read = claimed_number(claim, runs[k], runs);
    if (read.why != Why::read) {
      found.is_unreached = found.is_unreached || read.why == Why::not_reached;
      found.reason = read.reason;
      continue;
    }
    found.values.push_back(read.number.value);
    found.dimension = read.number.dimension;
  }
  return found;
}

/// A plain 0 is one of any kind.
bool is_of(const Amount& bound, const Dimension& dimension) {
  return bound.unit.dimension == dimension || (bound.value == 0 && bound.unit_name.empty());
}

std::string verdict_on(const ClaimPlan& claim, const Found& found) {
  if (found.values.empty())
    return found.done == 0      ? (found.failed > 0 ? "failed" : "not run")
           : found.is_unreached ? "not reached"
                                : "not read";
  if (!claim.from && !claim.to) return "no band";
  for (const auto& bound : {claim.from, claim.to})
    if (bound && !is_of(*bound, found.dimension)) return "not read";
  const bool holds = (!claim.from || found.mean() >= claim.from->quantity().value) &&
                     (!claim.to || found.mean() <= claim.to->quantity().value);
  if (found.values.size() < found.chosen) return holds ? "in so far" : "out so far";
  return holds ? "in" : "out";
}

std::string remark_on(const ClaimPlan& claim, const Found& found) {
  for (const auto& bound : {claim.from, claim.to})
    if (bound && !found.values.empty() && !is_of(*bound, found.dimension))
      return "the band is not in " + found.dimension.name();
  return found.reason;
}

/// In the unit of the band, with four digits.
std::string shown(double si, const Dimension& dimension, const ClaimPlan& claim) {
  for (const auto& bound : {claim.from, claim.to, parse_amount(claim.printed)})
    if (bound && bound->unit.dimension == dimension)
      return Amount{*parse_number(fmt::format("{:.4g}", bound->unit.from_si(si))), bound->unit_name, bound->unit}
          .text();
  return format_quantity(Quantity{*parse_number(fmt::format("{:.4g}", si)), dimension});
}

std::string text_of(const ChosenRuns& chosen) {
  std::string text;
  for (const ChosenRuns::Wanted& wanted : chosen.where)
    text += (text.empty() ? "" : "; ") + wanted.parameter + " = " + join(wanted.values);
  return text;
}

std::string what_is_read(const ClaimPlan& claim) {
  std::string text = claim.curve.empty() ? claim.column : claim.curve + ": " + claim.reading.text;
  if (claim.over) text += ", over " + claim.over->text;
  if (claim.beside) text += ", beside " + text_of(*claim.beside);
  if (claim.times) text += ", times " + claim.times->text();
  return text + " (" + claim.of.sweep + (claim.of.where.empty() ? "" : ": " + text_of(claim.of)) + ")";
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
  std::set<std::string> names;
  for (const ClaimPlan& claim : plan.claims) {
    if (!names.insert(claim.name).second) refuse(claim.of.at, fmt::format("there is a claim '{}' already", claim.name));
    refuse_none(claim.of, runs);
    if (claim.beside) refuse_none(*claim.beside, runs);
    refuse_mixed(claim, runs);
  }
  for (const FigurePlan& figure : plan.figures) refuse_none(figure.of, runs);
}

ResultTable claims_table(const std::vector<ClaimPlan>& claims, const std::vector<BatchRun>& runs) {
  ResultTable table{{"claim", "says", "source", "printed", "from", "to", "mean", "scatter", "runs", "of", "verdict",
                     "remark", "read"},
                    {}};
  for (const ClaimPlan& claim : claims) {
    const Found found = found_by(claim, runs);
    const auto amount = [&](double si) { return shown(si, found.dimension, claim); };
    const std::size_t count = found.values.size();
    table.rows.push_back({claim.name, claim.says, claim.source, claim.printed, claim.from ? claim.from->text() : "",
                          claim.to ? claim.to->text() : "", count > 0 ? amount(found.mean()) : "",
                          count > 1 ? amount(found.scatter()) : "", std::to_string(count), std::to_string(found.chosen),
                          verdict_on(claim, found), remark_on(claim, found), what_is_read(claim)});
  }
  return table;
}

ClaimFiles::ClaimFiles(const BatchPlan& plan, OwnFolder& folder) : plan_(plan) {
  const auto former = Manifest::read(folder.root(), Manifest::Of::batch);
  const auto place = [&](const char* name, bool is_wanted) {
    return is_wanted || (former && former->lists(name)) ? folder.claim(name) : std::filesystem::path();
  };
  claims_ = place("claims.csv", !plan.claims.empty());
  figures_ = place("figures.json", !plan.figures.empty());
}

void ClaimFiles::write(const std::vector<BatchRun>& runs) const {
  if (!figures_.empty()) {
    nlohmann::ordered_json figures = nlohmann::ordered_json::array();
    for (const FigurePlan& figure : plan_.figures) figures.push_back(json_of(figure, runs));
    write_atomically(figures_, nlohmann::ordered_json{{"figures", figures}}.dump(1) + "\n");
  }
  if (claims_.empty()) return;
  const ResultTable table = claims_table(plan_.claims, runs);
  write_atomically(claims_, csv_of(table));
  if (table.rows.empty()) return;
  const auto column =
      static_cast<std::size_t>(std::find(table.head.begin(), table.head.end(), "verdict") - table.head.begin());
  std::map<std::string, int> verdicts;
  for (const auto& row : table.rows) ++verdicts[row[column]];
  say("claims: {} in their bands, {} out of them, {} others\n", verdicts["in"], verdicts["out"],
      static_cast<int>(table.rows.size()) - verdicts["in"] - verdicts["out"]);
}

}  // namespace beadwork
