#pragma once
// Points on the way of a stage: a time, a number of steps or a displacement of what is pulled, from its start on.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/complaints.hpp"
#include "core/deck/deck.hpp"
#include "core/deck/expression.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork {

/// Displacement [m] between two times and force [N] of what is driven on a set, largest in magnitude over its driven
/// constraints; on no set: over all.
Real driven_displacement(std::span<const Constraint> constraints, const std::string& set, Real from, Real to);
Real driven_force(std::span<const Constraint> constraints, const std::string& set);
/// The largest displacement [m] that these constraints ever give of a set, or of any; nothing where none is driven.
std::optional<Real> reach_of(std::span<const Constraint> constraints, const std::string& set);

struct Mark {
  enum class What { time, steps, displacement };
  What what = What::time;
  Real value = 0;
  std::string text;  ///< as the deck gives it
  Location at;

  /// What time, step and displacement are called in conditions, in the order of What.
  static const std::vector<Variable>& variables();
  /// The mark that a quantity stands for; nothing if it is none of the three, or below 0, which is complained of.
  /// The complaint says: 'attribute' wants `wanted`, got "text".
  static std::optional<Mark> of(const Expression& quantity, const std::string& attribute, const std::string& wanted,
                                const std::string& text, const Location& at, Complaints& complaints);
  /// "0.3 mm, 1 ms, 5000, end": what can be read; of the rest it is complained. The end needs no mark: every watcher
  /// looks then.
  static std::vector<Mark> list(const std::string& text, const std::string& attribute, const Location& at,
                                const Scope& scope, Complaints& complaints);
  bool reached(const Moment& moment, std::span<const Constraint> constraints) const;
  /// When it comes, if that is after the present and up to `until` [s]; of a number of steps nobody knows.
  std::optional<Real> time(const Moment& moment, std::span<const Constraint> constraints, Real until) const;
  std::string si() const;     ///< "0.0003 m", as any deck may give it
  std::string words() const;  ///< what is reached: "0.3 mm of displacement", "5000 steps"
  /// Why it can never come under these constraints, or "".
  std::string why_never(std::span<const Constraint> constraints) const;
};

}  // namespace beadwork
