#include "core/plugin/reading.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/text.hpp"

namespace beadwork {

const char* const reading_phrases =
    "\"largest force\", \"last force\", \"displacement at the largest force\", \"force at displacement 0.14 um\", "
    "\"displacement where force rises above 2 N\" or \"... above 90 percent of its largest\", \"... falls below ...\", "
    "\"slope of force over displacement from 0 um to 0.1 um\", \"mean force for displacement from 1 mm to 2 mm\"";

namespace {

/// What stands before and behind a word of the text.
struct Cut {
  std::string before, behind;
};

std::optional<Cut> cut(const std::string& text, std::string_view word, bool at_last = false) {
  const std::size_t place = at_last ? text.rfind(word) : text.find(word);
  if (place == std::string::npos) return std::nullopt;
  Cut both{std::string(trim(text.substr(0, place))), std::string(trim(text.substr(place + word.size())))};
  if (both.before.empty() || both.behind.empty()) return std::nullopt;
  return both;
}

std::optional<std::string> behind(const std::string& text, std::string_view start) {
  if (!text.starts_with(start)) return std::nullopt;
  std::string rest(trim(text.substr(start.size())));
  if (rest.empty()) return std::nullopt;
  return rest;
}

/// "force over displacement from 0 um to 1 um", with the word that stands between the columns.
std::optional<Reading> parse_between(Reading::How how, const std::string& text, std::string_view word) {
  const auto ends = cut(text, " from ", true);
  const auto columns = ends ? cut(ends->before, word) : std::nullopt;
  const auto bounds = ends ? cut(ends->behind, " to ") : std::nullopt;
  const auto from = bounds ? parse_amount(bounds->before) : std::nullopt;
  const auto to = bounds ? parse_amount(bounds->behind) : std::nullopt;
  if (!columns || !from || !to || !(from->unit.dimension == to->unit.dimension)) return std::nullopt;
  if (!(from->quantity().value < to->quantity().value)) return std::nullopt;
  return Reading{how, columns->before, columns->behind, *from, *to, false, {}};
}

std::optional<Reading> parse_threshold(Reading::How how, const Cut& columns, const std::string& word) {
  auto sides = cut(columns.behind, word);
  if (!sides) return std::nullopt;
  Reading reading{how, columns.before, sides->before, {}, {}, false, {}};
  constexpr std::string_view share = " of its largest";
  reading.of_largest = sides->behind.ends_with(share);
  if (reading.of_largest) sides->behind.resize(sides->behind.size() - share.size());
  const auto threshold = parse_amount(sides->behind);
  if (!threshold || (reading.of_largest && !threshold->unit.dimension.is_plain())) return std::nullopt;
  reading.from = *threshold;
  return reading;
}

/// "displacement 0.14 um": a column and a value of it.
std::optional<Reading> parse_at(const Cut& sides) {
  for (std::size_t blank = sides.behind.find(' '); blank != std::string::npos;
       blank = sides.behind.find(' ', blank + 1))
    if (const auto value = parse_amount(sides.behind.substr(blank)))
      return Reading{
          Reading::How::at, sides.before, std::string(trim(sides.behind.substr(0, blank))), *value, {}, false, {}};
  return std::nullopt;
}

std::optional<Reading> parse_plain(const std::string& text) {
  using How = Reading::How;
  if (const auto rest = behind(text, "slope of ")) return parse_between(How::slope, *rest, " over ");
  if (const auto rest = behind(text, "mean ")) return parse_between(How::mean, *rest, " for ");
  if (const auto columns = cut(text, " where ")) {
    if (auto reading = parse_threshold(How::rises, *columns, " rises above ")) return reading;
    return parse_threshold(How::falls, *columns, " falls below ");
  }
  if (const auto columns = cut(text, " at the largest "))
    return Reading{How::at_largest, columns->before, columns->behind, {}, {}, false, {}};
  if (const auto sides = cut(text, " at ")) return parse_at(*sides);
  if (const auto column = behind(text, "largest ")) return Reading{How::largest, *column, {}, {}, {}, false, {}};
  if (const auto column = behind(text, "last ")) return Reading{How::last, *column, {}, {}, {}, false, {}};
  return std::nullopt;
}

/// Two columns of a curve in SI, without the rows in which either has a gap.
struct Points {
  std::vector<double> x, y;
  std::size_t size() const { return x.size(); }
  std::size_t largest() const {
    return static_cast<std::size_t>(
        std::max_element(y.begin(), y.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }) - y.begin());
  }
};

Points points_of(const CurveValues& x, const CurveValues& y) {
  const Unit of_x = find_unit(x.unit).value_or(Unit{}), of_y = find_unit(y.unit).value_or(Unit{});
  Points points;
  for (std::size_t k = 0; k < std::min(x.values.size(), y.values.size()); ++k) {
    if (!std::isfinite(x.values[k]) || !std::isfinite(y.values[k])) continue;
    points.x.push_back(of_x.to_si(x.values[k]));
    points.y.push_back(of_y.to_si(y.values[k]));
  }
  return points;
}

std::optional<double> value_at(const Points& points, double x) {
  for (std::size_t k = 1; k < points.size(); ++k) {
    const double a = points.x[k - 1], b = points.x[k];
    if ((x - a) * (x - b) > 0) continue;
    return a == b ? points.y[k] : points.y[k - 1] + (points.y[k] - points.y[k - 1]) * (x - a) / (b - a);
  }
  return std::nullopt;
}

std::optional<double> crossing(const Points& points, const Reading& reading) {
  const std::size_t top = points.largest();
  const double sign = reading.of_largest && points.y[top] < 0 ? -1 : 1;  // of a force that presses
  const double threshold = reading.from.quantity().value * (reading.of_largest ? std::abs(points.y[top]) : 1);
  const bool rises = reading.how == Reading::How::rises;
  for (std::size_t k = rises ? 0 : top; k < points.size(); ++k)
    if (rises ? sign * points.y[k] > threshold : sign * points.y[k] < threshold) return points.x[k];
  return std::nullopt;
}

/// The first way from one bound to the other, with both ends between rows; rows that go back are left out. Nothing if
/// the curve does not come from the one to the other.
std::optional<Points> between(const Points& all, const Reading& reading) {
  const double from = reading.from.quantity().value, to = reading.to.quantity().value;
  Points inside;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const bool is_begun = inside.size() > 0;
    if (!is_begun && (k == 0 ? all.x[k] != from : all.x[k - 1] > from || all.x[k] < from)) continue;
    if (!is_begun) {
      inside.x.push_back(from);
      inside.y.push_back(*value_at({{all.x[k ? k - 1 : 0], all.x[k]}, {all.y[k ? k - 1 : 0], all.y[k]}}, from));
    }
    if (all.x[k] >= to) {
      const double last = *value_at({{all.x[k ? k - 1 : 0], all.x[k]}, {all.y[k ? k - 1 : 0], all.y[k]}}, to);
      inside.x.push_back(to);
      inside.y.push_back(last);
      return inside;
    }
    if (all.x[k] > inside.x.back()) {
      inside.x.push_back(all.x[k]);
      inside.y.push_back(all.y[k]);
    }
  }
  return std::nullopt;
}

