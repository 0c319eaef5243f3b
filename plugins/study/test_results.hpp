#pragma once
// What the tests of the samples say, side by side: lines for the terminal and for the file of parameters, and figures
// for summary.json.

#include <fmt/ranges.h>

#include "plugins/study/calibration_texts.hpp"

namespace beadwork::calibration {

inline constexpr const char* every_test[] = {"tension", "compression", "bending", "torsion", "wave"};

/// Of one sample; of torsion 2 (1 + nu) G. Nothing where it was not tested so.
inline std::optional<Modulus> young_by(const Tested& one, const std::string& test) {
  if (test == "wave") return one.rod ? std::optional(one.rod->wave) : std::nullopt;
  const auto found = one.moduli.find(test);
  if (found == one.moduli.end()) return std::nullopt;
  const Real factor = test == "torsion" ? 2 * (1 + one.poisson) : 1;
  return Modulus{factor * found->second.section, factor * found->second.carrying};
}

inline std::vector<Modulus> young_of_all(const std::vector<Tested>& all, const std::string& test) {
  std::vector<Modulus> values;
  for (const Tested& one : all)
    if (const auto young = young_by(one, test)) values.push_back(*young);
  return values;
}

inline std::vector<Rod> rods_of(const std::vector<Tested>& all) {
  std::vector<Rod> rods;
  for (const Tested& one : all)
    if (one.rod) rods.push_back(*one.rod);
  return rods;
}

/// E by the wave over E by statics of the same rods.
inline std::vector<Real> wave_over_still(const std::vector<Rod>& rods) {
  std::vector<Real> values;
  for (const Rod& rod : rods) values.push_back(rod.wave.section / rod.still.section);
  return values;
}

/// E by a test over E by tension: of means over the samples. By the wave over E by statics of the same rods, as these are
/// narrower than the samples.
struct Saying {
  std::string test;
  Modulus over_tension;
};

inline std::vector<Saying> sayings(const std::vector<Tested>& all) {
  const auto mean = [&](const std::string& test, Real Modulus::*over) {
    return scatter_of(each(young_of_all(all, test), over)).mean;
  };
  std::vector<Saying> said;
  if (young_of_all(all, "tension").empty()) return said;
  for (const std::string test : {"compression", "bending", "torsion"})
    if (!young_of_all(all, test).empty())
      said.push_back({test,
                      {mean(test, &Modulus::section) / mean("tension", &Modulus::section),
                       mean(test, &Modulus::carrying) / mean("tension", &Modulus::carrying)}});
  if (const std::vector<Rod> rods = rods_of(all); !rods.empty()) {
    const Real ratio = scatter_of(wave_over_still(rods)).mean;
    said.push_back({"wave", {ratio, ratio}});
  }
  return said;
}

/// The saying that is farthest from that of tension, and by how much of it.
struct Farthest {
  std::string test = "tension";
  Real by = 0;
};
inline Farthest farthest(const std::vector<Saying>& said, Real Modulus::*over) {
  Farthest most;
  for (const Saying& one : said)
    if (const Real by = std::abs(one.over_tension.*over - 1); by > most.by) most = {one.test, by};
  return most;
}

/// Poisson's ratio from E/(2G) - 1 with E by this test; of each sample that has both.
inline std::vector<Real> poisson_by_torsion(const std::vector<Tested>& all, const std::string& test) {
  std::vector<Real> values;
  for (const Tested& one : all)
    if (one.moduli.contains("torsion") && one.moduli.contains(test))
      values.push_back(one.moduli.at(test).section / (2 * one.moduli.at("torsion").section) - 1);
  return values;
}

inline std::vector<Modulus> shear_of_all(const std::vector<Tested>& all) {
  std::vector<Modulus> values;
  for (const Tested& one : all)
    if (one.moduli.contains("torsion")) values.push_back(one.moduli.at("torsion"));
  return values;
}

inline std::string gigapascals(std::vector<Real> values) {
  for (Real& value : values) value *= 1e-9;
  return spread_text(values);
}

/// How well they agree, as shares of what tension says.
inline std::string agreement_text(const std::vector<Saying>& said) {
  if (said.empty()) return "";
  const Farthest plain = farthest(said, &Modulus::section), carried = farthest(said, &Modulus::carrying);
  return fmt::format("each test says what tension does: E to {:.2g} % ({} is farthest), E_c to {:.2g} % ({})",
                     100 * plain.by, plain.test, 100 * carried.by, carried.test);
}

/// What is to be said of a test beside its E.
inline std::string test_remark(const std::vector<Tested>& all, const std::string& test) {
  if (test == "torsion")
    return fmt::format("2 (1 + nu) G; G {} GPa", gigapascals(each(shear_of_all(all), &Modulus::section)));
  if (test != "wave") return "";
  const std::vector<Rod> rods = rods_of(all);
  std::vector<Modulus> still;
  for (const Rod& rod : rods) still.push_back(rod.still);
  return fmt::format("of a rod whose E is {} GPa by statics: {} of that", gigapascals(each(still, &Modulus::section)),
                     spread_text(wave_over_still(rods)));
}

inline std::string poisson_line(const std::vector<Tested>& all) {
  std::string line = "Poisson's ratio " + spread_text(each(all, &Tested::poisson)) + " in tension";
  const std::vector<Real> with_tension = poisson_by_torsion(all, "tension");
  if (with_tension.empty()) return line;
  line += fmt::format("; E/(2G) - 1 is {} with E of tension", spread_text(with_tension));
  const std::vector<Real> with_bending = poisson_by_torsion(all, "bending");
  return with_bending.empty() ? line : fmt::format("{}, {} with E of bending", line, spread_text(with_bending));
}

inline std::vector<std::string> test_lines(const Plan& plan, const std::vector<Tested>& all) {
  std::vector<std::string> lines;
  const auto row = [&](const std::string& test, const std::string& section, const std::string& carrying,
                       const std::string& remark) {
    std::string line = fmt::format("{:<12} {:<18} {:<18} {}", test, section, carrying, remark);
    lines.push_back(line.substr(0, line.find_last_not_of(' ') + 1));
  };
  row("test", "E, GPa", "E_c, GPa", "");
  for (const char* test : every_test)
    if (const std::vector<Modulus> young = young_of_all(all, test); !young.empty())
      row(test, gigapascals(each(young, &Modulus::section)), gigapascals(each(young, &Modulus::carrying)),
          test_remark(all, test));
  row("core", "", gigapascals(each(all, &Tested::virial)), "stress over strain in the core, in tension");
  lines.push_back(
      fmt::format("E: over the section {}; E_c: over that which carries, the force over the core's stress",
                  plan.through_centres ? "through the centres of the outer elements" : "of the whole sample"));
  lines.push_back(poisson_line(all));
  if (const std::string text = agreement_text(sayings(all)); !text.empty()) lines.push_back(text);
  return lines;
}

/// The same, in the file of parameters.
inline std::string tests_remark(const Plan& plan, const std::vector<Tested>& all) {
  if (all.empty()) return "";
  std::string text = fmt::format("  <!-- With these, {}:\n", all.size() > 1 ? "all samples" : "the first sample");
  for (const std::string& line : test_lines(plan, all)) text += "       " + line + "\n";
  return text.substr(0, text.size() - 1) + " -->\n";
}

inline std::string moduli_json(const std::vector<Modulus>& values) {
  return fmt::format(R"("over_section":{},"over_what_carries":{})", numbers_json(each(values, &Modulus::section)),
                     numbers_json(each(values, &Modulus::carrying)));
}

inline std::string rods_json(const Plan& plan, const std::vector<Rod>& rods) {
  std::vector<Modulus> still;
  for (const Rod& rod : rods) still.push_back(rod.still);
  return fmt::format(
      R"("elements":{},"slenderness":{},"speed":{},"density":{},"share_bound":{},"by_statics":{{{}}},"over_that":{})",
      plan.rod_elements, format_number(plan.slenderness), numbers_json(each(rods, &Rod::speed)),
      numbers_json(each(rods, &Rod::density)), numbers_json(each(rods, &Rod::bound)), moduli_json(still),
      numbers_json(wave_over_still(rods)));
}

/// The entry "tests" of the result.
inline std::string tests_json(const Plan& plan, const std::vector<Tested>& all) {
  std::string text = fmt::format(R"("poisson":{},"virial_in_core":{})", numbers_json(each(all, &Tested::poisson)),
                                 numbers_json(each(all, &Tested::virial)));
  for (const char* test : every_test) {
    const std::vector<Modulus> young = young_of_all(all, test);
    if (young.empty()) continue;
    text += fmt::format(R"(,"{}":{{"young":{{{}}})", test, moduli_json(young));
    if (std::string(test) == "torsion")
      text += fmt::format(R"(,"shear":{{{}}},"poisson_with_tension":{},"poisson_with_bending":{})",
                          moduli_json(shear_of_all(all)), numbers_json(poisson_by_torsion(all, "tension")),
                          numbers_json(poisson_by_torsion(all, "bending")));
    if (std::string(test) == "bending")
      text += fmt::format(R"(,"young_by_turn_of_ends":{})", numbers_json(each(all, &Tested::from_ends)));
    if (std::string(test) == "wave") text += "," + rods_json(plan, rods_of(all));
    text += "}";
  }
  const std::vector<Saying> said = sayings(all);
  return fmt::format(
      R"("tests":{{"lines":["{}"],{},"farthest_from_tension":{{"over_section":{},"over_what_carries":{}}}}})",
      fmt::join(test_lines(plan, all), R"(",")"), text, number_json(farthest(said, &Modulus::section).by),
      number_json(farthest(said, &Modulus::carrying).by));
}

}  // namespace beadwork::calibration
