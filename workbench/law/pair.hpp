#pragma once
// Scenes of two elements and one bond between them: ordinary decks, which anybody can look at and run by hand.

#include <string>

#include "workbench/law/mode.hpp"

namespace beadwork::law {

/// The two elements.
struct Pair {
  Real radius1 = 0, radius2 = 0;  ///< [m]
  Real distance() const { return radius1 + radius2; }
  /// What a share of a mode's reach is a share of.
  Real scale(const Mode& mode) const { return mode.is_turn() ? 1 : distance(); }
};

/// How fast s grows: by straight lines between the rows of a table, or, without one, exponentially.
struct Course {
  std::vector<std::array<Real, 2>> table = {};  ///< time [s], rate of s
  Real first_rate = 0, growth = 0;              ///< rate = first_rate exp(growth t)
  Real step = 1, end = 1;                       ///< of time [s]
};

/// Ever further, by equal factors, from far below to all that the mode looks at.
Course search_course(const Mode& mode, const Pair& pair);
/// Forth to each of these and back to nothing, slowly about both ends.
Course cycles_course(const std::vector<Real>& amplitudes);

/// The deck. `about` stands in a comment.
std::string pair_deck(const Scene& scene, const Family& family, const Mode& mode, const Pair& pair,
                      const Course& course, const std::string& name, const std::string& about);

}  // namespace beadwork::law