std::optional<double> slope_of(const Points& points) {
  const auto n = static_cast<double>(points.size());
  double x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t k = 0; k < points.size(); ++k) x += points.x[k] / n, y += points.y[k] / n;
  for (std::size_t k = 0; k < points.size(); ++k) {
    xx += (points.x[k] - x) * (points.x[k] - x);
    xy += (points.x[k] - x) * (points.y[k] - y);
  }
  if (!(xx > 0)) return std::nullopt;
  return xy / xx;
}

std::optional<double> mean_of(const Points& points) {
  double way = 0, area = 0;
  for (std::size_t k = 1; k < points.size(); ++k) {
    const double step = std::abs(points.x[k] - points.x[k - 1]);
    way += step;
    area += step * (points.y[k] + points.y[k - 1]) / 2;
  }
  if (!(way > 0)) return std::nullopt;
  return area / way;
}

std::optional<double> number_of(const Points& points, const Reading& reading) {
  switch (reading.how) {
    case Reading::How::largest: return points.y[points.largest()];
    case Reading::How::last: return points.y.back();
    case Reading::How::at_largest: return points.x[points.largest()];
    case Reading::How::at: return value_at(points, reading.from.quantity().value);
    case Reading::How::rises:
    case Reading::How::falls: return crossing(points, reading);
    case Reading::How::slope:
    case Reading::How::mean: break;
  }
  const auto inside = between(points, reading);
  if (!inside) return std::nullopt;
  return reading.how == Reading::How::slope ? slope_of(*inside) : mean_of(*inside);
}

/// The columns that are x and y for `number_of`: where a place is read, the place is x.
struct Columns {
  const CurveValues *x = nullptr, *y = nullptr;
};

Columns columns_of(const CurveTable& curve, const Reading& reading) {
  using How = Reading::How;
  const CurveValues* read = curve.find(reading.column);
  const CurveValues* other = reading.against.empty() ? read : curve.find(reading.against);
  const bool reads_place = reading.how == How::at_largest || reading.how == How::rises || reading.how == How::falls;
  return reads_place ? Columns{read, other} : Columns{other, read};
}

bool fits(const Amount& bound, const CurveValues& column) {
  const auto unit = find_unit(column.unit);
  return unit && (unit->dimension == bound.unit.dimension || (bound.value == 0 && bound.unit_name.empty()));
}

}  // namespace

std::optional<Reading> parse_reading(const std::string& text) {
  auto reading = parse_plain(std::string(trim(text)));
  if (reading) reading->text = trim(text);
  return reading;
}

NumberRead read_from(const CurveTable& curve, const Reading& reading) {
  using How = Reading::How;
  const auto not_there = [](std::string reason) {
    return NumberRead{NumberRead::Why::not_there, {}, std::move(reason)};
  };
  for (const std::string& name : {reading.column, reading.against})
    if (!name.empty() && !curve.find(name)) return not_there("there is no column '" + name + "'");
  const Columns columns = columns_of(curve, reading);
  const bool on_x = reading.how == How::at || reading.how == How::slope || reading.how == How::mean;
  const bool on_y = (reading.how == How::rises || reading.how == How::falls) && !reading.of_largest;
  if (const CurveValues* bounded = on_x ? columns.x : on_y ? columns.y : nullptr)
    if (!fits(reading.from, *bounded)) return not_there("'" + bounded->name + "' is in " + bounded->unit);
  const Points points = points_of(*columns.x, *columns.y);
  if (points.size() == 0) return not_there("the columns have no row with both numbers");
  const auto value = number_of(points, reading);
  if (!value) return {NumberRead::Why::not_reached, {}, "the curve does not come there"};
  const Dimension of_read = find_unit(curve.find(reading.column)->unit).value_or(Unit{}).dimension;
  const Dimension of_x = find_unit(columns.x->unit).value_or(Unit{}).dimension;
  return {NumberRead::Why::read, {*value, reading.how == How::slope ? of_read / of_x : of_read}, {}};
}

}  // namespace beadwork
