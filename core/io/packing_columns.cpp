#include "core/io/packing_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

#include "core/base/text.hpp"

namespace beadwork {

namespace {

const std::map<std::string, Holds, std::less<>> known_names{
    {"x", Holds::x},           {"y", Holds::y},        {"z", Holds::z},        {"r", Holds::radius},
    {"radius", Holds::radius}, {"rad", Holds::radius}, {"d", Holds::diameter}, {"diameter", Holds::diameter},
    {"diam", Holds::diameter}, {"set", Holds::set},    {"group", Holds::set},  {"id", Holds::id}};

Holds meaning_of(std::string_view name) {
  std::string lower(name);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  const auto found = known_names.find(lower);
  return found == known_names.end() ? Holds::other : found->second;
}

bool is_length(Holds holds) { return holds != Holds::set && holds != Holds::id && holds != Holds::other; }

std::optional<Unit> unit_of_length(std::string_view name) {
  if (name.empty()) return std::nullopt;
  const auto unit = find_unit(name);
  return unit && unit->dimension == find_unit("m")->dimension ? unit : std::nullopt;
}

std::string_view unquoted(std::string_view text) {
  text = trim(text);
  if (text.size() >= 2 && text.front() == text.back() && (text.front() == '"' || text.front() == '\''))
    text = trim(text.substr(1, text.size() - 2));
  return text;
}

/// The name and the unit of "x [mm]", "x (mm)", "x/mm"; the unit is empty where there is none.
std::pair<std::string_view, std::string_view> parts_of(std::string_view text) {
  constexpr std::string_view open = "[({", close = "])}";
  const auto bracket = text.empty() ? std::string_view::npos : close.find(text.back());
  if (bracket != std::string_view::npos) {
    const auto at = text.rfind(open[bracket]);
    if (at != std::string_view::npos)
      return {trim(text.substr(0, at)), trim(text.substr(at + 1, text.size() - at - 2))};
  }
  const auto slash = text.find('/');
  if (slash != std::string_view::npos) return {trim(text.substr(0, slash)), trim(text.substr(slash + 1))};
  return {text, {}};
}

}  // namespace

Heading heading_of(std::string_view text) {
  auto [name, unit_name] = parts_of(unquoted(text));
  // In x_mm the unit is told from the name by both being known.
  if (const auto low = name.rfind('_'); unit_name.empty() && low != std::string_view::npos &&
                                        is_length(meaning_of(name.substr(0, low))) &&
                                        unit_of_length(name.substr(low + 1)))
    std::tie(name, unit_name) = std::pair{name.substr(0, low), name.substr(low + 1)};
  Heading heading{meaning_of(name), std::string(name), std::string(unit_name)};
  if (!is_length(heading.holds) || unit_name.empty()) return heading;
  heading.unit = unit_of_length(unit_name);
  if (!heading.unit)
    throw std::invalid_argument(
        fmt::format("column '{}' wants a unit of length such as [mm], got \"{}\"", name, unit_name));
  return heading;
}

std::string why_no_element(const std::vector<Heading>& columns) {
  const auto count = [&](auto... any) {
    return std::count_if(columns.begin(), columns.end(), [&](const Heading& h) { return ((h.holds == any) || ...); });
  };
  const std::pair<const char*, std::ptrdiff_t> wanted[] = {
      {"x", count(Holds::x)},
      {"y", count(Holds::y)},
      {"z", count(Holds::z)},
      {"radius (r) or diameter (d)", count(Holds::radius, Holds::diameter)}};
  std::vector<std::string> missing, twice;
  for (const auto& [name, times] : wanted) {
    if (times == 0) missing.emplace_back(name);
    if (times > 1) twice.emplace_back(name);
  }
  if (count(Holds::set) > 1) twice.emplace_back("set");
  if (!missing.empty()) return "the columns lack " + join(missing);
  if (!twice.empty()) return "the columns name " + join(twice) + " more than once";
  return "";
}

std::vector<Heading> usual_columns() {
  return {{Holds::x, "x"}, {Holds::y, "y"}, {Holds::z, "z"}, {Holds::radius, "radius"}};
}

}  // namespace beadwork
