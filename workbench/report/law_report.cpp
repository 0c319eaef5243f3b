// The report of single bonds: for each family what was read off its curves, and the curves.

#include <algorithm>
#include <cmath>

#include "workbench/report/sections.hpp"
#include "workbench/report/text.hpp"

namespace beadwork::report {

namespace {

/// The unit that stands in brackets: "opening [m]" -> "m".
std::string unit_in(const Json& mode, const std::string& key) {
  const std::string text = text_of(mode, key);
  const auto open = text.find('['), close = text.find(']');
  return open == std::string::npos || close == std::string::npos ? "" : text.substr(open + 1, close - open - 1);
}

std::string cell(const Json& mode, const std::string& key, const std::string& unit) {
  const auto found = mode.find(key);
  if (found == mode.end() || !found->is_number()) return "<td>–</td>";
  const double value = found->get<double>();
  const Scale scale = readable(unit, std::abs(value));
  return "<td>" + number(value * scale.factor) + " " + escaped(scale.unit) + "</td>";
}

std::string row(const std::string& name, const Json& mode) {
  const std::string motion = unit_in(mode, "motion"), load = unit_in(mode, "load");
  const std::string stiffness = motion == "m" ? "N/m" : load;
  return "<tr><th>" + escaped(name) + "</th>" + cell(mode, "stiffness", stiffness) +
         cell(mode, "stated_stiffness", stiffness) + cell(mode, "peak", load) + cell(mode, "peak_at", motion) +
         cell(mode, "failed_at", motion) + cell(mode, "dissipated", "J") + "</tr>";
}

std::string table(const Json& modes) {
  std::string rows;
  for (const auto& [name, mode] : modes.items())
    if (mode.is_object()) rows += row(name, mode);
  return "<table><thead><tr><th></th><th>stiffness</th><th>stated by the law</th><th>largest load</th><th>at</th>"
         "<th>failed at</th><th>dissipated</th></tr></thead><tbody>" +
         rows + "</tbody></table>";
}

std::string remarks(const Json& family) {
  std::string out;
  const auto notes = family.find("notes");
  if (notes == family.end() || !notes->is_array()) return out;
  for (const Json& note : *notes)
    if (note.is_string()) out += "<p class=\"note\">" + escaped(note.get<std::string>()) + "</p>";
  return out;
}

}  // namespace

std::string laws(Run& study, const Json& result) {
  std::string out;
  for (const auto& [name, family] : result.items()) {
    if (!family.is_object() || !family.contains("modes") || !family["modes"].is_object()) continue;
    Run its;
    for (const auto& [kind, mode] : family["modes"].items()) {
      const auto stem = std::filesystem::path(text_of(mode, "curve")).stem().string();
      const auto curve =
          std::find_if(study.curves.begin(), study.curves.end(), [&](const Curve& each) { return each.name == stem; });
      if (curve != study.curves.end()) its.curves.push_back(std::move(*curve));
    }
    out +=
        section(name + " <" + text_of(family, "law") + ">", table(family["modes"]) + remarks(family)) + curves(its, {});
  }
  return out;
}

}  // namespace beadwork::report
