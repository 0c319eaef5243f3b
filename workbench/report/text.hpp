#pragma once
// Numbers and text as a reader of the report sees them.

#include <cstdint>
#include <string>
#include <string_view>

namespace beadwork::report {

/// Text of decks, logs and file names may hold anything; none of it may become markup.
std::string escaped(std::string_view);

/// Four significant digits: "0.2333", "40 000", "5 x 10^-8" with real superscripts. "-" if not finite.
std::string number(double value, int significant = 4);
std::string count(std::int64_t);                             ///< digits in groups of three
std::string duration(double seconds);                        ///< "20 min 34 s"
std::string percent(double share);                           ///< "1.2 %"
std::string plural(std::int64_t n, const std::string& one);  ///< "1 frame", "3 frames"

/// "bond_updates_per_second" -> "bond updates per second"
std::string spaced(std::string_view name);

/// The factor and the unit in which values up to `largest` read well: 0.0016 m -> {1000, "mm"}.
struct Scale {
  double factor = 1;
  std::string unit;
};
Scale readable(const std::string& unit, double largest);

/// "force [N]"; a plain number has no brackets.
std::string with_unit(const std::string& name, const std::string& unit);

std::string base64(const void* data, std::size_t size);

}  // namespace beadwork::report
