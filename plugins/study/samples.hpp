#pragma once
// Sizes of the samples, and what their decks are told.

#include <cmath>
#include <numbers>

#include "core/base/text.hpp"
#include "core/mechanics/section.hpp"
#include "core/plugin/runner.hpp"
#include "plugins/study/calibration_plan.hpp"

namespace beadwork::calibration {

using Overrides = std::vector<Override>;

inline constexpr Real transits = 40;   ///< of waves along a sample, while it is stretched: slow where there is inertia
inline constexpr int significant = 4;  ///< of what is found

inline void add(Overrides& all, const Overrides& more) { all.insert(all.end(), more.begin(), more.end()); }

/// To so many digits: what stands in the file is what was run.
inline Real rounded(Real value, int to_digits) {
  if (value == 0) return 0;
  const Real scale = std::pow(10.0, to_digits - 1 - std::floor(std::log10(std::abs(value))));
  return std::round(value * scale) / scale;
}
inline std::string length_text(Real metres) { return format_number(rounded(metres * 1e3, significant)) + " mm"; }
inline std::string time_text(Real seconds) { return format_number(rounded(seconds * 1e6, significant)) + " us"; }

/// Width of a box or of a cylinder [m]; as size.xml has it, where the mean radius is 1 mm.
inline Real width_of(bool is_cylinder, std::int64_t elements, Real slender) {
  constexpr Real phi = 0.64, radius = 1e-3;
  return std::cbrt(static_cast<Real>(elements) * (is_cylinder ? 16 : 4 * std::numbers::pi) / (3 * phi * slender)) *
         radius;
}

class Samples {
 public:
  explicit Samples(const Plan& plan) : Samples(plan, plan.decks.elements, slenderness(plan.decks.is_cylinder)) {}
  Samples(const Plan& plan, std::int64_t elements, Real slender)
      : plan_(plan),
        elements_(elements),
        slender_(slender),
        width_(width_of(plan.decks.is_cylinder, elements, slender)),
        extent_(slender * width_) {}

  Real width() const { return width_; }
  /// Along the axis [m].
  Real extent() const { return extent_; }
  /// Of waves along it, with the decks' density [s].
  Real transit() const { return extent() / std::sqrt(plan_.material.young / 640); }

  /// To the centres of the outer elements, or the whole.
  Section section(bool through_centres) const {
    const Real width = width_ - (through_centres ? 2e-3 : 0);
    return of_area((plan_.decks.is_cylinder ? std::numbers::pi / 4 : 1) * width * width);
  }
  Section of_area(Real area) const { return plan_.decks.is_cylinder ? round_section(area) : square_section(area); }

  Overrides of(const Packed& packing, Real ratio, Real young) const {
    Overrides all{{"packing", packing.file},
                  {"radius-ratio", format_number(ratio)},
                  {"young", format_number(young) + " Pa"},
                  {"poisson", format_number(plan_.bond_poisson)}};
    add(all, size());
    return all;
  }
  /// What size.xml is to be told of it.
  Overrides size() const {
    if (elements_ == plan_.decks.elements && slender_ == slenderness(plan_.decks.is_cylinder)) return {};
    return {{"elements", std::to_string(elements_)}, {"slender", format_number(slender_)}};
  }

 private:
  const Plan& plan_;
  std::int64_t elements_;
  Real slender_, width_, extent_;
};

}  // namespace beadwork::calibration
