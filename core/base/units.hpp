#pragma once
// Quantities and their units. The names of units are those of UDUNITS-2 that have one reading (unit_names.hpp); inside
// the program every value is in SI.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace beadwork {

/// Exponents of the SI base units. Angles are plain numbers. Fractions are allowed (Pa.m^0.5).
struct Dimension {
  std::array<double, 7> exponents{};  ///< m, kg, s, A, K, mol, cd

  bool is_plain() const;     ///< a number without a unit
  std::string name() const;  ///< an SI unit that find_unit understands: "Pa", "kg.m/s", "1"
};
bool operator==(const Dimension& a, const Dimension& b);
Dimension operator*(const Dimension& a, const Dimension& b);
Dimension operator/(const Dimension& a, const Dimension& b);
Dimension power(const Dimension& a, double exponent);

/// A value in SI units.
struct Quantity {
  double value = 0;
  Dimension dimension;
};

struct Unit {
  double scale = 1;  ///< SI units in one of it
  Dimension dimension;

  double to_si(double value) const;  ///< rounded once: 14 um is the number 14e-6 exactly
  double from_si(double value) const;
};

/// A unit such as "mm", "N/mm^3", "J/m2", "kg.m-1.s-2", "MPa.m^0.5", "1/s", "percent" or "1": names joined by
/// . * / with no spaces; t is the tonne. Nothing if unknown, if it is refused (ton) or has an offset (degC). Throws
/// MachineFailure if the UDUNITS database cannot be read. Safe to call from several threads.
std::optional<Unit> find_unit(std::string_view text);

/// The unit that text begins with, and how many bytes it takes; for units that stand in expressions. There a
/// negative exponent needs its ^ (3 s^-1), because 3 s-1 is a difference.
struct LeadingUnit {
  Unit unit;
  std::size_t length = 0;
  std::vector<std::string_view> later_names;  ///< in "N/mm^3": mm. They might be meant as parameters
};
std::optional<LeadingUnit> find_leading_unit(std::string_view text);

/// Why `text` is no unit, with what to write: `unknown unit "mmm". Did you mean "mm"?`
std::string why_no_unit(std::string_view text);

/// A number with its unit as people write it.
struct Amount {
  double value = 0;       ///< in `unit`
  std::string unit_name;  ///< empty for a plain number
  Unit unit;

  Quantity quantity() const { return {unit.to_si(value), unit.dimension}; }
  std::string text() const;  ///< "30 GPa"
};

/// "30 GPa" or "3", with blanks around it; nothing for anything else, such as a formula.
std::optional<Amount> parse_amount(std::string_view text);

/// A value in SI printed in a unit: format_quantity(0.014, "mm") is "14 mm". The unit must exist.
std::string format_quantity(double si, std::string_view unit);
/// A quantity printed in the SI unit of its dimension.
std::string format_quantity(const Quantity& quantity);

}  // namespace beadwork
