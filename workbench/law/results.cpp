#include "workbench/law/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "workbench/report/picture.hpp"
#include "workbench/report/text.hpp"

namespace beadwork::law {

namespace {

using Json = Office::Json;

std::string title_of(const Trial& trial) { return trial.family->name + ", " + trial.mode.name; }

CurvePlan plan_of(const Trial& trial) {
  const Mode& mode = trial.mode;
  return {.columns = {{mode.motion, mode.unit},
                      {mode.load, mode.load_unit},
                      {"work", "J"},
                      {"stored", "J"},
                      {"dissipated", "J"}},
          .title = title_of(trial),
          .x = mode.motion,
          .y = {mode.load}};
}

// Of the largest load: cycles and search sample a peak each in its own way. The search of what does not fail goes beyond
// what is shown.
Figures largest(const Trial& trial) {
  Figures figures = trial.figures;
  if (trial.found.softens && std::abs(trial.found.peak) > std::abs(figures.peak))
    figures.peak = trial.found.peak, figures.peak_at = trial.found.peak_at;
  return figures;
}

std::vector<const Trial*> of_family(const Family& family, const std::vector<Trial>& trials) {
  std::vector<const Trial*> found;
  for (const Trial& trial : trials)
    if (trial.family == &family) found.push_back(&trial);
  return found;
}

bool has_curve(const Trial& trial) { return trial.cycles.rows() > 0; }

Json result_of(const Trial& trial) {
  if (!trial.failure.empty()) return {{"failure", trial.failure}};
  Json result{{"motion", trial.mode.motion + " [" + trial.mode.unit + "]"},
              {"load", trial.mode.load + " [" + trial.mode.load_unit + "]"}};
  if (trial.bears_nothing) {
    result["peak"] = 0;
    return result;
  }
  result["stiffness"] = trial.found.stiffness;
  if (!trial.family->is_contact) result["stated_stiffness"] = trial.stated;
  result["peak"] = largest(trial).peak;
  result["peak_at"] = largest(trial).peak_at;
  result["failed_at"] = trial.found.failed_at ? Json(*trial.found.failed_at) : Json(nullptr);
  const auto& reached = trial.cycles.motion;
  const auto farthest =
      std::max_element(reached.begin(), reached.end(), [](Real a, Real b) { return std::abs(a) < std::abs(b); });
  result["reached"] = farthest == reached.end() ? 0 : *farthest;
  result["dissipated"] = trial.figures.dissipated;
  result["curve"] = "curves/" + trial.name + ".csv";
  result["picture"] = "curves/" + trial.name + ".svg";
  return result;
}

std::vector<std::string> notes_of(const Family& family, const std::vector<const Trial*>& trials) {
  std::vector<std::string> notes;
  if (const std::string missing = missing_modes(family); !missing.empty()) notes.push_back(missing);
  for (const std::string& remark : family.remarks) notes.push_back(remark);
  for (const Trial* trial : trials) {
    const std::string& mode = trial->mode.name;
    if (!trial->failure.empty())
      notes.push_back(fmt::format("{} could not be run: {}", mode, trial->failure));
    else if (trial->bears_nothing)
      notes.push_back(fmt::format("it bears nothing in {}: there is no curve", mode));
    else if (trial->found.softens && !trial->found.failed_at)
      notes.push_back(fmt::format("{}: it has not failed as far as it was looked for, which --{} moves", mode,
                                  trial->mode.is_turn() ? "angle" : "strain"));
  }
  return notes;
}

std::string quantity(Real value, const std::string& unit) {
  const report::Scale scale = report::readable(unit, std::abs(value));
  return fmt::format("{:.4g} {}", value * scale.factor, scale.unit);
}

std::string row_of(const Trial& trial) {
  if (trial.bears_nothing || !trial.failure.empty()) return fmt::format("  {:<12} -\n", trial.mode.name);
  const std::string stiffness = trial.mode.is_turn() ? "N.m" : "N/m";  // a radian is a plain number
  const Found& found = trial.found;
  const Figures most = largest(trial);
  return fmt::format(
      "  {:<12} {:>15} {:>15} {:>13} {:>12} {:>12} {:>12}\n", trial.mode.name, quantity(found.stiffness, stiffness),
      trial.family->is_contact ? "-" : quantity(trial.stated, stiffness), quantity(most.peak, trial.mode.load_unit),
      quantity(most.peak_at, trial.mode.unit), found.failed_at ? quantity(*found.failed_at, trial.mode.unit) : "-",
      quantity(trial.figures.dissipated, "J"));
}

}  // namespace

void put_curves(const std::vector<Trial>& trials, Office& office) {
  for (const Trial& trial : trials) {
    if (!has_curve(trial)) continue;
    const Response& r = trial.cycles;
    std::vector<std::vector<Real>> rows;
    for (std::size_t k = 0; k < r.rows(); ++k)
      rows.push_back({r.motion[k], r.load[k], r.work[k], r.stored[k], r.dissipated[k]});
    const CurvePlan plan = plan_of(trial);
    office.curve(trial.name, plan, rows);
    office.write("curves/" + trial.name + ".svg",
                 report::picture(plan.title, {trial.mode.motion, trial.mode.unit, r.motion},
                                 {trial.mode.load, trial.mode.load_unit, r.load}));
  }
}

Json result_of(const std::vector<Family>& families, const std::vector<Trial>& trials) {
  Json result = Json::object();
  for (const Family& family : families) {
    const auto its = of_family(family, trials);
    Json& one = result[family.name] = Json::object();
    one["law"] = family.tag;
    one["radii"] = {its.front()->pair.radius1, its.front()->pair.radius2};
    one["distance"] = its.front()->pair.distance();
    for (const Trial* trial : its) one["modes"][trial->mode.name] = result_of(*trial);
    one["notes"] = notes_of(family, its);
  }
  return result;
}

std::string table_of(const std::vector<Family>& families, const std::vector<Trial>& trials) {
  std::string text;
  for (const Family& family : families) {
    const auto its = of_family(family, trials);
    const Pair& pair = its.front()->pair;
    text += fmt::format("{}: <{}>, elements of radius {} and {}\n", family.name, family.tag,
                        quantity(pair.radius1, "m"), quantity(pair.radius2, "m"));
    text += fmt::format("  {:<12} {:>15} {:>15} {:>13} {:>12} {:>12} {:>12}\n", "", "stiffness", "stated", "peak", "at",
                        "failed at", "dissipated");
    for (const Trial* trial : its) text += row_of(*trial);
    for (const std::string& note : notes_of(family, its)) text += "  " + note + "\n";
  }
  return text;
}

ExitCode worst_of(const std::vector<Trial>& trials) {
  for (const Trial& trial : trials)
    if (trial.code != ExitCode::done) return trial.code;
  return ExitCode::done;
}

}  // namespace beadwork::law
