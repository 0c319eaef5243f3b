#pragma once
// What else a sample of the bonds that were found is put to: pressed, bent, twisted, and its rod struck. Each test tells
// the stiffness in a way of its own.   docs/theory/calibration.md

#include "core/plugin/study.hpp"
#include "plugins/study/calibration_texts.hpp"
#include "plugins/study/pulls.hpp"
#include "plugins/study/rod_tests.hpp"
#include "plugins/study/test_decks.hpp"

namespace beadwork::calibration {

class MechanicalTests {
 public:
  MechanicalTests(const Plan& plan, const StudyDesk& desk, const Found& found)
      : plan_(plan), samples_(plan), pulls_(plan, desk.folder, "static"), desk_(desk), found_(found) {}

  /// To be called first.
  std::vector<Tested> all() {
    if (plan_.decks.by != "static") desk_.write(pulls_.deck(), elastic_deck("static"));
    desk_.write("gauges.xml", gauges_deck());
    desk_.write("bending.xml", bending_deck(plan_.decks));
    desk_.write("torsion.xml", torsion_deck());
    for (std::size_t k = 0; k < (plan_.all_are_tested ? found_.packings.size() : 1); ++k)
      tested_.push_back({found_.packings[k].seed});
    pull();
    if (wants("compression")) press();
    if (wants("bending")) bend();
    if (wants("torsion")) twist();
    if (wants("wave")) RodTests(plan_, desk_, found_).add_to(tested_);
    return tested_;
  }

  /// E of the first sample where bonds are half as stiff, as stiff as was found, and stiffer by half: by runs of their
  /// own, as no sample knows of proportion.
  std::vector<std::array<Real, 2>> line() {
    std::vector<Errand> errands;
    std::vector<Real> young;
    for (const Real share : {0.5, 1.5}) {
      young.push_back(rounded(share * found_.young, significant));
      errands.push_back(pulls_.errand(packing(0), {found_.ratio, young.back(), axis()}));
    }
    const std::vector<Outcome> outcomes = desk_.runner.run(errands);
    std::map<Real, Real> points;
    for (std::size_t k = 0; k < outcomes.size(); ++k)
      if (outcomes[k].is_done())
        points[young[k]] = modulus_of(plan_, pulls_.read(outcomes[k], axis(), young[k])) * young[k];
      else
        warn_left_out(errands[k], outcomes[k]);
    if (const auto here = tested_.front().moduli.find("tension"); here != tested_.front().moduli.end())
      points[found_.young] = here->second.section;
    std::erase_if(points, [](const auto& point) { return !std::isfinite(point.second); });
    std::vector<std::array<Real, 2>> line;
    for (const auto& [of_bonds, of_solid] : points) line.push_back({of_bonds, of_solid});
    return line;
  }

 private:
  bool wants(const char* test) const { return plan_.tests.contains(test); }
  std::string axis() const { return first_axis(plan_.decks); }
  const Packed& packing(std::size_t k) const { return found_.packings[k]; }

  // Runs one errand for each sample, and hands over what came to its end.
  template <class MakeErrand, class Read>
  void on_each(const MakeErrand& make, const Read& read) {
    std::vector<Errand> errands;
    for (std::size_t k = 0; k < tested_.size(); ++k) errands.push_back(make(k));
    const std::vector<Outcome> outcomes = desk_.runner.run(errands);
    for (std::size_t k = 0; k < outcomes.size(); ++k)
      if (outcomes[k].is_done())
        read(k, outcomes[k]);
      else
        warn_left_out(errands[k], outcomes[k]);
  }
  void warn_left_out(const Errand& errand, const Outcome& outcome) const {
    desk_.log.warn(fmt::format("{} is left out: {}", errand.name, outcome.reason));
  }

  // Without it no other test says much: it tells Poisson's ratio, and the section that carries.
  void pull() {
    carrying_.assign(tested_.size(), unknown);
    on_each(
        [&](std::size_t k) {
          return pulls_.errand(packing(k), {found_.ratio, found_.young, axis()});
        },
        [&](std::size_t k, const Outcome& outcome) {
          const Elastic one = pulls_.read(outcome, axis(), found_.young);
          carrying_[k] = one.carrying;
          tested_[k].poisson = one.poisson;
          tested_[k].virial = one.virial * found_.young;
          tested_[k].moduli["tension"] = of_pull(one, k);
        });
  }

  void press() {
    on_each(
        [&](std::size_t k) {
          return pulls_.errand(packing(k), {found_.ratio, found_.young, axis(), true});
        },
        [&](std::size_t k, const Outcome& outcome) {
          tested_[k].moduli["compression"] = of_pull(pulls_.read(outcome, axis(), found_.young), k);
        });
  }

  Modulus of_pull(const Elastic& one, std::size_t k) const {
    const Real over_section = modulus_of(plan_, one) * found_.young;
    return {over_section, over_section * samples_.section(plan_.through_centres).area / carrying_[k]};
  }

  Errand plain_errand(const char* test, std::size_t k) const {
    return {fmt::format("{},seed={},radius-ratio={}", test, packing(k).seed, format_number(found_.ratio)),
            desk_.folder / fmt::format("{}.xml", test), samples_.of(packing(k), found_.ratio, found_.young)};
  }

  // E = M/(I kappa), with the curvature of the middle half, where the ends are far.
  void bend() {
    on_each([&](std::size_t k) { return plain_errand("bending", k); },
            [&](std::size_t k, const Outcome& outcome) {
              const Real moment = std::abs(last(outcome.column("torque", "torque")));
              const Real apart = first(outcome, "three-quarters-place") - first(outcome, "quarter-place");
              const Real curvature = std::abs(tilt(outcome, "three-quarters") - tilt(outcome, "quarter")) / apart;
              tested_[k].moduli["bending"] = over(moment / curvature, &Section::second_moment, k);
              const Real turn = 2 * std::abs(last(outcome.column("torque", "turn")));  // each end by half of it
              tested_[k].from_ends =
                  over(moment * length_between_grips(outcome) / turn, &Section::second_moment, k).section;
            });
  }

  // By how much a slice has turned: its half above has gone farther along the axis than that below.
  static Real tilt(const Outcome& outcome, const std::string& slice) {
    const std::string above = slice + "-above", below = slice + "-below";
    return (last(outcome.column(above + "-shift", "mean")) - last(outcome.column(below + "-shift", "mean"))) /
           (first(outcome, above + "-place") - first(outcome, below + "-place"));
  }

  // G = T L/(J phi).
  void twist() {
    on_each([&](std::size_t k) { return plain_errand("torsion", k); },
            [&](std::size_t k, const Outcome& outcome) {
              const Real torque = last(outcome.column("torque", "torque"));
              const Real turn = 2 * last(outcome.column("torque", "turn"));
              tested_[k].moduli["torsion"] = over(torque * length_between_grips(outcome) / turn, &Section::torsion, k);
            });
  }

  Modulus over(Real stiffness, Real Section::*moment, std::size_t k) const {
    return {stiffness / samples_.section(plan_.through_centres).*moment,
            stiffness / samples_.of_area(carrying_[k]).*moment};
  }

  const Plan& plan_;
  Samples samples_;
  Pulls pulls_;
  const StudyDesk& desk_;
  const Found& found_;
  std::vector<Tested> tested_;
  std::vector<Real> carrying_;  ///< sections, by sample [m^2]
};

}  // namespace beadwork::calibration
