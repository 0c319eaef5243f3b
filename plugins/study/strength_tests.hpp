#pragma once
// Which strength of bonds or elements gives the solid its own.   docs/theory/calibration.md
//
// The peak is proportional to the strength: one test tells the factor, at strains so small that nothing else bends it,
// and another one is the proof, at those of the material and with inertia.

#include <algorithm>
#include <limits>

#include "core/mechanics/bonded_packing.hpp"
#include "plugins/study/calibration_results.hpp"

namespace beadwork::calibration {

class StrengthTests {
 public:
  StrengthTests(const Plan& plan, const StudyDesk& desk, const Found& found)
      : plan_(plan), samples_(plan), desk_(desk), found_(found) {}

  std::vector<Strength> all() {
    std::vector<Strength> strengths;
    for (const std::string& criterion : plan_.criteria) strengths.push_back({criterion});
    invert(strengths);
    prove(strengths);
    return strengths;
  }

 private:
  struct Test {
    std::size_t strength;  ///< of which of the strengths
    std::size_t sample;
    Real value;  ///< [Pa]
  };

  static std::string plugin_of(const std::string& criterion) {
    return criterion == "rdef" ? R"(virial-stress of="beam")"
                               : fmt::format(R"(bond-stress of="beam" measure="{}")", criterion.substr(4));
  }

  Real target() const { return *plan_.material.strength; }
  bool is_static() const { return plan_.decks.by == "static"; }

  /// A multiple of the mean over all bonds or elements at the strength that is wanted, as few of these carry the most.
  Real first_try(const std::string& criterion, const Packed& packing) const {
    const BondedPacking solid{packing.coordination_bulk, packing.density_bulk, found_.ratio};
    const Real mean = criterion == "rdef" ? hydrostatic_stress_ratio(solid) : axial_stress_ratio(solid);
    return (criterion == "rdef" ? 6 : 8) * mean * target();
  }

  void invert(std::vector<Strength>& strengths) {
    const Real smaller = is_static() ? 1e-3 : 1, longest = is_static() ? 12 : 4;  // of a first try nobody knows
    std::vector<Test> tests;
    for (std::size_t s = 0; s < strengths.size(); ++s)
      for (std::size_t k = 0; k < found_.packings.size(); ++k)
        tests.push_back({s, k, rounded(smaller * first_try(strengths[s].criterion, found_.packings[k]), significant)});
    const std::vector<Real> peaks = peaks_of(tests, strengths, plan_.decks.by, smaller * longest);
    for (std::size_t t = 0; t < tests.size(); ++t)
      if (std::isfinite(peaks[t])) strengths[tests[t].strength].wanted.push_back(tests[t].value * target() / peaks[t]);
    for (Strength& one : strengths) settle(one);
  }

  void settle(Strength& one) const {
    if (one.wanted.empty()) return desk_.log.warn(fmt::format("{}: no strength: {}", one.criterion, one.trouble));
    one.trouble.clear();
    Real inverse = 0;  // the mean of the peaks is to be what is wanted
    for (const Real wanted : one.wanted) inverse += 1 / wanted / static_cast<Real>(one.wanted.size());
    one.value = rounded(1 / inverse, significant);
    desk_.log.say(fmt::format("found: {} strength {}", one.criterion, stress_text(one.wanted)));
  }

  void prove(std::vector<Strength>& strengths) {
    std::vector<Test> tests;
    for (std::size_t s = 0; s < strengths.size(); ++s)
      for (std::size_t k = 0; k < found_.packings.size(); ++k)
        if (strengths[s].trouble.empty()) tests.push_back({s, k, strengths[s].value});
    std::vector<Strength> ignored = strengths;
    const std::vector<Real> peaks = peaks_of(tests, ignored, "verlet", 4);
    for (std::size_t t = 0; t < tests.size(); ++t)
      if (std::isfinite(peaks[t])) strengths[tests[t].strength].confirmed.push_back(peaks[t]);
    for (Strength& one : strengths)
      if (one.trouble.empty()) believe(one);
  }

  // A strength that the proof belies is none that a deck should include: at strains that are no longer small the peak is not
  // proportional to it.
  void believe(Strength& one) const {
    desk_.log.say(fmt::format("{}: with {:.4g} MPa for all samples, and inertia, they carry {}", one.criterion,
                              1e-6 * one.value, stress_text(one.confirmed)));
    if (!one.confirmed.empty() && std::abs(scatter_of(one.confirmed).mean / target() - 1) < 0.5) return;
    one.trouble = fmt::format("with {:.4g} MPa the samples carry {} instead of {:.4g} MPa", 1e-6 * one.value,
                              stress_text(one.confirmed), 1e-6 * target());
    desk_.log.warn(fmt::format("{}: no strength: {}; a solid of E = {:.4g} GPa may not be able to carry that much",
                               one.criterion, one.trouble, 1e-9 * plan_.material.young));
  }

  /// `longest`: times the strain at which an elastic solid has the strength that is wanted; by then all have broken.
  std::vector<Real> peaks_of(const std::vector<Test>& tests, std::vector<Strength>& strengths, const std::string& by,
                             Real longest) {
    std::vector<Errand> errands;
    for (const Test& test : tests) errands.push_back(errand(test, strengths[test.strength].criterion, by, longest));
    std::vector<Real> peaks;
    const std::vector<Outcome> outcomes = desk_.runner.run(errands);
    for (std::size_t t = 0; t < outcomes.size(); ++t) {
      std::string why;
      peaks.push_back(peak(outcomes[t], why));
      if (why.empty()) continue;
      desk_.log.warn(fmt::format("{}: {}", errands[t].name, why));
      strengths[tests[t].strength].trouble = why;
    }
    return peaks;
  }

  Errand errand(const Test& test, const std::string& criterion, const std::string& by, Real longest) const {
    const std::string name = criterion + (by == plan_.decks.by ? "" : "-with-inertia");
    const auto deck = desk_.write(name + ".xml", strength_deck(plan_.decks, by, plugin_of(criterion)));
    const Packed& packing = found_.packings[test.sample];
    const Real longest_wait = 4 * transits * samples_.transit();
    Errand errand{fmt::format("{},seed={},strength={}-MPa", name, packing.seed,
                              format_number(rounded(1e-6 * test.value, significant))),
                  deck, samples_.of(packing, found_.ratio, found_.young)};
    add(errand.overrides, {{"strength", format_number(test.value) + " Pa"},
                           {"stretch", length_text(longest * target() / plan_.material.young * samples_.extent())},
                           {"time", time_text(longest_wait)}});
    return errand;
  }

  /// The largest stress that the sample carries [Pa]; NaN, with a reason, where it did not break.
  Real peak(const Outcome& outcome, std::string& trouble) const {
    const auto force = outcome.column("force", "force");
    const auto most = std::max_element(force.begin(), force.end());
    if (!outcome.is_done())
      trouble = outcome.reason;
    else if (most == force.end() || !(*most > 0) || std::next(most) == force.end())
      trouble = "the force has no peak";
    else
      return *most / samples_.section(plan_.through_centres).area;
    return std::numeric_limits<Real>::quiet_NaN();
  }

  const Plan& plan_;
  Samples samples_;
  const StudyDesk& desk_;
  const Found& found_;
};

}  // namespace beadwork::calibration
