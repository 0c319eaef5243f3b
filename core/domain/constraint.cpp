#include "core/domain/constraint.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/blame.hpp"
#include "core/base/failure.hpp"

namespace beadwork {

PrescribedMotion Constraint::at(Real time) const {
  const auto whose = [&] { return place + ": error: plugin " + by; };
  PrescribedMotion now;
  try {
    now = motion(time - began);
  } catch (...) {
    blame(whose() + " failed in the motion that it prescribes");
  }
  if (!std::isfinite(now.displacement) || !std::isfinite(now.velocity) || !std::isfinite(now.acceleration))
    throw PhysicsFailure(
        fmt::format("{} prescribes at {} s a displacement of {} m, a velocity of {} m/s and an acceleration of {} "
                    "m/s2: they must be finite",
                    whose(), time, now.displacement, now.velocity, now.acceleration));
  return now;
}

}  // namespace beadwork
