#pragma once
// The ways in which a bond is tried: what is moved, and how far.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "workbench/law/family.hpp"

namespace beadwork::law {

/// One number s tells how far the two elements have gone; every degree of freedom that does not move with it is held.
struct Mode {
  std::string name;
  std::string motion, unit;     ///< s: "opening" in m, "bend" in rad
  std::string load, load_unit;  ///< what does work on it: "force" in N, "moment" in N.m
  /// Of x, y, z and the turns about them, of the first element and then of the second, for a unit of s.
  std::array<Real, 12> moves{};
  Real sign = 1;   ///< of s
  Real look = 1;   ///< how far failure is looked for: a share of the distance of the centres, or an angle [rad]
  Real show = 1;   ///< how far one goes that does not fail
  Real press = 0;  ///< overlap from the beginning, as a share of that distance

  bool is_turn() const { return unit == "rad"; }
};

/// How far at most, as the command line says: in the place of `look` and `show`.
struct Reach {
  std::optional<Real> strain, angle;
};

/// Those that tell something of this law: without turns there is no bending and no torsion.
std::vector<Mode> modes_of(const Family& family, const Reach& reach);

/// Why there are no others; "" where all are there.
std::string missing_modes(const Family& family);

}  // namespace beadwork::law
