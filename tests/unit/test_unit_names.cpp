#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <udunits2.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>

#include "core/base/unit_names.hpp"
#include "core/base/units.hpp"

namespace beadwork {
namespace {

using Verdict = UnitName::Verdict;

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A name as it stands in XML, in UTF-8: a character by its number (&#x3A9;) is what UDUNITS itself sees.
std::string decoded(std::string name) {
  static const std::regex number("&#x([0-9A-Fa-f]+);");
  for (std::smatch found; std::regex_search(name, found, number);) {
    const auto code = static_cast<char32_t>(std::stoul(found[1], nullptr, 16));
    std::string bytes;
    if (code < 0x80)
      bytes = {static_cast<char>(code)};
    else if (code < 0x800)
      bytes = {static_cast<char>(0xC0 | (code >> 6)), static_cast<char>(0x80 | (code & 0x3F))};
    else
      bytes = {static_cast<char>(0xE0 | (code >> 12)), static_cast<char>(0x80 | ((code >> 6) & 0x3F)),
               static_cast<char>(0x80 | (code & 0x3F))};
    name = found.prefix().str() + bytes + found.suffix().str();
  }
  return name;
}

/// Every name and symbol of a unit in the database of UDUNITS: all <singular>, <plural> and <symbol> of its files but
/// the prefixes'.
std::vector<std::string> names_of_udunits() {
  ut_status status;
  const std::string main = ut_get_path_xml(nullptr, &status), folder = main.substr(0, main.rfind('/') + 1);
  std::vector<std::string> names;
  for (const char* part : {"base", "derived", "accepted", "common"}) {
    const std::string text = text_of(folder + "udunits2-" + part + ".xml");
    EXPECT_FALSE(text.empty()) << part;
    const std::regex name("<(singular|plural|symbol)[^>]*>([^<]+)</");
    for (auto it = std::sregex_iterator(text.begin(), text.end(), name); it != std::sregex_iterator(); ++it)
      names.push_back(decoded((*it)[2]));
  }
  return names;
}

/// A name as UDUNITS itself takes it, as a scale of SI units; NaN if it does not.
double udunits(const std::string& name) {
  static ut_system* const system = ut_read_xml(nullptr);
  ut_unit* const unit = ut_parse(system, name.c_str(), UT_UTF8);
  if (!unit) return NAN;
  const auto ours = find_unit(name);
  ut_unit* const base =
      ut_parse(system, ours && !ours->dimension.is_plain() ? ours->dimension.name().c_str() : "1", UT_UTF8);
  cv_converter* const convert = base ? ut_get_converter(unit, base) : nullptr;
  const double scale = convert ? cv_convert_double(convert, 1) : NAN;
  if (convert) cv_free(convert);
  ut_free(unit);
  if (base) ut_free(base);
  return scale;
}

TEST(UnitNames, each_that_udunits_knows_has_been_looked_at) {
  const auto names = names_of_udunits();
  EXPECT_GT(names.size(), 400u);
  for (const std::string& name : names)
    EXPECT_NE(unit_name(name).verdict, Verdict::unknown)
        << "UDUNITS knows \"" << name << "\": accept or refuse it in core/base/unit_names.cpp";
}

TEST(UnitNames, each_that_is_accepted_has_the_size_that_udunits_gives_it) {
  EXPECT_GT(accepted_unit_names().size(), 1000u);
  for (const std::string& name : accepted_unit_names()) {
    const auto unit = find_unit(name);
    ASSERT_TRUE(unit) << name;
    const double theirs = name == "deg" ? udunits("degree") : udunits(name);
    EXPECT_NEAR(unit->scale / theirs, 1, 1e-12) << name;
  }
}

// A prefix in front of one unit must not spell another: "min" is no milli-inch.
TEST(UnitNames, a_prefix_multiplies_and_does_nothing_else) {
  const std::map<std::string, double> prefixes{
      {"G", 1e9},  {"M", 1e6},  {"k", 1e3},       {"h", 1e2},       {"da", 1e1}, {"d", 1e-1},  {"c", 1e-2},
      {"m", 1e-3}, {"u", 1e-6}, {"\u00B5", 1e-6}, {"\u03BC", 1e-6}, {"n", 1e-9}, {"p", 1e-12}, {"f", 1e-15}};
  for (const char* symbol : {"m", "g", "s", "A", "K", "mol", "rad", "Hz", "N",  "Pa",  "J",
                             "W", "C", "V", "F", "S", "T",   "H",   "L",  "eV", "bar", "tex"})
    for (const auto& [prefix, size] : prefixes) {
      const auto with = find_unit(prefix + symbol);
      ASSERT_TRUE(with) << prefix << symbol;
      EXPECT_NEAR(with->scale / find_unit(symbol)->scale / size, 1, 1e-12) << prefix << symbol;
      EXPECT_TRUE(with->dimension == find_unit(symbol)->dimension) << prefix << symbol;
    }
}

TEST(UnitNames, case_is_exact) {
  for (const char* odd : {"Ton", "TON",          "Meter", "METRE", "Newton", "Kelvin", "MM",  "KG",      "Kg",  "KPA",
                          "Kpa", "Gpa",          "mpa",   "KN",    "kn",     "HZ",     "hz",  "Percent", "Psi", "PSI",
                          "Min", "Sec",          "Feet",  "Inch",  "IN",     "FT",     "Lb",  "LB",      "Bar", "Um",
                          "NM",  "millipascalS", "kkm",   "mmm",   "kmeter", "kiloPa", "mGPa"})
    EXPECT_NE(unit_name(odd).verdict, Verdict::accepted) << odd;
}

TEST(UnitNames, those_of_the_field_are_accepted) {
  for (const char* known :
       {"m",          "mm",          "um",         "nm",         "km",          "cm",     "s",       "ms",
        "us",         "ns",          "min",        "h",          "d",           "kg",     "g",       "mg",
        "ug",         "t",           "N",          "mN",         "kN",          "MN",     "daN",     "Pa",
        "kPa",        "MPa",         "GPa",        "hPa",        "J",           "mJ",     "kJ",      "W",
        "kW",         "Hz",          "kHz",        "MHz",        "K",           "mK",     "deg",     "degree",
        "degrees",    "rad",         "mrad",       "percent",    "%",           "ppm",    "bar",     "mbar",
        "kbar",       "psi",         "ksi",        "kip",        "lb",          "lbf",    "in",      "ft",
        "yd",         "mi",          "inch",       "inches",     "foot",        "feet",   "pound",   "pounds",
        "slug",       "tonne",       "tonnes",     "kgf",        "gf",          "dyne",   "erg",     "poise",
        "L",          "mL",          "ml",         "cc",         "atm",         "torr",   "mmHg",    "rpm",
        "eV",         "micron",      "angstrom",   "tex",        "dtex",        "denier", "metre",   "millimetres",
        "kilopascal", "megapascals", "gigapascal", "hertz",      "kilonewtons", "grams",  "seconds", "nautical_mile",
        "knot",       "short_ton",   "long_ton",   "metric_ton", "V",           "A",      "C",       "F",
        "T"})
    EXPECT_EQ(unit_name(known).verdict, Verdict::accepted) << known;
}

TEST(UnitNames, one_with_several_readings_is_refused_with_what_to_write) {
  for (const char* name :
       {"ton",     "tons", "ton_force", "gallon", "pint",  "pt", "oz", "gal", "gr",   "mil",   "nmi", "cal",
        "calorie", "Btu",  "hp",        "a",      "at",    "u",  "mt", "kt",  "year", "month", "cps", "cycle",
        "ppb",     "ppt",  "degC",      "degF",   "force", "pi", "Nm", "kNm", "mph",  "b",     "St"}) {
    EXPECT_EQ(unit_name(name).verdict, Verdict::refused) << name;
    EXPECT_FALSE(find_unit(name)) << name;
    EXPECT_FALSE(find_leading_unit(name + std::string(" + 1"))) << name;
    EXPECT_THAT(why_no_unit(name), testing::HasSubstr("write ")) << name;
  }
  EXPECT_EQ(why_no_unit("7.85 ton/m^3").find("refused"), std::string::npos) << "that is no unit at all";
  EXPECT_EQ(why_no_unit("ton/m^3"),
            "unit \"ton\" is refused: there are several tons; write t (1000 kg), short_ton (907.18 kg) or long_ton "
            "(1016.05 kg)");
  EXPECT_EQ(why_no_unit("kg/gal"), "unit \"gal\" is refused: it may be a gallon or cm/s^2; write L or m/s^2");
  EXPECT_EQ(why_no_unit("kelvins/Kelvin"), "unknown unit \"kelvins/Kelvin\" ('Kelvin'). Did you mean \"kelvin\"?");
}

}  // namespace
}  // namespace beadwork
