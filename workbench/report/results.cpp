// What a run has found, read from what it wrote: of its curves the largest forces and where they ended, of its summary
// all numbers that say how it went.

#include "workbench/report/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/io/file.hpp"
#include "core/loop/bounded_json.hpp"
#include "workbench/report/table.hpp"

namespace beadwork {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// All numbers of an object, and of those in it, by what they are called ("energy: stored [J]"), and the verdict of
// `quality`.
void add_numbers(const Json& object, const std::string& heading, const std::string& unit, Results& results) {
  for (const auto& [key, value] : object.items()) {
    const std::string name = heading + ": " + key;
    if (value.is_object()) add_numbers(value, name, unit, results);
    if (value.is_boolean()) results.emplace_back(name, value.get<bool>() ? "1" : "0");
    if (value.is_number()) results.emplace_back(name + (key == "free_motion" ? " [m]" : unit), value.dump());
    if (key == "verdict" && value.is_string()) results.emplace_back(name, value.get<std::string>());
  }
}

void add_curve(const fs::path& file, Results& results) {
  constexpr std::uintmax_t longest = std::uintmax_t{1} << 31;
  const report::Table table = report::parse_table(read_text(file, longest));
  const Json sidecar = bounded_object(fs::path(file).replace_extension(".json"));
  if (sidecar.contains("kind") && sidecar["kind"] == "ledger") return;     // its end stands in the summary
  if (sidecar.contains("kind") && sidecar["kind"] == "histogram") return;  // its last row is no end
  for (const report::Column& column : table.columns) {
    if (column.is_reference()) continue;
    if (column.unit == "N") {
      double largest = NAN;
      for (const double value : column.values)
        if (std::isfinite(value) && !(std::abs(value) <= std::abs(largest))) largest = value;
      if (std::isfinite(largest))
        results.emplace_back(fmt::format("{}: largest {} [N]", file.stem().string(), column.name),
                             fmt::format("{}", largest));
    }
    if (column.unit == "m" && !column.values.empty())
      results.emplace_back(fmt::format("{}: final {} [m]", file.stem().string(), column.name),
                           fmt::format("{}", column.values.back()));
  }
}

}  // namespace

Results results_of(const fs::path& folder) {
  Results results;
  std::vector<fs::path> curves;
  std::error_code error;
  for (fs::directory_iterator it(folder / "curves", error), end; !error && it != end; it.increment(error))
    if (it->path().extension() == ".csv" && it->is_regular_file(error)) curves.push_back(it->path());
  std::sort(curves.begin(), curves.end());
  for (const fs::path& curve : curves) {
    try {
      add_curve(curve, results);
    } catch (const MachineFailure&) {  // the table has what could be read
    }
  }
  const Json summary = bounded_object(folder / "summary.json");
  const auto part = [&](const char* key) {
    return summary.contains(key) && summary[key].is_object() ? summary[key] : Json::object();
  };
  add_numbers(part("breaks"), "breaks", "", results);
  add_numbers(part("energy"), "energy", " [J]", results);
  add_numbers(part("quality"), "quality", "", results);
  add_numbers(part("result"), "result", "", results);
  return results;
}

}  // namespace beadwork
