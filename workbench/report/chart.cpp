#include "workbench/report/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "workbench/report/axes.hpp"
#include "workbench/report/text.hpp"

namespace beadwork::report {

namespace {

constexpr std::size_t most_points = 900;
constexpr std::size_t most_probes = 110;

/// References may run far beyond what the run reached (a hyperbola near zero), so the run sets the scale.
Range height_of(const Chart& chart) {
  Range run{0, 0}, all{0, 0};
  bool first_run = true, first_all = true;
  for (const Series& s : chart.series) {
    const Range r = range_of(s.y);
    all = std::exchange(first_all, false) ? r : united(all, r);
    if (!s.reference) run = std::exchange(first_run, false) ? r : united(run, r);
  }
  if (first_run) return padded(all);
  const double room = 0.3 * std::max(run.span(), 1e-300);
  return padded({std::max(all.low, run.low - room), std::min(all.high, run.high + room)});
}

Range width_of(const Chart& chart) {
  Range range{0, 0};
  bool first = true;
  for (const Series& s : chart.series)
    if (!s.reference) range = std::exchange(first, false) ? range_of(s.x) : united(range, range_of(s.x));
  if (first)
    for (const Series& s : chart.series)
      range = std::exchange(first, false) ? range_of(s.x) : united(range, range_of(s.x));
  if (!(range.span() > 0)) return padded(range);
  return range;
}

std::string path_of(const Series& s, const Axes& axes) {
  std::string path;
  bool down = false;
  for (const std::size_t i : thinned(s.y, most_points)) {
    if (!std::isfinite(s.x[i]) || !std::isfinite(s.y[i])) {
      down = false;
      continue;
    }
    path += fmt::format("{}{:.1f} {:.1f}", std::exchange(down, true) ? "L" : "M", axes.across(s.x[i]),
                        std::clamp(axes.down(s.y[i]), -2000.0, 2400.0));
  }
  return path;
}

std::string line_of(const Series& s, const Axes& axes) {
  return fmt::format("<path class=\"line s{}{}\" d=\"{}\"/>", s.color, s.stroke == Stroke::dashed ? " dashed" : "",
                     path_of(s, axes));
}

/// Areas share their rows: one thinning for all, or their edges would not meet.
std::string areas_of(const Chart& chart, const Axes& axes) {
  std::string out;
  std::vector<double> floor;
  for (const Series& s : chart.series) {
    if (s.stroke != Stroke::solid) continue;
    floor.resize(s.y.size(), 0);
    const std::size_t stride = std::max<std::size_t>(1, s.y.size() / most_points);
    std::string above, below;
    for (std::size_t k = 0; k < s.y.size(); k += stride) {
      const std::size_t i = k + stride < s.y.size() ? k : s.y.size() - 1;
      const double height = std::isfinite(s.y[i]) ? s.y[i] : 0;
      above +=
          fmt::format("{}{:.1f} {:.1f}", above.empty() ? "M" : "L", axes.across(s.x[i]), axes.down(floor[i] + height));
      below = fmt::format("L{:.1f} {:.1f}", axes.across(s.x[i]), axes.down(floor[i])) + below;
    }
    for (std::size_t i = 0; i < s.y.size(); ++i) floor[i] += std::isfinite(s.y[i]) ? s.y[i] : 0;
    out += fmt::format("<path class=\"area s{}\" d=\"{}{}Z\"/>", s.color, above, below);
  }
  return out;
}

std::string readout(const Chart& chart, const Series& first, std::size_t i) {
  std::string text = chart.x_name + " " + number(first.x[i]) + (chart.x_unit.empty() ? "" : " " + chart.x_unit);
  for (const Series& s : chart.series)
    if (s.x.size() == first.x.size() && i < s.y.size()) text += "  ·  " + s.label + " " + number(s.y[i]);
  return text;
}

/// Where the pointer rests: a guide line, a dot on each curve, and the values; all in the style sheet's
/// :hover.
std::string probes_of(const Chart& chart, const Axes& axes) {
  const auto first = std::find_if(chart.series.begin(), chart.series.end(),
                                  [](const Series& s) { return !s.reference && !s.x.empty(); });
  if (first == chart.series.end()) return "";
  const bool rising = std::is_sorted(first->x.begin(), first->x.end());
  const std::size_t rows = first->x.size(), probes = std::min(rows, most_probes);
  const double base = Axes::height - Axes::bottom;
  std::string out = "<g class=\"probes\">";
  for (std::size_t p = 0; p < probes; ++p) {
    const std::size_t i = probes == 1 ? 0 : p * (rows - 1) / (probes - 1);
    if (!std::isfinite(first->x[i]) || !std::isfinite(first->y[i])) continue;
    const double x = axes.across(first->x[i]);
    const double half = rising ? 0.5 * (Axes::width - Axes::left - Axes::right) / static_cast<double>(probes) + 0.5 : 7;
    const double top = rising ? Axes::top : axes.down(first->y[i]) - 7;
    out += fmt::format("<g><rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>", x - half, top,
                       2 * half, rising ? base - top : 14);
    out += fmt::format("<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/>", x, Axes::top, base);
    if (!chart.stacked)
      for (const Series& s : chart.series)
        if (s.x.size() == rows && std::isfinite(s.y[i]) && s.y[i] >= axes.y.low && s.y[i] <= axes.y.high)
          out += fmt::format("<circle class=\"s{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\"/>", s.color,
                             axes.across(s.x[i]), axes.down(s.y[i]));
    const std::string text = escaped(readout(chart, *first, i));
    out += fmt::format("<text x=\"{}\" y=\"13\" text-anchor=\"end\">{}</text><title>{}</title></g>",
                       Axes::width - Axes::right, text, text);
  }
  return out + "</g>";
}

std::string markers_of(const Chart& chart, const Axes& axes) {
  std::string out;
  if (chart.series.empty()) return out;
  const Series& s = chart.series.front();
  for (const Marker& marker : chart.markers) {
    if (marker.row >= s.x.size() || !std::isfinite(s.x[marker.row]) || !std::isfinite(s.y[marker.row])) continue;
    out += fmt::format(
        "<g class=\"marker\"><circle cx=\"{0:.1f}\" cy=\"{1:.1f}\" r=\"8\"/><text x=\"{0:.1f}\" y=\"{1:.1f}\" "
        "dy=\".36em\" text-anchor=\"middle\">{2}</text></g>",
        axes.across(s.x[marker.row]), axes.down(s.y[marker.row]), escaped(marker.label));
  }
  return out;
}

/// The side of a reference that lies beyond the drawing: the row at which it leaves or comes back, and how far it goes.
struct Leaving {
  std::size_t row;
  double farthest;
};

std::optional<Leaving> leaving_of(const Series& s, const Axes& axes, bool upwards) {
  std::optional<Leaving> found;
  bool was_beyond = false;
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    if (!std::isfinite(s.y[i]) || s.x[i] < axes.x.low || s.x[i] > axes.x.high) continue;
    const bool beyond = upwards ? s.y[i] > axes.y.high : s.y[i] < axes.y.low;
    if (beyond && !found) found = {i, s.y[i]};
    if (beyond) found->farthest = upwards ? std::max(found->farthest, s.y[i]) : std::min(found->farthest, s.y[i]);
    if (was_beyond && !beyond && found->row == 0) found->row = i;  // it came from outside
    was_beyond = beyond;
  }
  return found;
}

/// An arrow on the edge, and how far the reference goes: a line that just ends would look like the whole.
std::string leavings_of(const Chart& chart, const Axes& axes) {
  std::string out;
  for (const Series& s : chart.series) {
    if (!s.reference) continue;
    for (const bool upwards : {true, false}) {
      const auto leaving = leaving_of(s, axes, upwards);
      if (!leaving) continue;
      const double across = axes.across(s.x[leaving->row]);
      out += fmt::format(
          "<text class=\"leaves\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{} {} goes on to {}</text>", across,
          upwards ? Axes::top + 10 : Axes::height - Axes::bottom - 5, across > 0.5 * Axes::width ? "end" : "start",
          upwards ? "↑" : "↓", escaped(s.label), number(leaving->farthest, 3));
    }
  }
  return out;
}

std::string legend_of(const Chart& chart) {
  if (chart.series.size() == 1 && !chart.y_label.empty()) return "<div class=\"legend\"></div>";  // the axis says it
  std::string out = "<div class=\"legend\">";
  for (const Series& s : chart.series) {
    const char* kind = s.stroke == Stroke::dashed ? "dashed" : chart.stacked ? "block" : "stroke";
    out += fmt::format("<span><i class=\"key {} s{}\"></i>{}</span>", kind, s.color, escaped(s.label));
  }
  return out + "</div>";
}

std::string frame(const std::string& title, const std::string& legend, const std::string& drawing) {
  return fmt::format(
      "<figure class=\"chart\"><figcaption>{}</figcaption>{}<svg viewBox=\"0 0 {} {}\" "
      "role=\"img\">{}</svg></figure>\n",
      escaped(title), legend, Axes::width, Axes::height, drawing);
}

Axes axes_of(const Chart& chart) {
  Axes axes{width_of(chart), height_of(chart), chart.x_label, chart.y_label};
  if (!chart.stacked) return axes;
  std::vector<double> total;
  Range range = axes.y;
  for (const Series& s : chart.series) {
    if (s.stroke != Stroke::solid) continue;
    total.resize(s.y.size(), 0);
    for (std::size_t i = 0; i < s.y.size(); ++i) total[i] += std::isfinite(s.y[i]) ? s.y[i] : 0;
  }
  range = united(range, padded(range_of(total)));
  axes.y = {range.low > -0.03 * range.high ? 0 : range.low, range.high};
  return axes;
}

}  // namespace

