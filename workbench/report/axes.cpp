#include "workbench/report/axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "workbench/report/chart.hpp"
#include "workbench/report/text.hpp"

namespace beadwork::report {

Range range_of(const std::vector<double>& values) {
  Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const double v : values)
    if (std::isfinite(v)) range = {std::min(range.low, v), std::max(range.high, v)};
  return range.low > range.high ? Range{0, 0} : range;
}

Range united(const Range& a, const Range& b) { return {std::min(a.low, b.low), std::max(a.high, b.high)}; }

Range padded(Range range) {
  if (range.low < 0 && -range.low < 0.03 * range.high) range.low = 0;  // noise about zero
  if (range.low > 0 && range.low < 0.5 * range.high) range.low = 0;
  if (range.high < 0 && range.high > 0.5 * range.low) range.high = 0;
  double room = 0.05 * range.span();
  if (!(range.span() > 1e-9 * std::max(std::abs(range.low), std::abs(range.high))))
    room = range.high == 0 ? 1 : 0.1 * std::abs(range.high);
  return {range.low == 0 ? (range.high > 0 ? 0 : -room) : range.low - room,
          range.high == 0 && range.low < 0 ? 0 : range.high + room};
}

std::vector<double> ticks(double from, double to, int wanted) {
  const double span = to - from;
  if (!(span > 0) || !std::isfinite(span) || wanted < 1) return {from};
  const double rough = span / wanted;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const double nice : {1.0, 2.0, 5.0})
    if (nice * power >= rough * 0.999) {
      step = nice * power;
      break;
    }
  if (!(std::abs(from / step) < 1e15)) return {from};  // no room between neighbouring numbers
  std::vector<double> out;
  for (auto k = static_cast<std::int64_t>(std::ceil(from / step - 1e-9));
       static_cast<double>(k) * step <= to + 1e-9 * step; ++k)
    out.push_back(static_cast<double>(k) * step);
  return out;
}

std::string Axes::svg() const {
  std::string out = "<g class=\"axes\">";
  const double base = height - bottom;
  for (const double v : ticks(y.low, y.high, 5))
    out += fmt::format(
        "<line class=\"grid{4}\" x1=\"{0}\" x2=\"{1}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\"/><text class=\"tick\" x=\"{3}\" "
        "y=\"{2:.1f}\" dy=\".35em\" text-anchor=\"end\">{5}</text>",
        left, width - right, down(v), left - 9, v == 0 ? " zero" : "", number(v));
  for (const double v : ticks(x.low, x.high, 8))
    out += fmt::format(
        "<line class=\"grid\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/><text class=\"tick\" x=\"{0:.1f}\" "
        "y=\"{3}\" text-anchor=\"middle\">{4}</text>",
        across(v), top, base, base + 19, number(v));
  out += fmt::format("<line class=\"base\" x1=\"{}\" x2=\"{}\" y1=\"{}\" y2=\"{}\"/>", left, width - right, base, base);
  out += fmt::format("<text class=\"label\" x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
                     0.5 * (left + width - right), height - 9, escaped(x_label));
  out += fmt::format("<text class=\"label\" x=\"{}\" y=\"{}\">{}</text></g>", 4, 13, escaped(y_label));
  return out;
}

}  // namespace beadwork::report
