#pragma once
// The largest utilisation that a criterion has found so far, and where: it tells how near to breaking a run came that broke nothing.

#include <string>

#include "core/plugin/kinds.hpp"

namespace beadwork {

/// Numbers only, so that it is kept in checkpoints as columns of the scene.
struct LargestUse {
  Real value = 0;
  Real time = 0;  ///< [s]
  Real step = 0;
  Real bond = -1;               ///< id; -1 before there is any
  Real first = -1, second = -1; ///< ids of its elements
  Real x = 0, y = 0, z = 0;     ///< its middle [m]

  bool is_there() const { return bond >= 0; }
  /// Takes what a criterion has found, where it is larger. To be called before anything breaks of it, while rows stand as they were judged.
  void note(const Verdict& verdict, const Domain& domain, const BondTable& table, const Moment& moment);

  /// f(name, number, unit) for each of the numbers.
  template <class F>
  void each(const F& f) {
    f("value", value, "1"), f("time", time, "s"), f("step", step, "1"), f("bond", bond, "1"), f("first", first, "1"), f("second", second, "1");
    f("x", x, "m"), f("y", y, "m"), f("z", z, "m");
  }
};

/// "largest utilisation of <bond-stress of="resin"> (axial): 0.873 at step 580 (1.16e-04 s), bond 7 between elements 3 and 4, at ..."
std::string sentence(const LargestUse& use, const Failure& failure);

}  // namespace beadwork
