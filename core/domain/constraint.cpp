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
        fmt::format("{} prescribes at {} s a {} of {} {}, a velocity of {} {}/s and an acceleration of {} {}/s2: they "
                    "must be finite",
                    whose(), time, turns() ? "turn" : "displacement", now.displacement, turns() ? "rad" : "m",
                    now.velocity, turns() ? "rad" : "m", now.acceleration, turns() ? "rad" : "m"));
  return now;
}

unsigned Constraint::prescribes() const {
  if (!body) return 1u << axis;
  return body->along ? 0b111111u : 0b111111u & ~(1u << axis % 3);
}

Vec3 Constraint::force() const {
  if (body) return {body->forces[0], body->forces[1], body->forces[2]};
  return turns() ? Vec3(Vec3::Zero()) : Vec3(reaction * Vec3::Unit(axis));
}

Real Constraint::load() const {
  if (!turns()) return reaction;
  return driven && lever > 0 ? reaction / lever : 0;
}

}  // namespace beadwork