std::vector<std::size_t> thinned(const std::vector<double>& y, std::size_t most) {
  std::vector<std::size_t> keep;
  const std::size_t bins = std::max<std::size_t>(1, most / 4);
  const std::size_t size = y.size() <= most ? 1 : (y.size() + bins - 1) / bins;
  for (std::size_t start = 0; start < y.size(); start += size) {
    const std::size_t end = std::min(start + size, y.size());
    std::array<std::size_t, 4> bin = {start, start, start, end - 1};
    for (std::size_t i = start; i < end; ++i) {
      if (!std::isfinite(y[i])) bin[1] = i;  // a gap must stay one
      if (y[i] < y[bin[1]]) bin[1] = i;
      if (y[i] > y[bin[2]]) bin[2] = i;
    }
    std::sort(bin.begin(), bin.end());
    for (const std::size_t i : bin)
      if (keep.empty() || keep.back() != i) keep.push_back(i);
  }
  return keep;
}

std::string figure(const Chart& chart) {
  const Axes axes = axes_of(chart);
  std::string out = axes.svg();
  // An inner drawing clips what it holds, and unlike a clip path it needs no name that is unique on the page.
  out += fmt::format("<svg x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{3}\" viewBox=\"{0} {1} {2} {3}\">", Axes::left,
                     Axes::top - 2, Axes::width - Axes::left - Axes::right + 2,
                     Axes::height - Axes::top - Axes::bottom + 4);
  if (chart.stacked) out += areas_of(chart, axes);
  for (const Stroke stroke : {Stroke::dashed, Stroke::solid})
    for (const Series& s : chart.series)
      if (s.stroke == stroke && !(chart.stacked && stroke == Stroke::solid)) out += line_of(s, axes);
  out += "</svg>" + leavings_of(chart, axes) + markers_of(chart, axes) + probes_of(chart, axes);
  return frame(chart.title, legend_of(chart), out);
}

std::string figure(const Bars& bars) {
  if (bars.heights.empty() || bars.edges.size() != bars.heights.size() + 1) return "";
  const Axes axes{range_of(bars.edges), padded(united({0, 0}, range_of(bars.heights))), bars.x_label, bars.y_label};
  std::string out = axes.svg();
  for (std::size_t i = 0; i < bars.heights.size(); ++i) {
    const double left = axes.across(bars.edges[i]), right = axes.across(bars.edges[i + 1]);
    const double top = axes.down(bars.heights[i]);
    out += fmt::format(
        "<rect class=\"bar\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"><title>{} to {}: "
        "{}</title></rect>",
        left + 1, top, std::max(0.5, right - left - 2), std::max(0.0, axes.down(0) - top), number(bars.edges[i]),
        number(bars.edges[i + 1]), number(bars.heights[i]));
  }
  return frame(bars.title, "", out);
}

}  // namespace beadwork::report
