#pragma once
// Samples that are stretched or pressed by so little that they are linear: the runs, and what they tell.

#include <filesystem>
#include <limits>

#include "plugins/study/samples.hpp"

namespace beadwork::calibration {

inline constexpr Real unknown = std::numeric_limits<Real>::quiet_NaN();

inline Real last(std::span<const Real> values) { return values.empty() ? unknown : values.back(); }

/// What a sensor of a mean told at the beginning.
inline Real first(const Outcome& outcome, const std::string& sensor) {
  const auto values = outcome.column(sensor, "mean");
  return values.empty() ? unknown : values[0];
}

/// Between the mean places of the grips at the beginning [m].
inline Real length_between_grips(const Outcome& outcome) { return first(outcome, "far") - first(outcome, "near"); }

class Pulls {
 public:
  /// `folder`: of the decks. `by`: the mover.
  Pulls(const Plan& plan, std::filesystem::path folder, const std::string& by)
      : Pulls(plan, std::move(folder), by, Samples(plan)) {}
  Pulls(const Plan& plan, std::filesystem::path folder, const std::string& by, const Samples& samples)
      : plan_(plan),
        samples_(samples),
        folder_(std::move(folder)),
        is_static_(by == "static"),
        deck_(by == plan.decks.by ? "elastic.xml" : "elastic-by-" + by + ".xml") {}

  const std::string& deck() const { return deck_; }

  struct Pull {
    Real ratio, young;  ///< of the bonds
    std::string axis;
    bool presses = false;
  };

  Errand errand(const Packed& packing, const Pull& pull) const {
    Errand errand{fmt::format("{}-{},seed={},radius-ratio={}", pull.presses ? "compression" : "elastic", pull.axis,
                              packing.seed, format_number(pull.ratio)),
                  folder_ / deck_, samples_.of(packing, pull.ratio, pull.young)};
    add(errand.overrides,
        {{"stretch", length_text(strain() * samples_.extent())}, {"time", time_text(transits * samples_.transit())}});
    if (pull.axis != first_axis(plan_.decks)) add(errand.overrides, turned_to(pull.axis));
    if (pull.presses) add(errand.overrides, {{"sense", "-1"}});
    return errand;
  }

  /// `young`: of the bonds.
  Elastic read(const Outcome& outcome, const std::string& axis, Real young) const {
    const Real force = last(outcome.column("force", "force")), stretch = last(outcome.column("force", "displacement"));
    const auto core = [&](const char* what, char a) {
      return last(outcome.column("core", fmt::format("{}-{}{}", what, a, a)));
    };
    Real strain = 0, stress = 0, lateral_strain = 0, lateral_stress = 0;
    for (const char a : {'x', 'y', 'z'}) {
      const bool is_along = a == axis[0];
      (is_along ? strain : lateral_strain) += core("strain", a) / (is_along ? 1 : 2);
      (is_along ? stress : lateral_stress) += core("stress", a) / (is_along ? 1 : 2);
    }
    const Real modulus = force * length_between_grips(outcome) / stretch / young;
    return {-lateral_strain / strain,
            modulus / samples_.section(true).area,
            modulus / samples_.section(false).area,
            stress / strain / young,
            lateral_stress / stress,
            force / stress};
  }

 private:
  // Small, so that they are linear; above what waves leave behind where there is inertia.
  Real strain() const { return is_static_ ? 1e-6 : 1e-4; }

  static Overrides turned_to(const std::string& axis) {
    return {{"axis", axis},
            {"others", axis == "x"   ? "y z"
                       : axis == "y" ? "x z"
                                     : "x y"},
            {"turns", "r" + axis},
            {"nx", axis == "x" ? "1" : "0"},
            {"ny", axis == "y" ? "1" : "0"},
            {"nz", axis == "z" ? "1" : "0"}};
  }

  const Plan& plan_;
  Samples samples_;
  std::filesystem::path folder_;
  bool is_static_;
  std::string deck_;
};

}  // namespace beadwork::calibration
