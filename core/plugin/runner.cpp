#include "core/plugin/runner.hpp"

#include <limits>

namespace beadwork {

std::span<const Real> Outcome::column(const std::string& curve, const std::string& name) const {
  const auto found = curves.find(curve);
  const CurveValues* values = found == curves.end() ? nullptr : found->second.find(name);
  return values ? std::span<const Real>(values->values) : std::span<const Real>();
}

Real Outcome::number(const std::string& name) const {
  const auto found = numbers.find(name);
  return found == numbers.end() ? std::numeric_limits<Real>::quiet_NaN() : found->second;
}

}  // namespace beadwork
