#pragma once
// What plugins hand over is looked at where it comes in: a number that is none, or a row that is not there, is blamed
// on the plugin that gave it, and not on whoever stumbles over it later.

#include <span>

#include "core/plugin/kinds.hpp"

namespace beadwork {

/// After a filling plugin has worked: places are finite; radii, masses and moments of inertia finite and > 0; sets hold
/// rows of elements, ascending. Throws PhysicsFailure.
void check_elements(const Filler& by, const Domain& domain);

/// Rows of a table of `size` rows. Throws PhysicsFailure that names the plugin, its step, and what they are ("bonds
/// that fail").
void check_rows(std::span<const Index> rows, Index size, const char* what, const Plugin& by, const Moment& moment);

/// The set of a constraint is there, its axis one of six, and its motion is given. Throws PhysicsFailure.
void check_constraint(const Constraint& constraint, const Domain& domain, const Plugin& by);

}  // namespace beadwork
