#pragma once
// Typed readers for one attribute. Each returns nothing and complains, at the exact place, if the text is not
// what is wanted. `unit` is the unit in which the reader's owner thinks ("J/m2", "1"): only its dimension and its name
// in messages matter, results are always in SI.
//
// A value is a number with its unit, "13.5 mm", or ${expression}; "${2*n} mm" gives a plain result its unit.
// In a list a unit holds for the number before it and for all bare numbers before that: "14 14 28 um". A 0 needs none.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/complaints.hpp"
#include "core/base/types.hpp"
#include "core/base/units.hpp"
#include "core/deck/deck.hpp"

namespace beadwork {

std::optional<double> read_quantity(const Attribute& attribute, std::string_view unit, const Scope& scope,
                                    Complaints& complaints);
std::optional<Vec3> read_vector(const Attribute& attribute, std::string_view unit, const Scope& scope,
                                Complaints& complaints);
/// Rows joined by commas, each with one value for each of the units: "0 s 0 m/s, 1 ms 2 m/s".
std::optional<std::vector<std::vector<double>>> read_rows(const Attribute& attribute,
                                                          const std::vector<std::string>& units, const Scope& scope,
                                                          Complaints& complaints);
std::optional<std::int64_t> read_integer(const Attribute& attribute, const Scope& scope, Complaints& complaints);
std::optional<bool> read_boolean(const Attribute& attribute, const Scope& scope,
                                 Complaints& complaints);  ///< yes no true false
/// The text with every ${} replaced: ${name} by the text of the parameter, an expression by its value. Not
/// empty.
std::optional<std::string> read_text(const Attribute& attribute, const Scope& scope, Complaints& complaints);
std::optional<std::vector<std::string>> read_words(const Attribute& attribute, const Scope& scope,
                                                   Complaints& complaints);
/// Paths of files, found beside the file in which the attribute stands: words, or 'in quotes' where one holds
/// blanks.
std::optional<std::vector<std::string>> read_paths(const Attribute& attribute, const Scope& scope,
                                                   Complaints& complaints);
std::optional<std::string> read_choice(const Attribute& attribute, const std::vector<std::string>& allowed,
                                       const Scope& scope, Complaints& complaints);

/// Paths as read_paths takes them.
std::string text_of_paths(const std::vector<std::string>& paths);

/// What a message says that an attribute holds: its text with every ${} replaced, or as it stands where that does not
/// work.
std::string shown_value(const Attribute& attribute, const Scope& scope);
/// How a message names what a unit stands for: `a length such as "1 mm"`, `a plain number`.
std::string wanted_by(std::string_view unit);

/// read_text on a text that is no attribute (a parameter's value).
std::optional<std::string> text_of(std::string_view text, const Location& start, const Scope& scope,
                                   Complaints& complaints);

}  // namespace beadwork
