#include "core/base/units.hpp"

#include <udunits2.h>

#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"
#include "core/base/unit_names.hpp"
#include "core/base/utf8.hpp"

namespace beadwork {

// ---- Dimensions

namespace {

constexpr const char* base_units[] = {"m", "kg", "s", "A", "K", "mol", "cd"};

struct NamedDimension {
  const char* name;
  Dimension dimension;
};

const NamedDimension friendly_names[] = {
    {"N", {{1, 1, -2}}},           {"Pa", {{-1, 1, -2}}},    {"J", {{2, 1, -2}}},          {"W", {{2, 1, -3}}},
    {"N/m", {{0, 1, -2}}},         {"Pa/m", {{-2, 1, -2}}},  {"J/kg", {{2, 0, -2}}},       {"Pa.s", {{-1, 1, -1}}},
    {"Pa.m^0.5", {{-0.5, 1, -2}}}, {"N/m^3", {{-2, 1, -2}}}, {"J/K", {{2, 1, -2, 0, -1}}},
};

bool equal_exponents(double a, double b) { return std::abs(a - b) < 1e-9; }

std::string with_exponent(const char* name, double exponent) {
  return equal_exponents(exponent, 1) ? name
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

// ---- Units: UDUNITS knows their sizes; which names pass (unit_names.hpp) and products are ours, because it takes "m)"
// for a metre and m^0.5 for 5

namespace {

/// What UDUNITS says about one name without exponents.
struct Reading {
  Unit unit;
  bool usable = true;
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

ut_status visit_product(const ut_unit*, int count, const ut_unit* const* basics, const int* powers, void* reading) {
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

ut_status visit_scaled(const ut_unit*, double scale, const ut_unit* underlying, double offset, void* reading) {
  static_cast<Reading*>(reading)->unit.scale *= scale;
  if (offset != 0) static_cast<Reading*>(reading)->usable = false;
  return ut_accept_visitor(underlying, &visitor, reading);
}

ut_system* database() {
  ut_set_error_message_handler(ut_ignore);
  static ut_system* const system = ut_read_xml(nullptr);
  if (!system)
    throw MachineFailure("cannot read the database of units of UDUNITS-2: install the package libudunits2-data");
  return system;
}

/// The database is one global thing that is not made for threads, and slow: hence the lock, and a memory of
/// known names.
std::optional<Unit> look_up(std::string_view name) {
  static std::mutex mutex;
  static std::map<std::string, Unit, std::less<>> known;
  if (unit_name(name).verdict != UnitName::Verdict::accepted) return {};
  const std::lock_guard lock(mutex);
  if (const auto found = known.find(name); found != known.end()) return found->second;
  const std::string spelt(name == "deg" ? "degree" : name);  // UDUNITS knows only the whole word
  const std::unique_ptr<ut_unit, void (*)(ut_unit*)> unit(ut_parse(database(), spelt.c_str(), UT_UTF8), ut_free);
  if (!unit) return {};
  Reading reading;
  if (ut_accept_visitor(unit.get(), &visitor, &reading) != UT_SUCCESS || !reading.usable) return {};
  return known.emplace(std::string(name), reading.unit).first->second;
}

// A power of ten that came out of a product of powers of ten, without its rounding errors.
double without_dust(double scale) {
  const double exponent = std::round(std::log10(scale));
  if (!(std::abs(exponent) < 300)) return scale;
  const double power_of_ten = *parse_number("1e" + format_number(exponent));
  return std::abs(scale / power_of_ten - 1) < 1e-12 ? power_of_ten : scale;
}

// ---- The grammar: factor {(. * /)  factor}, factor = name [[^] integer] | name ^ decimal

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Letters, %, and the few signs beyond ASCII that stand in names of units: how many bytes one takes here, 0 if none
/// does.
std::size_t letter_length(std::string_view text) {
  if (text.empty()) return 0;
  const char c = text.front();
  if ((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '%' || c == '_') return 1;
  for (const std::string_view sign :
       {"\u00B5", "\u03BC", "\u00B0", "\u03A9", "\u2126", "\u00C5", "\u212B", "\u03C0", "\u2103", "\u2109"})
    if (text.starts_with(sign)) return sign.size();
  return 0;
}

std::string_view leading_name(std::string_view text) {
  std::size_t length = 0;
  while (const std::size_t more = letter_length(text.substr(length))) length += more;
  return text.substr(0, length);
}

/// The sign that joins two factors: how many bytes it takes here, 0 if there is none.
std::size_t joint_length(std::string_view text) {
  if (text.empty()) return 0;
  if (text[0] == '.' || text[0] == '*' || text[0] == '/') return 1;
  for (const std::string_view dot : {"\u00B7", "\u22C5"})
    if (text.starts_with(dot)) return dot.size();
  return 0;
}

/// An exponent in raised digits: its value and length; 1 and 0 if there is none.
std::pair<double, std::size_t> raised_exponent(std::string_view text) {
  constexpr std::string_view digits[] = {"\u2070", "\u00B9", "\u00B2", "\u00B3", "\u2074",
                                         "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  constexpr std::string_view minus = "\u207B";
  const std::size_t begin = text.starts_with(minus) ? minus.size() : 0;
  for (int digit = 0; digit < 10; ++digit)
    if (text.substr(begin).starts_with(digits[digit]))
      return {begin > 0 ? -digit : digit, begin + digits[digit].size()};
  return {1, 0};
}

enum class Where { alone, in_expression };
constexpr double largest_exponent = 20;

/// The exponent that text begins with ("^-0.5", "2", alone also "-1") and its length; 1 and 0 if there is
/// none.
std::pair<double, std::size_t> leading_exponent(std::string_view text, Where where) {
  if (const auto raised = raised_exponent(text); raised.second > 0) return raised;
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
std::optional<LeadingUnit> leading_unit(std::string_view text, Where where, std::string_view* unknown = nullptr) {
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
    if (!found) {
      if (unknown) *unknown = name;
      break;
    }
    if (result.length > 0) result.later_names.push_back(name);
    at += name.size();
    const auto [exponent, length] = leading_exponent(text.substr(at), where);
    at += length;
    if (std::abs(exponent) > largest_exponent) return {};
    result.unit.scale *= std::pow(found->scale, sign * exponent);
    result.unit.dimension = result.unit.dimension * power(found->dimension, sign * exponent);
    result.length = at;
    const std::size_t joint = joint_length(text.substr(at));
    if (joint == 0) break;
    sign = text[at] == '/' ? -1 : 1;
    at += joint;
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

std::optional<LeadingUnit> find_leading_unit(std::string_view text) { return leading_unit(text, Where::in_expression); }

std::string why_no_unit(std::string_view text) {
  static const std::vector<std::string> usual{
      "m",   "mm",     "um",      "nm",  "cm",    "km",     "s",      "ms",     "us",    "ns",   "min",
      "h",   "kg",     "g",       "mg",  "t",     "N",      "mN",     "kN",     "MN",    "Pa",   "kPa",
      "MPa", "GPa",    "J",       "mJ",  "kJ",    "W",      "Hz",     "kHz",    "MHz",   "K",    "deg",
      "rad", "degree", "percent", "bar", "metre", "second", "newton", "pascal", "joule", "tonne"};
  const std::string quoted = "unknown unit \"" + std::string(text) + "\"";
  std::string_view unknown;
  leading_unit(text, Where::alone, &unknown);
  if (const auto odd = first_lookalike(text)) return quoted + ": it holds " + named_character(text.substr(*odd));
  if (unknown.empty()) return quoted + "; units look like N/mm^3 or J.m-2, without blanks";
  const UnitName name = unit_name(unknown);
  if (name.verdict == UnitName::Verdict::refused)
    return "unit \"" + std::string(unknown) + "\" is refused: " + name.instead;
  const std::string part = unknown == text ? "" : " ('" + std::string(unknown) + "')";
  std::string near = closest(unknown, usual);
  if (near.empty()) near = closest(unknown, accepted_unit_names());
  return quoted + part + (near.empty() ? "" : ". Did you mean \"" + near + "\"?");
}

std::string format_quantity(double si, std::string_view unit) {
  const auto found = find_unit(unit);
  if (!found) throw std::invalid_argument(why_no_unit(unit));
  return format_number(found->from_si(si)) + (unit == "1" ? "" : " " + std::string(unit));
}

std::string Amount::text() const { return format_number(value) + (unit_name.empty() ? "" : " " + unit_name); }

std::optional<Amount> parse_amount(std::string_view text) {
  const std::string_view plain = trim(text);
  const std::size_t blank = plain.find_first_of(blanks);
  const auto value = parse_number(plain.substr(0, blank));
  if (!value) return {};
  if (blank == std::string_view::npos) return Amount{*value, {}, {}};
  const std::string_view name = trim(plain.substr(blank));
  const auto unit = find_unit(name);
  if (!unit) return {};
  return Amount{*value, std::string(name), *unit};
}

std::string format_quantity(const Quantity& quantity) {
  const std::string unit = quantity.dimension.name();
  return format_number(quantity.value) + (unit == "1" ? "" : " " + unit);
}

}  // namespace beadwork
