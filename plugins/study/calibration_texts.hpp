#pragma once
// Figures of several samples, as text and as JSON.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "core/base/text.hpp"
#include "plugins/study/samples.hpp"

namespace beadwork::calibration {

template <class T>
std::vector<Real> each(const std::vector<T>& all, Real T::*member) {
  std::vector<Real> values;
  for (const T& one : all) values.push_back(one.*member);
  return values;
}

/// "0.372 +- 0.004"
inline std::string spread_text(const std::vector<Real>& values, int digits = 4) {
  if (values.empty()) return "not found";
  const Scatter spread = scatter_of(values);
  if (values.size() < 2) return fmt::format("{:.{}g}", spread.mean, digits);
  return fmt::format("{:.{}g} +- {:.1g}", spread.mean, digits, spread.deviation);
}

/// In MPa.
inline std::string stress_text(std::vector<Real> values) {
  for (Real& value : values) value *= 1e-6;
  return spread_text(values) + " MPa";
}

inline Real modulus_of(const Plan& plan, const Elastic& e) { return plan.through_centres ? e.centres : e.box; }
inline std::vector<Real> moduli_of(const Plan& plan, const std::vector<Elastic>& all) {
  return each(all, plan.through_centres ? &Elastic::centres : &Elastic::box);
}

inline std::string number_json(Real value) { return std::isfinite(value) ? format_number(value) : "null"; }

inline std::string numbers_json(const std::vector<Real>& values) {
  const Scatter spread = scatter_of(values);
  std::vector<std::string> samples;
  for (const Real value : values) samples.push_back(number_json(value));
  return fmt::format(R"({{"mean":{},"deviation":{},"samples":[{}]}})",
                     values.empty() ? "null" : number_json(spread.mean), number_json(spread.deviation),
                     fmt::join(samples, ","));
}

}  // namespace beadwork::calibration
