// The packing report, in words and with units.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/loop/json_text.hpp"
#include "workbench/report/chart.hpp"
#include "workbench/report/sections.hpp"
#include "workbench/report/table.hpp"
#include "workbench/report/text.hpp"

namespace beadwork::report {

namespace {

/// A figure of the packing report: its key, what a reader calls it, and its unit ("%" for a share, "m" for a length).
struct Figure {
  const char *key, *words, *unit;
};
constexpr std::array figures = {
    Figure{"set", "set", ""},
    Figure{"step", "step of the filling", ""},
    Figure{"elements", "elements", ""},
    Figure{"seed", "seed", ""},
    Figure{"seconds", "time taken", "s"},
    Figure{"coordination", "coordination number Z (gaps within the tolerance)", ""},
    Figure{"coordination_without_rattlers", "Z without rattlers", ""},
    Figure{"coordination_bulk", "Z in the bulk (3 mean radii from walls)", ""},
    Figure{"coordination_touching", "Z of touching elements", ""},
    Figure{"coordination_touching_without_rattlers", "Z of touching elements without rattlers", ""},
    Figure{"gap_tolerance", "gap tolerance, over R1 + R2", "%"},
    Figure{"rattlers", "rattlers (fewer than 4 contacts)", "%"},
    Figure{"max_overlap", "largest overlap, over R1 + R2", "%"},
    Figure{"mean_overlap", "mean overlap, over R1 + R2", "%"},
    Figure{"fabric_eigenvalues", "eigenvalues of the fabric tensor (isotropic: 0.333)", ""},
    Figure{"fabric_eigenvalues_bulk", "the same in the bulk", ""},
    Figure{"density", "packing density", "%"},
    Figure{"density_bulk", "packing density in the bulk", "%"},
    Figure{"mean_radius", "mean radius", "m"},
    Figure{"min_radius", "smallest radius", "m"},
    Figure{"max_radius", "largest radius", "m"},
    Figure{"kolmogorov_smirnov_distance", "Kolmogorov-Smirnov distance of the radii from their law", ""},
    Figure{"bond_order_q6", "bond order q6 (crystal: 1)", ""},
    Figure{"crystalline_share", "elements in crystalline surroundings", "%"},
};

std::string in_unit(double value, const std::string& unit) {
  if (unit == "%") return number(100 * value) + " %";
  if (unit == "s") return duration(value);
  if (unit.empty()) return number(value);
  const Scale scale = readable(unit, std::abs(value));
  return number(value * scale.factor) + " " + scale.unit;
}

std::string cell(const Json& value, const std::string& unit) {
  if (value.is_number_integer() && unit.empty()) return count(value.get<std::int64_t>());
  if (value.is_number()) return in_unit(value.get<double>(), unit);
  if (value.is_string()) return escaped(value.get<std::string>());
  if (!value.is_array()) return escaped(json_text(value));
  std::string list;
  for (const Json& entry : value) list += (list.empty() ? "" : ", ") + cell(entry, unit);
  return list;
}

/// What the report knows in its order, then what it has never heard of, as it is.
std::string table(const Json& report) {
  std::string rows;
  const auto row = [&](const std::string& words, const std::string& value) {
    rows += fmt::format("<tr><th>{}</th><td>{}</td></tr>", escaped(words), value);
  };
  for (const Figure& figure : figures)
    if (const auto found = report.find(figure.key); found != report.end()) row(figure.words, cell(*found, figure.unit));
  for (const auto& [key, value] : report.items()) {
    const bool known = std::any_of(figures.begin(), figures.end(), [&k = key](const Figure& f) { return k == f.key; });
    if (!known && !value.is_object()) row(spaced(key), cell(value, ""));
  }
  return rows.empty() ? "" : "<table class=\"facts\"><tbody>" + rows + "</tbody></table>";
}

std::vector<double> reals_in(const Json& object, const char* key) {
  std::vector<double> out;
  const auto found = object.find(key);
  if (found == object.end() || !found->is_array()) return out;
  for (const Json& value : *found)
    if (value.is_number()) out.push_back(value.get<double>());
  if (std::any_of(out.begin(), out.end(), [](double v) { return !(std::abs(v) <= largest_drawn); })) out.clear();
  return out;
}

std::string histogram(const std::string& title, const Json& value) {
  Bars bars;
  bars.edges = reals_in(value, "edges");
  bars.heights = reals_in(value, "counts");
  if (bars.edges.empty()) return "";
  const std::string unit = text_of(value, "unit", "m");
  const Scale scale = readable(unit, bars.edges.back());
  for (double& edge : bars.edges) edge *= scale.factor;
  bars.title = title;
  bars.x_label = unit == "1" ? "radius over the mean radius" : with_unit("radius", scale.unit);
  bars.y_label = "elements";
  return figure(bars);
}

}  // namespace

std::string packing(const Run& run) {
  const auto found = run.summary.find("packing");
  if (found == run.summary.end()) return "";
  std::string body;
  for (const Json& report : found->is_array() ? *found : Json::array({*found})) {
    if (!report.is_object()) continue;
    std::string charts;
    for (const auto& [key, value] : report.items())
      if (value.is_object() && value.contains("edges") && value.contains("counts"))
        charts += histogram(spaced(key), value);
    body += "<div class=\"beside\">" + charts + "<div>" + table(report) + "</div></div>";
  }
  return section("Packing", body);
}

}  // namespace beadwork::report
