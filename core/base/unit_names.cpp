#include "core/base/unit_names.hpp"

#include <map>

#include "core/base/text.hpp"

namespace beadwork {

namespace {

using Names = const char*;

// ---- Accepted: one reading only, case as it stands here

/// With a prefix symbol (mPa, um) or without.
constexpr Names with_prefix_symbol =
    "m g s A K mol cd rad sr Hz N Pa J W C V F \u03A9 \u2126 S Wb T H lm lx kat Bq Gy Sv L l eV bar ohm tex";

/// With a prefix word (millimetre, kilopascals) or without; all take a plural s but the last line.
constexpr Names with_prefix_word =
    "meter metre gram second ampere kelvin mole candela radian steradian newton pascal joule watt coulomb volt farad "
    "ohm weber tesla "
    "liter litre bar lumen electronvolt tonne";
constexpr Names with_prefix_word_no_plural = "hertz siemens lux henry";

/// As they stand.
constexpr Names symbols =
    "t h hr min d lb in ft yd mi lbf kgf gf kip psi ksi atm mmHg cc VA \u00B0 \u00C5 \u212B % percent ppm rpm rps deg "
    "foot feet inch inches international_foot international_inch international_feet international_inches "
    "US_survey_foot US_survey_feet kilogram_force kilograms_force gram_force grams_force "
    "pound_force pounds_force standard_free_fall darcy";

/// With a plural s or without.
constexpr Names words =
    "minute hour day week fortnight sec amp metric_ton short_ton long_ton pound avoirdupois_pound avoirdupois_ounce "
    "troy_pound troy_ounce "
    "slug grain carat long_hundredweight short_hundredweight yard mile international_yard "
    "international_mile nautical_mile US_survey_yard US_survey_mile micron angstrom fermi hectare are acre degree "
    "arc_degree "
    "angular_degree arcdeg arc_minute angular_minute arcminute arcmin arc_second angular_second arcsecond arcsec turn "
    "revolution rotation "
    "knot atmosphere standard_atmosphere torr force_kilogram force_gram force_pound poundal dyne erg barye poise "
    "IT_calorie "
    "thermochemical_calorie IT_Btu shaft_horsepower metric_horsepower electric_horsepower voltampere watthour denier "
    "Julian_year "
    "Gregorian_year common_year leap_year US_liquid_gallon UK_liquid_gallon US_fluid_ounce UK_fluid_ounce";

struct Prefix {
  const char *symbols, *word;
};
constexpr Prefix prefixes[] = {{"Y", "yotta"}, {"Z", "zetta"},
                               {"E", "exa"},   {"P", "peta"},
                               {"T", "tera"},  {"G", "giga"},
                               {"M", "mega"},  {"k", "kilo"},
                               {"h", "hecto"}, {"da", "deka"},
                               {"d", "deci"},  {"c", "centi"},
                               {"m", "milli"}, {"u \u00B5 \u03BC", "micro"},
                               {"n", "nano"},  {"p", "pico"},
                               {"f", "femto"}, {"a", "atto"},
                               {"z", "zepto"}, {"y", "yocto"}};

// ---- Refused: why, and what to write

struct Refused {
  Names names;
  const char* instead;
};

constexpr const char* several_sizes = "it has several sizes, by country and trade; write it in SI";
constexpr const char* no_thermometer = "write temperatures and their differences in K";
constexpr const char* plain_number = "that is a plain number; write none";
constexpr const char* not_of_this_field = "it has no place in this field, or too many meanings; write the value in SI";

constexpr Refused refused[] = {
    {"ton tons", "there are several tons; write t (1000 kg), short_ton (907.18 kg) or long_ton (1016.05 kg)"},
    {"ton_force tons_force force_ton force_tons tonf tf",
     "there are several tons; write 9.80665 kN, or 2000 lbf for that of a short ton"},
    {"ton_TNT tons_TNT TNT refrigeration_ton refrigeration_tons ton_of_refrigeration tons_of_refrigeration assay_ton "
     "assay_tons register_ton register_tons",
     "a ton of some trade; write the value in SI"},
    {"mt Mt", "it may be a metric ton or one with a prefix; write t (1000 kg), kg or 1e6 t"},
    {"kt kts", "it may be a knot or 1000 tonnes; write knot, or 1e6 kg"},
    {"at", "it may be a technical atmosphere or a typing error for atm; write 98066.5 Pa or atm"},
    {"technical_atmosphere technical_atmospheres", "write 98066.5 Pa, or kgf/cm^2"},
    {"pt pint pints liquid_pint liquid_pints US_liquid_pint US_liquid_pints UK_liquid_pint UK_liquid_pints dry_pint "
     "dry_pints US_dry_pint US_dry_pints "
     "quart quarts liquid_quart liquid_quarts US_liquid_quart US_liquid_quarts UK_liquid_quart UK_liquid_quarts "
     "dry_quart dry_quarts US_dry_quart US_dry_quarts "
     "cup cups liquid_cup liquid_cups US_liquid_cup US_liquid_cups UK_liquid_cup UK_liquid_cups gill gills liquid_gill "
     "liquid_gills US_liquid_gill US_liquid_gills "
     "UK_liquid_gill UK_liquid_gills US_dry_gallon US_dry_gallons barrel barrels bbl firkin firkins bushel bushels bu "
     "peck pecks pk "
     "tablespoon tablespoons Tbl Tbsp tbsp Tblsp tblsp teaspoon teaspoons tsp fldr fluid_dram fluid_drams stere steres "
     "acre_foot acre_feet board_foot board_feet",
     "a volume of kitchen and trade; write L or m^3"},
    {"gallon gallons liquid_gallon liquid_gallons Canadian_liquid_gallon Canadian_liquid_gallons",
     "write L, US_liquid_gallon (3.785 L) or UK_liquid_gallon (4.546 L)"},
    {"oz floz ounce ounces fluid_ounce fluid_ounces liquid_ounce liquid_ounces US_liquid_ounce US_liquid_ounces "
     "UK_liquid_ounce UK_liquid_ounces",
     "it may be a mass or a volume; write avoirdupois_ounce (28.35 g), US_fluid_ounce or UK_fluid_ounce"},
    {"ozf ounce_force ounces_force force_ounce force_ounces", "write N"},
    {"gal gals", "it may be a gallon or cm/s^2; write L or m/s^2"},
    {"gr", "it may be a gram or a grain; write g or grain"},
    {"dr dram drams apdram apdrams apounce apounces appound appounds apothecary_ounce apothecary_ounces "
     "apothecary_pound apothecary_pounds scruple scruples "
     "pennyweight pennyweights bag bags",
     "a weight of old trades; write g or kg"},
    {"pond ponds", "it is a gram-force, and looks like pound; write gf or lbf"},
    {"mil mils", "it may be 0.001 inch, a millimetre or a millilitre; write um or mm"},
    {"circular_mil circular_mils", "write um^2"},
    {"nmi nmile nmiles", "it reads as a nautical mile or a nano-mile; write nautical_mile or km"},
    {"mph", "write mi/h"},
    {"kph kmh", "write km/h"},
    {"Nm", "a product has a point; write N.m"},
    {"Nmm", "a product has a point; write N.mm"},
    {"kNm", "a product has a point; write kN.m"},
    {"Ns", "a product has a point; write N.s"},
    {"Pas", "a product has a point; write Pa.s"},
    {"Wh", "a product has a point; write W.h"},
    {"kWh", "a product has a point; write kW.h"},
    {"cal calorie calories",
     "there are several calories; write J, IT_calorie (4.1868 J) or thermochemical_calorie (4.184 J)"},
    {"Btu Btus therm therms thm US_therm US_therms EC_therm EC_therms",
     "it has several sizes; write J or IT_Btu (1055.06 J)"},
    {"hp horsepower horsepowers boiler_horsepower boiler_horsepowers water_horsepower water_horsepowers UK_horsepower "
     "UK_horsepowers",
     "there are several horsepowers; write W, shaft_horsepower (745.7 W) or metric_horsepower (735.5 W)"},
    {"a", "it may be a year or 100 m^2; write d or m^2"},
    {"b barn barns", "write m^2"},
    {"u amu atomic_mass_unit atomic_mass_units atomicmassunit atomicmassunits unified_atomic_mass_unit "
     "unified_atomic_mass_units",
     "it is an atomic mass unit, and reads as a micrometre; write um or kg"},
    {"yr yrs year years tropical_year tropical_years sidereal_year sidereal_years month months lunar_month "
     "lunar_months sidereal_month sidereal_months "
     "tropical_month tropical_months eon eons",
     "years and months have several lengths; write d or Julian_year (365.25 d)"},
    {"sidereal_day sidereal_days sidereal_hour sidereal_hours sidereal_minute sidereal_minutes sidereal_second "
     "sidereal_seconds",
     "a time of astronomy; write s"},
    {"work_year work_years work_month work_months jiffy jiffies shake shakes", "write s or h"},
    {"rod rods pole poles perch perches chain chains furlong furlongs fathom fathoms barleycorn barleycorns arpentlin "
     "arpentlins pica picas printers_pica "
     "printers_picas printers_point printers_points big_point big_points US_statute_mile US_statute_miles",
     several_sizes},
    {"parsec parsecs light_year light_years au ua astronomical_unit astronomical_units astronomical_unit_BIPM_2006 "
     "astronomical_units_BIPM_2006",
     "a length of astronomy; write m"},
    {"\u00E5ngstr\u00F6m \u00E5ngstr\u00F6ms electron_volt electron_volts", "write angstrom or eV"},
    {"ppb ppbv ppt pptv ppq ppqv ppv ppmv", "its billions and thousands differ by country; write the number, 1e-9 say"},
    {"count counts bit bits octet octets byte bytes molecule molecules molec molecs nucleon nucleons nuc nucs "
     "avogadro_constant avogadro_constants einstein einsteins",
     plain_number},
    {"pi \u03C0", "it is a number, no unit; write ${2*pi}"},
    {"cycle cycles circle circles cps Bd bps baud bauds", "it may be 1 or 2 pi; write Hz, or turn for 2 pi"},
    {"rotation_per_second rotations_per_second", "write rps"},
    {"grade grades", "it may be a slope or 0.9 degree; write degree"},
    {"degree_north degrees_north degree_N degrees_N degreeN degreesN degree_east degrees_east degree_E degrees_E "
     "degreeE degreesE degree_true degrees_true degree_T "
     "degrees_T degreeT degreesT degree_west degrees_west degree_W degrees_W degreeW degreesW",
     "write degree"},
    {"\u00B0C \u2103 celsius degree_Celsius degrees_Celsius degree_C degrees_C degreeC degreesC deg_C degs_C degC "
     "degsC \u00B0F \u2109 fahrenheit fahrenheits "
     "degree_fahrenheit degrees_fahrenheit degree_F degrees_F degreeF degreesF deg_F degs_F degF degsF celsiuses",
     "its zero is not that of K, it has an offset; write temperatures and their differences in K"},
    {"\u00B0K degree_kelvin degrees_kelvin degree_K degrees_K degreeK degreesK deg_K degs_K degK degsK \u00B0R "
     "degree_rankine degrees_rankine degreeR degreesR "
     "degree_R degrees_R degR degsR deg_R degs_R",
     no_thermometer},
    {"force forces gravity gravities gp geopotential geopotentials dynamic dynamics",
     "it stands for 9.80665 m/s^2 in UDUNITS; write that, or standard_free_fall"},
    {"water waters conventional_water conventional_waters H2O h2o Hg cm_H2O cmH2O ftH2O fth2o footH2O feetH2O foot_H2O "
     "feet_H2O foot_water feet_water cm_Hg cmHg mm_Hg mm_hg mmhg "
     "in_Hg inHg inch_Hg inches_Hg millimeter_Hg millimeters_Hg conventional_mercury conventional_mercuries water_4C "
     "waters_4C water_39F waters_39F water_60F waters_60F "
     "mercury_0C mercuries_0C mercury_32F mercuries_32F mercury_60F mercuries_60F inch_H2O_39F inches_H2O_39F "
     "inch_H2O_60F inches_H2O_60F millimeter_Hg_0C millimeters_Hg_0C "
     "inch_Hg_32F inches_Hg_32F inch_Hg_60F inches_Hg_60F",
     "a column of liquid; write Pa, or mmHg"},
    {"barie baries", "write barye (0.1 Pa)"},
    {"stokes stokeses St", "write cm^2/s"},
    {"rhe rhes perm_0C perms_0C perm_23C perms_23C clo clos", not_of_this_field},
    {"candle candles", "write cd"},
    {"bev", "write GeV"},
    {"e", "it may be a charge or 2.718; write C"},
    {"' \u2032 \" \u2033", "write arcmin or arcsec"},
    // Electricity, light and radiation outside of SI, logarithms, and what belongs to the weather.
    {"abampere abamperes gilbert gilberts statampere statamperes biot biots abfarad abfarads abhenry abhenries abmho "
     "abmhos abohm abohms abvolt abvolts "
     "chemical_faraday chemical_faradays physical_faraday physical_faradays C12_faraday C12_faradays faraday faradays "
     "gamma gammas gauss gausses maxwell maxwells oersted oersteds Oe "
     "statcoulomb statcoulombs statfarad statfarads stathenry stathenries statmho statmhos statohm statohms statvolt "
     "statvolts unit_pole unit_poles "
     "footcandle footcandles footlambert footlamberts lambert lamberts sb stilb stilbs ph phot phots nt nit nits "
     "blondel blondels apostilb apostilbs "
     "Ci curie curies R roentgen roentgens rem rems katal katals becquerel becquerels gray grays sievert sieverts "
     "BZ B_SPL BW Bm BV Bv B\u00B5V sverdrup sverdrups langley langleys kayser kaysers PVU potential_vorticity_unit "
     "potential_vorticity_units DU dobson dobsons "
     "international_knot international_knots knot_international knots_international",
     not_of_this_field},
};

void add_all(std::map<std::string, UnitName, std::less<>>& names, Names list, const char* plural, bool takes_symbols,
             bool takes_words) {
  for (const std::string& name : split_words(list)) {
    const auto add = [&](const std::string& spelt) {
      names.emplace(spelt, UnitName{UnitName::Verdict::accepted, ""});
      if (*plural) names.emplace(spelt + plural, UnitName{UnitName::Verdict::accepted, ""});
    };
    add(name);
    for (const Prefix& prefix : prefixes) {
      if (takes_words) add(prefix.word + name);
      if (!takes_symbols) continue;
      for (const std::string& symbol : split_words(prefix.symbols)) add(symbol + name);
    }
  }
}

/// Refusals come first: they win over what a prefix would make of them.
const std::map<std::string, UnitName, std::less<>>& table() {
  static const auto all = [] {
    std::map<std::string, UnitName, std::less<>> names;
    for (const Refused& each : refused)
      for (const std::string& name : split_words(each.names))
        names.emplace(name, UnitName{UnitName::Verdict::refused, each.instead});
    add_all(names, with_prefix_symbol, "", true, false);
    add_all(names, with_prefix_word, "s", false, true);
    add_all(names, with_prefix_word_no_plural, "", false, true);
    add_all(names, symbols, "", false, false);
    add_all(names, words, "s", false, false);
    return names;
  }();
  return all;
}

}  // namespace

UnitName unit_name(std::string_view name) {
  const auto found = table().find(name);
  return found == table().end() ? UnitName{} : found->second;
}

std::vector<std::string> accepted_unit_names() {
  std::vector<std::string> names;
  for (const auto& [name, what] : table())
    if (what.verdict == UnitName::Verdict::accepted) names.push_back(name);
  return names;
}

}  // namespace beadwork
