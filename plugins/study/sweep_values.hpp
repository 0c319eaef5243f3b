#pragma once
// The values that a sweep gives its parameters: lists, ranges, and samples of ranges.

#include <fmt/format.h>

#include <algorithm>
#include <boost/random/sobol.hpp>
#include <cmath>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "core/base/units.hpp"

namespace beadwork::sweeps {

/// What is wrong with a text of the deck, in words.
struct Wrong : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// `name = what`, as it stands between semicolons.
struct Clause {
  std::string name, what;
};

inline std::vector<Clause> clauses(const std::string& text) {
  std::vector<Clause> all;
  for (const std::string& piece : split(text, ';')) {
    const std::size_t equals = piece.find('=');
    if (trim(piece).empty()) continue;
    Clause clause;
    if (equals != std::string::npos)
      clause = {std::string(trim(piece.substr(0, equals))), std::string(trim(piece.substr(equals + 1)))};
    if (clause.name.empty() || clause.what.empty())
      throw Wrong("wants name = values, several separated by semicolons, got \"" + std::string(trim(piece)) + "\"");
    all.push_back(clause);
  }
  if (all.empty()) throw Wrong("is empty");
  return all;
}

inline Amount bound_of(const std::string& text) {
  if (auto amount = parse_amount(text)) return *std::move(amount);
  throw Wrong("wants a number with its unit, such as 30 GPa, at either end of a range, got \"" +
              std::string(trim(text)) + "\"");
}

/// `from to until`, both in the unit of the first.
struct Range {
  std::string name;
  double from = 0, to = 0;
  std::string unit;
  bool logarithmic = false;

  double at(double share) const { return logarithmic ? from * std::pow(to / from, share) : from + share * (to - from); }
  /// Rounded to twelve digits, so that a step of 0.02 is called so.
  std::string text(double value) const {
    return format_number(*parse_number(fmt::format("{:.12g}", value))) + (unit.empty() ? "" : " " + unit);
  }
};

inline Range range_between(const std::string& name, const std::string& from, const std::string& to, bool logarithmic) {
  const Amount low = bound_of(from), high = bound_of(to);
  if (!(low.unit.dimension == high.unit.dimension))
    throw Wrong("has a range of '" + name + "' between two kinds of quantity, \"" + from + "\" and \"" + to + "\"");
  Range range{name, low.value, low.unit.from_si(high.quantity().value), low.unit_name, logarithmic};
  if (range.from == range.to)
    throw Wrong("has an empty range of '" + name + "': it begins and ends at \"" + from + "\"");
  if (logarithmic && !(range.from * range.to > 0))
    throw Wrong("has a logarithmic range of '" + name + "' whose ends are not both positive");
  return range;
}

/// "a to b": the two ends; nothing if the text is no range. A trailing word "log" makes it logarithmic.
inline std::optional<Range> range_of(const std::string& name, std::string what) {
  bool logarithmic = false;
  if (const auto words = split_words(what); words.size() > 1 && words.back() == "log") {
    logarithmic = true;
    what = std::string(trim(what.substr(0, what.rfind("log"))));
  }
  const std::size_t to = what.find(" to ");
  if (to == std::string::npos) return std::nullopt;
  return range_between(name, std::string(trim(what.substr(0, to))), std::string(trim(what.substr(to + 4))),
                       logarithmic);
}

/// A list, "1 mm, 2 mm", or a range in equal steps, "1 mm to 3 mm in 5" or "1 to 100 in 3 log".
inline std::vector<std::string> values_of(const Clause& clause) {
  std::string what = clause.what;
  const bool logarithmic = what.size() > 4 && what.ends_with(" log");
  if (logarithmic) what = std::string(trim(what.substr(0, what.size() - 4)));
  const std::size_t in = what.rfind(" in ");
  if (what.find(" to ") != std::string::npos && what.find(',') == std::string::npos) {
    const auto count = in == std::string::npos ? std::nullopt : parse_number(trim(what.substr(in + 4)));
    if (!count || *count != std::floor(*count) || *count < 2 || *count > 1e6)
      throw Wrong("wants a range of '" + clause.name +
                  "' as \"from to until in count\", with a count of at least 2, got \"" + clause.what + "\"");
    const auto range = range_of(clause.name, what.substr(0, in) + (logarithmic ? " log" : ""));
    std::vector<std::string> values;
    for (int k = 0; k < static_cast<int>(*count); ++k) values.push_back(range->text(range->at(k / (*count - 1))));
    return values;
  }
  std::vector<std::string> values;
  for (const std::string& value : split(clause.what, ',')) {
    values.emplace_back(trim(value));
    if (values.back().empty()) throw Wrong("has an empty value of '" + clause.name + "'");
    if (std::count(values.begin(), values.end(), values.back()) > 1)
      throw Wrong("has the value \"" + values.back() + "\" of '" + clause.name + "' twice");
  }
  return values;
}

/// "1 2 5" as it is, "1 to 5" as 1 2 3 4 5.
inline std::vector<std::string> seeds_of(const std::vector<std::string>& words) {
  if (words.size() != 3 || words[1] != "to") return words;
  const auto first = parse_number(words[0]), last = parse_number(words[2]);
  const bool are_whole = first && last && *first == std::floor(*first) && *last == std::floor(*last) && *first >= 0;
  if (!are_whole || *last < *first || *last - *first > 1e6)
    throw Wrong("wants two whole numbers around \"to\", the smaller one first, got \"" + join(words, " ") + "\"");
  std::vector<std::string> seeds;
  for (double seed = *first; seed <= *last; ++seed) seeds.push_back(format_number(seed));
  return seeds;
}

/// Points of the unit cube, one row each: Sobol's sequence, from its first point on (Boost, directions of Joe and Kuo).
inline std::vector<std::vector<double>> sobol(std::size_t points, std::size_t dimensions) {
  boost::random::sobol sequence(dimensions);
  std::vector<std::vector<double>> rows(points, std::vector<double>(dimensions));
  for (auto& row : rows)
    for (double& x : row) x = static_cast<double>(sequence() >> 11) * 0x1p-53;
  return rows;
}

/// The same by a Latin hypercube: each axis is cut into as many slices as there are points, and each slice holds one.
inline std::vector<std::vector<double>> latin_hypercube(std::size_t points, const std::vector<Range>& ranges,
                                                        std::uint64_t seed) {
  std::vector<std::vector<double>> rows(points, std::vector<double>(ranges.size()));
  for (std::size_t d = 0; d < ranges.size(); ++d) {
    Random random(seed, stream_of("latin-hypercube." + ranges[d].name));
    std::vector<std::size_t> slice(points);
    std::iota(slice.begin(), slice.end(), std::size_t{0});
    for (std::size_t k = points; k > 1; --k)
      std::swap(slice[k - 1], slice[static_cast<std::size_t>(random.uniform() * static_cast<double>(k))]);
    for (std::size_t k = 0; k < points; ++k)
      rows[k][d] = (static_cast<double>(slice[k]) + random.uniform()) / static_cast<double>(points);
  }
  return rows;
}

/// Parameters whose values go together: each row has one of each.
struct Block {
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> rows;
};

/// All pairings of the rows of two blocks, those of the second varying fastest.
inline Block times(const Block& first, const Block& second) {
  Block both{first.names, {}};
  both.names.insert(both.names.end(), second.names.begin(), second.names.end());
  for (const auto& a : first.rows)
    for (const auto& b : second.rows) {
      both.rows.push_back(a);
      both.rows.back().insert(both.rows.back().end(), b.begin(), b.end());
    }
  return both;
}

}  // namespace beadwork::sweeps
