#pragma once
// How long a run will be: what the ends of its stages tell beforehand.

#include <optional>
#include <span>

#include "core/base/headway.hpp"
#include "core/loop/scene.hpp"

namespace beadwork {

/// Steps of that length after which a stage ends at the latest, if it begins at time `began` [s]; nothing if only its
/// conditions can tell.
std::optional<Real> steps_of(const Until& until, std::span<const Constraint> constraints, Real began, Real time_step);

/// How far a run has come at this moment, over all stages; no share where the end of one of them is not known
/// beforehand. `constraints` are those of the present stage.
Headway headway_of(const Scene& scene, const Moment& moment, std::span<const Constraint> constraints);

}  // namespace beadwork
