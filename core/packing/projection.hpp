#pragma once
// From an overlapping arrangement to a near one in which the same contacts just touch.

#include <functional>
#include <vector>

#include "core/packing/crowd.hpp"

namespace beadwork::packing {

struct RadiusBounds {
  Real low, high;  ///< radii stay in [low, high] times their mean
  Real change;     ///< largest relative change of a radius, apart from the change of the mean
};

/// Each contact is one equation, gap(x_i, x_j, R_i, R_j) = 0. With positions and radii as unknowns there are
/// more unknowns (4 an element) than contacts (about 3.3 an element), and Newton's method with the smallest
/// change that solves the linear equations converges in a few rounds. A pair that comes to overlap on the way
/// joins the equations; a contact that opens and cannot be closed, since too many others hold its elements,
/// is given up.
/// `told` hears the largest overlap before each round.
void project(
    Crowd&, Neighbours&, const RadiusBounds&, Real overlap, const std::function<void(Real)>& told = [](Real) {});

}  // namespace beadwork::packing
