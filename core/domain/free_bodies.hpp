#pragma once
// Bodies that hang together by bonds and that no load holds as a whole.        docs/theory/quasi-static.md

#include <cstdint>
#include <span>
#include <vector>

#include "core/domain/constraint.hpp"
#include "core/domain/domain.hpp"
#include "core/mechanics/rigid_modes.hpp"

namespace beadwork {

struct FreeBody {
  std::vector<Index> members;  ///< ascending
  Vec3 centre;                 ///< of mass [m]
  Real length;                 ///< of the body, by which turns are made lengths [m]
  RigidModes modes;            ///< orthonormal: what it is free to do
};

/// Bodies of two elements and more that are free in some way, the largest first, as they are bonded by `tables` and held
/// by `constraints` at this step; `turning`: elements have orientations.
std::vector<FreeBody> free_bodies(const Domain& domain, std::span<const BondTable* const> tables,
                                  std::span<const Constraint> constraints, bool turning, std::int64_t step);

}  // namespace beadwork
