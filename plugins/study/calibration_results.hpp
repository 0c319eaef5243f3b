#pragma once
// What a calibration leaves: the file of parameters, curves, and figures for summary.json.

#include <set>

#include "core/mechanics/bonded_packing.hpp"
#include "core/plugin/study.hpp"
#include "plugins/study/test_results.hpp"

namespace beadwork::calibration {

/// "bbf-strength" of the criterion "bbf-axial-bending", which <bond-stress> takes where it is told nothing.
inline std::string parameter_of(const std::string& criterion) {
  return (criterion == "bbf-axial-bending" ? "bbf" : criterion) + "-strength";
}

/// A parameter of the file that decks include.
struct FoundParameter {
  std::string name;  ///< "epoxy.young"
  Real value;
  std::string unit, remark;
};

inline std::vector<FoundParameter> parameters_found(const Plan& plan, const Found& found) {
  const Material& m = plan.material;
  const std::string name = m.name + ".";
  std::vector<Real> young;
  for (const Elastic& e : found.elastic) young.push_back(1e-9 * m.young / modulus_of(plan, e));
  std::vector<FoundParameter> all{
      {name + "radius-ratio", found.ratio, "", "samples by themselves: " + spread_text(found.ratios)},
      {name + "young", found.young, " Pa", spread_text(young) + " GPa"},
      {name + "poisson", plan.bond_poisson, "", "of the bonds; the solid hardly depends on it"}};
  if (m.density) {
    const Real packed = scatter_of(each(found.packings, &Packed::density_bulk)).mean;
    all.push_back({name + "density", rounded(*m.density / packed, 5), " kg/m^3",
                   fmt::format("of the elements: that of the solid is {:.6g} kg/m^3", *m.density)});
  }
  for (const Strength& s : found.strengths)
    if (s.trouble.empty())
      all.push_back({name + parameter_of(s.criterion), s.value, " Pa",
                     fmt::format("{}; with it the samples carry {}", stress_text(s.wanted), stress_text(s.confirmed))});
  return all;
}

inline std::string parameters(const Plan& plan, const Found& found, const std::string& provenance) {
  const Material& m = plan.material;
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- Bonds whose solid is {}: Young's modulus {:.6g} GPa, Poisson's "
      "ratio {:.4g}{}.\n     {}.\n     {} samples ({}, {} elements, spread of radii {:.4g}, seeds {} to {}): "
      "coordination {} ({} "
      "in the bulk), density {} in the bulk.\n     Stress is the reaction over the section {}.\n     Behind +-: the "
      "standard deviation of the samples. -->\n<scene>\n",
      m.name, 1e-9 * m.young, m.poisson,
      m.strength ? fmt::format(", tensile strength {:.6g} MPa", 1e-6 * *m.strength) : "", provenance, plan.seeds,
      plan.decks.is_cylinder ? "cylinder" : "box", plan.decks.elements, plan.decks.spread, plan.first_seed,
      plan.first_seed + plan.seeds - 1, spread_text(each(found.packings, &Packed::coordination)),
      spread_text(each(found.packings, &Packed::coordination_bulk)),
      spread_text(each(found.packings, &Packed::density_bulk)),
      plan.through_centres ? "through the centres of the outer elements" : "of the whole sample");
  text += tests_remark(plan, found.tested);
  for (const FoundParameter& p : parameters_found(plan, found))
    text += fmt::format("  <parameter name=\"{}\" value=\"{}{}\"/>  <!-- {} -->\n", p.name, format_number(p.value),
                        p.unit, p.remark);
  return text + "</scene>\n";
}

