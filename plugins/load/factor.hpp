#pragma once
// A number that changes with time, by which a load is multiplied.

#include <fmt/format.h>

#include <cmath>

#include "core/base/failure.hpp"
#include "core/base/units.hpp"
#include "core/plugin/param.hpp"

namespace beadwork {

inline ParamInfo factor_info(const std::string& of) {
  return {
      .name = "factor",
      .doc = fmt::format("Number by which {} multiplied: a formula in t, the time since the load began to act, such "
                         "as \"sin(2*pi * t / 1 ms)\"",
                         of),
      .fallback = "1",
      .variables = {{"t", find_unit("s")->dimension}}};
}

/// Throws PhysicsFailure where it is no number.
inline Real factor_at(const Param<Formula>& factor, Real since) {
  const Real value = (*factor)({&since, 1});
  if (std::isfinite(value)) return value;
  throw PhysicsFailure(fmt::format("{}: error: 'factor' is {} at t = {} s", factor.at().where(),
                                   std::isnan(value) ? "no number" : "infinite", since));
}

}  // namespace beadwork
