#include "core/base/units.hpp"

#include <udunits2.h>

#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"

namespace beadwork {

// ---- Dimensions

namespace {

constexpr const char* base_units[] = {"m", "kg", "s", "A", "K", "mol", "cd"};

struct NamedDimension {
  const char* name;
  Dimension dimension;
};

const NamedDimension friendly_names[] = {
    {"N", {{1, 1, -2}}},      {"Pa", {{-1, 1, -2}}},        {"J", {{2, 1, -2}}},
    {"W", {{2, 1, -3}}},      {"N/m", {{0, 1, -2}}},        {"Pa/m", {{-2, 1, -2}}},
    {"J/kg", {{2, 0, -2}}},   {"Pa.s", {{-1, 1, -1}}},      {"Pa.m^0.5", {{-0.5, 1, -2}}},
    {"N/m^3", {{-2, 1, -2}}}, {"J/K", {{2, 1, -2, 0, -1}}},
};

bool equal_exponents(double a, double b) { return std::abs(a - b) < 1e-9; }

std::string with_exponent(const char* name, double exponent) {
  return equal_exponents(exponent, 1)
             ? name
             : std::string(name) + "^" + format_number(std::round(exponent * 1e6) / 1e6);
}

}  // namespace

bool operator==(const Dimension& a, const Dimension& b) {
  for (std::size_t i = 0; i < a.exponents.size(); ++i)
    if (!equal_exponents(a.exponents[i], b.exponents[i])) return false;
  return true;
}

Dimension power(const Dimension& a, double exponent) {
  Dimension result;
  for (std::size_t i = 0; i < a.exponents.size(); ++i) result.exponents[i] = a.exponents[i] * exponent;
  return result;
}

Dimension operator*(const Dimension& a, const Dimension& b) {
  Dimension result = a;
  for (std::size_t i = 0; i < a.exponents.size(); ++i) result.exponents[i] += b.exponents[i];
  return result;
}

Dimension operator/(const Dimension& a, const Dimension& b) { return a * power(b, -1); }

bool Dimension::is_plain() const { return *this == Dimension{}; }

std::string Dimension::name() const {
  if (is_plain()) return "1";
  for (const NamedDimension& each : friendly_names)
    if (each.dimension == *this) return each.name;
  std::string above, below;
  for (std::size_t i = 0; i < exponents.size(); ++i) {
    if (equal_exponents(exponents[i], 0)) continue;
    if (exponents[i] > 0) above += (above.empty() ? "" : ".") + with_exponent(base_units[i], exponents[i]);
    if (exponents[i] < 0) below += "/" + with_exponent(base_units[i], -exponents[i]);
  }
  return (above.empty() ? "1" : above) + below;
}

// ---- Units: UDUNITS knows the names, the products are ours, because it takes "m)" for a metre and m^0.5 for
// 5

namespace {

/// What UDUNITS says about one name without exponents.
struct NamedUnit {
  Unit unit;
  bool has_offset = false;
};

struct Reading {
  Unit unit;
  bool usable = true, has_offset = false;
};

void multiply_basic(const ut_unit* basic, int exponent, Reading& reading) {
  const char* symbol = ut_get_symbol(basic, UT_ASCII);
  if (symbol && std::string_view(symbol) == "rad") return;  // angles are plain numbers
  for (std::size_t i = 0; i < std::size(base_units); ++i)
    if (symbol && std::string_view(symbol) == base_units[i]) {
      reading.unit.dimension.exponents[i] += exponent;
      return;
    }
  reading.usable = false;
}

ut_status visit_basic(const ut_unit* unit, void* reading) {
  multiply_basic(unit, 1, *static_cast<Reading*>(reading));
  return UT_SUCCESS;
}

ut_status visit_product(const ut_unit*, int count, const ut_unit* const* basics, const int* powers,
                        void* reading) {
  for (int i = 0; i < count; ++i) multiply_basic(basics[i], powers[i], *static_cast<Reading*>(reading));
  return UT_SUCCESS;
}

ut_status visit_scaled(const ut_unit*, double scale, const ut_unit* underlying, double offset, void* reading);

ut_status refuse_time(const ut_unit*, const ut_unit*, double, void* reading) {
  static_cast<Reading*>(reading)->usable = false;
  return UT_SUCCESS;
}

ut_status refuse_logarithm(const ut_unit*, double, const ut_unit*, void* reading) {
  static_cast<Reading*>(reading)->usable = false;
  return UT_SUCCESS;
}

constexpr ut_visitor visitor{visit_basic, visit_product, visit_scaled, refuse_time, refuse_logarithm};

ut_status visit_scaled(const ut_unit*, double scale, const ut_unit* underlying, double offset,
                       void* reading) {
  static_cast<Reading*>(reading)->unit.scale *= scale;
  if (offset != 0) static_cast<Reading*>(reading)->has_offset = true;
  return ut_accept_visitor(underlying, &visitor, reading);
}

ut_system* database() {
  ut_set_error_message_handler(ut_ignore);
  static ut_system* const system = ut_read_xml(nullptr);
  if (!system)
    throw MachineFailure(
        "cannot read the database of units of UDUNITS-2: install the package libudunits2-data");
  return system;
}

/// The database is one global thing that is not made for threads, and slow: hence the lock, and a memory of
/// known names.
std::optional<NamedUnit> look_up(std::string_view name) {
  static std::mutex mutex;
  static std::map<std::string, NamedUnit, std::less<>> known;
  const std::lock_guard lock(mutex);
  if (const auto found = known.find(name); found != known.end()) return found->second;
  const std::string spelt(name == "deg" ? "degree" : name);  // UDUNITS knows only the whole word
  const std::unique_ptr<ut_unit, void (*)(ut_unit*)> unit(ut_parse(database(), spelt.c_str(), UT_UTF8),
                                                          ut_free);
  if (!unit) return {};
  Reading reading;
  if (ut_accept_visitor(unit.get(), &visitor, &reading) != UT_SUCCESS || !reading.usable) return {};
  return known.emplace(std::string(name), NamedUnit{reading.unit, reading.has_offset}).first->second;
}

// A power of ten that came out of a product of powers of ten, without its rounding errors.
double without_dust(double scale) {
  const double exponent = std::round(std::log10(scale));
  if (!(std::abs(exponent) < 300)) return scale;
  const double power_of_ten = *parse_number("1e" + format_number(exponent));
  return std::abs(scale / power_of_ten - 1) < 1e-12 ? power_of_ten : scale;
}

// ---- The grammar: factor {(. * /) factor}, factor = name [[^] integer] | name ^ decimal

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Letters, %, and the few signs beyond ASCII that stand in units: how many bytes one takes here, 0 if none
/// does.
std::size_t letter_length(std::string_view text) {
  if (text.empty()) return 0;
  const char c = text.front();
  if ((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '%' || c == '_') return 1;
  for (const std::string_view sign : {"\u00B5", "\u03BC", "\u00B0", "\u03A9", "\u00B2", "\u00B3"})
    if (text.starts_with(sign)) return sign.size();
  return 0;
}

std::string_view leading_name(std::string_view text) {
  std::size_t length = 0;
  while (const std::size_t more = letter_length(text.substr(length))) length += more;
  return text.substr(0, length);
}

enum class Where { alone, in_expression };
constexpr double largest_exponent = 20;

/// The exponent that text begins with ("^-0.5", "2", alone also "-1") and its length; 1 and 0 if there is
/// none.
std::pair<double, std::size_t> leading_exponent(std::string_view text, Where where) {
  std::size_t at = 0;
  const bool hat = text.starts_with('^');
  if (hat) at = 1;
  if (at < text.size() && (text[at] == '-' || text[at] == '+') && (hat || where == Where::alone)) ++at;
  const std::size_t digits = at;
  while (at < text.size() && is_digit(text[at])) ++at;
  if (at == digits) return {1, 0};
  if (hat && at + 1 < text.size() && text[at] == '.' && is_digit(text[at + 1]))
    for (++at; at < text.size() && is_digit(text[at]);) ++at;
  const std::size_t begin = hat ? 1 : 0;
  return {parse_number(text.substr(begin, at - begin)).value_or(1), at};
}

/// The longest unit that text begins with. `unknown` tells the first name that is none.
std::optional<LeadingUnit> leading_unit(std::string_view text, Where where,
                                        std::string_view* unknown = nullptr) {
  LeadingUnit result;
  std::size_t at = 0;
  double sign = 1;
  if (where == Where::alone && text.starts_with("1/")) {
    at = 2;
    sign = -1;
  }
  for (;;) {
    const std::string_view name = leading_name(text.substr(at));
    const auto found = name.empty() || name.size() > 64 ? std::nullopt : look_up(name);
    if (!found || found->has_offset) {
      if (unknown) *unknown = name;
      break;
    }
    if (result.length > 0) result.later_names.push_back(name);
    at += name.size();
    const auto [exponent, length] = leading_exponent(text.substr(at), where);
    at += length;
    if (std::abs(exponent) > largest_exponent) return {};
    result.unit.scale *= std::pow(found->unit.scale, sign * exponent);
    result.unit.dimension = result.unit.dimension * power(found->unit.dimension, sign * exponent);
    result.length = at;
    if (at >= text.size() || (text[at] != '.' && text[at] != '*' && text[at] != '/')) break;
    sign = text[at] == '/' ? -1 : 1;
    ++at;
  }
  if (result.length == 0 || !std::isnormal(result.unit.scale)) return {};
  result.unit.scale = without_dust(result.unit.scale);
  return result;
}

}  // namespace

double Unit::to_si(double value) const {
  const double inverse = std::round(1 / scale);
  return scale < 1 && std::abs(inverse * scale - 1) < 1e-15 ? value / inverse : value * scale;
}

double Unit::from_si(double value) const {
  const double inverse = std::round(1 / scale);
  return scale < 1 && std::abs(inverse * scale - 1) < 1e-15 ? value * inverse : value / scale;
}

std::optional<Unit> find_unit(std::string_view text) {
  if (text == "1") return Unit{};
  const auto found = leading_unit(text, Where::alone);
  if (!found || found->length != text.size()) return {};
  return found->unit;
}

std::optional<LeadingUnit> find_leading_unit(std::string_view text) {
  return leading_unit(text, Where::in_expression);
}

std::string why_no_unit(std::string_view text) {
  static const std::vector<std::string> usual{
      "m",   "mm",     "um",      "nm",  "cm",    "km",     "s",      "ms",     "us",    "ns",   "min",
      "h",   "kg",     "g",       "mg",  "t",     "N",      "mN",     "kN",     "MN",    "Pa",   "kPa",
      "MPa", "GPa",    "J",       "mJ",  "kJ",    "W",      "Hz",     "kHz",    "MHz",   "K",    "deg",
      "rad", "degree", "percent", "bar", "metre", "second", "newton", "pascal", "joule", "tonne"};
  const std::string quoted = "unknown unit \"" + std::string(text) + "\"";
  std::string_view unknown;
  leading_unit(text, Where::alone, &unknown);
  if (unknown.empty()) return quoted + "; units look like N/mm^3 or J.m-2, without blanks";
  if (const auto found = look_up(unknown.substr(0, 64)); found && found->has_offset)
    return "unit \"" + std::string(unknown) + "\" has an offset; give the temperature in K";
  const std::string part = unknown == text ? "" : " ('" + std::string(unknown) + "')";
  const std::string near = closest(unknown, usual);
  return quoted + part + (near.empty() ? "" : ". Did you mean \"" + near + "\"?");
}

std::string format_quantity(double si, std::string_view unit) {
  const auto found = find_unit(unit);
  if (!found) throw std::invalid_argument(why_no_unit(unit));
  return format_number(found->from_si(si)) + (unit == "1" ? "" : " " + std::string(unit));
}

std::string format_quantity(const Quantity& quantity) {
  const std::string unit = quantity.dimension.name();
  return format_number(quantity.value) + (unit == "1" ? "" : " " + unit);
}

}  // namespace beadwork