/// nu_M and E_M/E_mu over the radius ratio: means, each sample, and the closed form.
inline void write_curves(const Found& found, const StudyDesk& desk) {
  CurvePlan poisson{.columns = {{"radius-ratio", "1"}, {"poisson", "1"}, {"deviation", "1"}},
                    .title = "Poisson's ratio of the solid",
                    .x = "radius-ratio",
                    .y = {"poisson"}};
  CurvePlan stiffness{.columns = {{"radius-ratio", "1"}, {"modulus-ratio", "1"}, {"deviation", "1"}},
                      .title = "Young's modulus of the solid over that of the bonds",
                      .x = "radius-ratio",
                      .y = {"modulus-ratio"}};
  for (const Packed& packing : found.packings) {
    poisson.columns.push_back({fmt::format("seed-{}", packing.seed), "1"});
    stiffness.columns.push_back({fmt::format("seed-{}", packing.seed), "1"});
  }
  stiffness.columns.push_back({"reference closed form", "1"});
  std::set<Real> ratios;
  for (const Curves& curves : found.curves)
    for (const auto& [ratio, value] : curves.poisson.points()) ratios.insert(ratio);
  std::vector<std::vector<Real>> poisson_rows, stiffness_rows;
  for (const Real ratio : ratios) {
    std::vector<Real> nu, modulus;
    for (const Curves& curves : found.curves) {
      nu.push_back(curves.poisson.at(ratio));
      modulus.push_back(curves.stiffness.at(ratio));
    }
    const Scatter s = scatter_of(nu), t = scatter_of(modulus);
    poisson_rows.push_back({ratio, s.mean, s.deviation});
    poisson_rows.back().insert(poisson_rows.back().end(), nu.begin(), nu.end());
    stiffness_rows.push_back({ratio, t.mean, t.deviation});
    stiffness_rows.back().insert(stiffness_rows.back().end(), modulus.begin(), modulus.end());
    const Real z = scatter_of(each(found.packings, &Packed::coordination_bulk)).mean;
    const Real phi = scatter_of(each(found.packings, &Packed::density_bulk)).mean;
    stiffness_rows.back().push_back(stiffness_ratio({z, phi, ratio}, s.mean));
  }
  desk.curve("poisson", poisson, poisson_rows);
  desk.curve("stiffness", stiffness, stiffness_rows);
  std::vector<std::vector<Real>> line;
  for (const auto& [of_bonds, of_solid] : found.line) line.push_back({of_bonds, of_solid});
  desk.curve("young",
             {.columns = {{"young-of-bonds", "Pa"}, {"young", "Pa"}},
              .title = "Young's modulus of the first sample at the radius ratio that was found",
              .x = "young-of-bonds",
              .y = {"young"}},
             line);
}

/// How far the ratio of the two moduli is from that of the first run, at most.
inline Real off_the_line(const std::vector<std::array<Real, 2>>& line) {
  Real most = 0;
  for (const auto& [of_bonds, of_solid] : line)
    most = std::max(most, std::abs(of_solid / of_bonds * line.front()[0] / line.front()[1] - 1));
  return most;
}

inline std::string result_json(const Plan& plan, const Found& found) {
  const Material& m = plan.material;
  std::vector<Real> low = each(found.packings, &Packed::fabric_low), high = each(found.packings, &Packed::fabric_high);
  std::string text = fmt::format(
      R"({{"material":"{}","elements":{},"seeds":{},"section":"{}","solved_by":"{}",)"
      R"("packing":{{"coordination":{},"coordination_bulk":{},"density_bulk":{},"fabric_least":{},"fabric_largest":{}}},)"
      R"("radius_ratio":{{"value":{},"samples":{}}},"young_of_bonds":{},"poisson":{},)"
      R"("modulus_ratio":{{"reaction_through_centres":{},"reaction_over_box":{},"virial_in_core":{},"closed_form":{}}},)"
      R"("lateral_stress_in_core":{})",
      m.name, plan.decks.elements, plan.seeds, plan.through_centres ? "centres" : "box", plan.decks.by,
      numbers_json(each(found.packings, &Packed::coordination)),
      numbers_json(each(found.packings, &Packed::coordination_bulk)),
      numbers_json(each(found.packings, &Packed::density_bulk)), numbers_json(low), numbers_json(high),
      format_number(found.ratio), numbers_json(found.ratios), format_number(found.young),
      numbers_json(each(found.elastic, &Elastic::poisson)), numbers_json(each(found.elastic, &Elastic::centres)),
      numbers_json(each(found.elastic, &Elastic::box)), numbers_json(each(found.elastic, &Elastic::virial)),
      format_number(stiffness_ratio({scatter_of(each(found.packings, &Packed::coordination_bulk)).mean,
                                     scatter_of(each(found.packings, &Packed::density_bulk)).mean, found.ratio},
                                    scatter_of(each(found.elastic, &Elastic::poisson)).mean)),
      numbers_json(each(found.elastic, &Elastic::sideways)));
  for (const auto& [axis, elastic] : found.along)
    text += fmt::format(R"(,"along_{}":{{"modulus_ratio":{},"poisson":{}}})", axis,
                        numbers_json(moduli_of(plan, elastic)), numbers_json(each(elastic, &Elastic::poisson)));
  for (const Strength& s : found.strengths)
    text += s.trouble.empty() ? fmt::format(R"(,"{}":{{"strength":{},"samples":{},"peak":{}}})", s.criterion,
                                            format_number(s.value), numbers_json(s.wanted), numbers_json(s.confirmed))
                              : fmt::format(R"(,"{}":{{"strength":null}})", s.criterion);
  std::string list;
  for (const FoundParameter& p : parameters_found(plan, found))
    list += fmt::format(R"({}"{}":{})", list.empty() ? "" : ",", p.name, number_json(p.value));
  text += fmt::format(R"(,"parameters":{{{}}})", list);
  if (!found.line.empty()) text += fmt::format(R"(,"off_the_line":{})", number_json(off_the_line(found.line)));
  if (!found.tested.empty()) text += "," + tests_json(plan, found.tested);
  return text + "}";
}

}  // namespace beadwork::calibration
