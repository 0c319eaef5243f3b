#pragma once
// Which names of units a deck may use. UDUNITS knows hundreds, takes them in any case and with any prefix: "ton" is a
// US short ton there, "Gpa" or "nmi" may come out as something that nobody meant. So each of its names has been looked
// at once, and only those pass that a reader of this field cannot take for another unit.

#include <string>
#include <string_view>
#include <vector>

namespace beadwork {

struct UnitName {
  enum class Verdict { unknown, accepted, refused };
  Verdict verdict = Verdict::unknown;
  std::string instead;  ///< of a refused one: why, and what to write
};

/// What a name without exponents, spelt exactly so, is: accepted, if it stands in the list by itself or with one
/// prefix.
UnitName unit_name(std::string_view name);

/// Every accepted spelling, prefixes and plurals too.
std::vector<std::string> accepted_unit_names();

}  // namespace beadwork
