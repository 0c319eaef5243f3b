#pragma once
// Sizes of the samples, and what their decks are told.

#include <cmath>
#include <numbers>

#include "core/base/text.hpp"
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

class Samples {
 public:
  explicit Samples(const Plan& plan) : plan_(plan) {}

  /// Along the axis [m]; as size.xml has it.
  Real extent() const {
    const Real n = static_cast<Real>(plan_.decks.elements), phi = 0.64, radius = 1e-3;
    return plan_.decks.is_cylinder ? 2 * std::cbrt(n * 8 / (3 * phi)) * radius
                                   : std::cbrt(n * 4 * std::numbers::pi / (3 * phi)) * radius;
  }
  /// Of waves along it, with the decks' density [s].
  Real transit() const { return extent() / std::sqrt(plan_.material.young / 640); }

  /// To the centres of the outer elements, or the whole [m^2].
  Real section(bool through_centres) const {
    const Real side = plan_.decks.is_cylinder ? extent() / 2 : extent();
    const Real width = side - (through_centres ? 2e-3 : 0);
    return (plan_.decks.is_cylinder ? std::numbers::pi / 4 : 1) * width * width;
  }

  Overrides of(const Packed& packing, Real ratio, Real young) const {
    return {{"packing", packing.file},
            {"radius-ratio", format_number(ratio)},
            {"young", format_number(young) + " Pa"},
            {"poisson", format_number(plan_.bond_poisson)}};
  }

 private:
  const Plan& plan_;
};

}  // namespace beadwork::calibration
