#pragma once
// Waves along rods of the bonds that were found: a rod is packed as the samples are, stretched by statics, and struck.

#include "core/plugin/study.hpp"
#include "plugins/study/calibration_texts.hpp"
#include "plugins/study/pulls.hpp"
#include "plugins/study/test_decks.hpp"

namespace beadwork::calibration {

class RodTests {
 public:
  RodTests(const Plan& plan, const StudyDesk& desk, const Found& found)
      : plan_(plan),
        rod_(plan, plan.rod_elements, plan.slenderness),
        pulls_(plan, desk.folder, "static", rod_),
        desk_(desk),
        found_(found) {}

  void add_to(std::vector<Tested>& tested) {
    desk_.write("wave.xml", wave_deck());
    std::vector<Trial> trials;
    for (Tested& one : tested) trials.push_back({&one, {one.seed, "", 0, 0, 0, 0, 0}, {}});
    run(
        trials, [&](const Trial& trial) { return packing_errand(trial.packing.seed); },
        [&](Trial& trial, const Outcome& packed) {
          trial.packing.file = (packed.folder / "run.h5").lexically_relative(desk_.folder).string();
        });
    run(
        trials,
        [&](const Trial& trial) {
          return pulls_.errand(trial.packing, {found_.ratio, found_.young, first_axis(plan_.decks)});
        },
        [&](Trial& trial, const Outcome& pulled) {
          trial.elastic = pulls_.read(pulled, first_axis(plan_.decks), found_.young);
        });
    run(
        trials, [&](const Trial& trial) { return wave_errand(trial.packing, trial.elastic); },
        [&](Trial& trial, const Outcome& struck) { trial.of->rod = read(struck, trial.elastic); });
  }

 private:
  static constexpr Real strain_ = 1e-6;  // of the rod, about
  // Of the transit: the front is that long, of the rod's length. It has passed the last slice whole when what the other
  // end throws back is there, and is so long that a rod is thin to it.
  static constexpr Real rise_ = 0.4, time_ = 1.25;

  struct Trial {
    Tested* of;
    Packed packing;
    Elastic elastic;
  };

  // What does not come to its end is told, and goes no further.
  template <class Make, class Take>
  void run(std::vector<Trial>& trials, const Make& make, const Take& take) {
    std::vector<Errand> errands;
    for (const Trial& trial : trials) {
      errands.push_back(make(trial));
      errands.back().name = "rod-" + errands.back().name;
    }
    const std::vector<Outcome> outcomes = desk_.runner.run(errands);
    std::vector<Trial> whole;
    for (std::size_t k = 0; k < outcomes.size(); ++k)
      if (outcomes[k].is_done()) {
        take(trials[k], outcomes[k]);
        whole.push_back(trials[k]);
      } else {
        desk_.log.warn(fmt::format("{} is left out: {}", errands[k].name, outcomes[k].reason));
      }
    trials = whole;
  }

  Errand packing_errand(std::int64_t seed) const {
    Errand errand{fmt::format("packing,seed={}", seed), desk_.folder / "packing.xml", rod_.size()};
    add(errand.overrides, {{"seed", std::to_string(seed)}});
    return errand;
  }

  Errand wave_errand(const Packed& packing, const Elastic& elastic) const {
    Errand errand{fmt::format("wave,seed={},radius-ratio={}", packing.seed, format_number(found_.ratio)),
                  desk_.folder / "wave.xml", rod_.of(packing, found_.ratio, found_.young)};
    const Real transit = rod_.extent() / std::sqrt(elastic.box * found_.young / 640);
    add(errand.overrides, {{"stretch", length_text(strain_ * rod_.extent())},
                           {"rise", time_text(rise_ * transit)},
                           {"time", time_text(time_ * transit)}});
    return errand;
  }

  // c^2 is the stiffness E A over the mass of a length, of what is bound and moves: the section that is named counts for the wave as for statics.
  Rod read(const Outcome& struck, const Elastic& elastic) const {
    const auto passing = [&](const char* gauge) {
      const std::string shift = fmt::format("{}-shift", gauge);
      return passing_time(struck.column(shift, "time"), struck.column(shift, "mean"), 0.5 * strain_ * rod_.extent());
    };
    Rod rod;
    rod.speed = (first(struck, "three-quarters-place") - first(struck, "quarter-place")) /
                (passing("three-quarters") - passing("quarter"));
    rod.density = last(struck.column("mass", "sum")) / (0.5 * rod_.extent() * rod_.section(false).area);
    rod.bound = last(struck.column("bound", "count")) / last(struck.column("all", "count"));
    const Real mass_of_length = rod.bound * rod.density * rod_.section(false).area;
    const Real section = rod_.section(plan_.through_centres).area;
    const Real by_wave = rod.speed * rod.speed * mass_of_length, still = modulus_of(plan_, elastic) * found_.young;
    rod.wave = {by_wave / section, by_wave / elastic.carrying};
    rod.still = {still, still * section / elastic.carrying};
    return rod;
  }

  const Plan& plan_;
  Samples rod_;
  Pulls pulls_;
  const StudyDesk& desk_;
  const Found& found_;
};

}  // namespace beadwork::calibration
