#pragma once
// Numbers that are read from a curve, named as one says them: "largest force", "force at displacement 0.14 um".

#include <optional>
#include <string>

#include "core/base/curve_table.hpp"
#include "core/base/units.hpp"

namespace beadwork {

/// | phrase                                                        | number                                                  |
/// |---|---|
/// | `largest force`                                               | the value that is largest in size                       |
/// | `last force`                                                  | the last value                                          |
/// | `displacement at the largest force`                           | of the row of that value                                |
/// | `force at displacement 0.14 um`                               | between the rows around the first place where it is met |
/// | `displacement where force rises above 0`                      | of the first row above                                  |
/// | `displacement where force rises above 90 percent of its largest` | likewise                                             |
/// | `displacement where force falls below 5 percent of its largest`  | of the first row below behind the largest            |
/// | `slope of force over displacement from 0 um to 0.03 um`       | of the straight line of least squares                   |
/// | `mean force for displacement from 1 mm to 2 mm`               | weighted by the way between the rows   |
struct Reading {
  enum class How { largest, last, at_largest, at, rises, falls, slope, mean };
  How how = How::largest;
  std::string column;       ///< that is read
  std::string against;      ///< the other one, where there is one
  Amount from, to;          ///< `at` and the thresholds have the first only
  bool of_largest = false;  ///< the threshold is a share
  std::string text;
};

/// Nothing if the text is no such phrase, or its bounds are not in ascending order.
std::optional<Reading> parse_reading(const std::string& text);
/// The phrases, for a complaint.
extern const char* const reading_phrases;

/// A number in SI with its dimension, or why there is none.
struct NumberRead {
  enum class Why { read, not_there, not_reached };  ///< not_there: no such column, or of another kind
  Why why = Why::read;
  Quantity number;
  std::string reason;  ///< in words, of what was not read
};

NumberRead read_from(const CurveTable& curve, const Reading& reading);

}  // namespace beadwork
