#include "workbench/report/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "workbench/report/axes.hpp"
#include "workbench/report/chart.hpp"
#include "workbench/report/text.hpp"

namespace beadwork::report {

namespace {

// The page's light colours, without variables, which few programs that draw SVG know.
constexpr std::string_view plain_style =
    "text { fill: #5c6878; font: 13px sans-serif; } .title { fill: #1c2430; font-size: 15px; font-weight: bold; } "
    ".paper { fill: #fff; } .grid { stroke: #e2e6ec; } .zero, .base { stroke: #aab3bf; stroke-width: 1.2; } "
    ".line { fill: none; stroke: #0072b2; stroke-width: 2; stroke-linejoin: round; }";

Scale scale_of(const PictureAxis& axis) {
  double most = 0;
  for (const double value : axis.values)
    if (std::isfinite(value)) most = std::max(most, std::abs(value));
  return readable(axis.unit, most);
}

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

// What a figure draws, without what only a pointer on a page brings to light.
std::string drawing_of(const std::string& figure) {
  const std::size_t begin = figure.find('>', figure.find("<svg")) + 1;
  return figure.substr(begin, std::min(figure.find("<g class=\"probes\">"), figure.rfind("</svg>")) - begin);
}

}  // namespace

std::string picture(const std::string& title, const PictureAxis& x, const PictureAxis& y) {
  const Scale across = scale_of(x), up = scale_of(y);
  Chart chart;
  chart.x_name = x.name;
  chart.x_unit = across.unit;
  chart.x_label = with_unit(x.name, across.unit);
  chart.y_label = with_unit(y.name, up.unit);
  chart.series.push_back({y.name, scaled(x.values, across.factor), scaled(y.values, up.factor)});
  constexpr int room = 34;  // for the title
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 {} {} {}\" "
      "width=\"{}\" height=\"{}\">\n<style>{}</style>\n<rect class=\"paper\" x=\"0\" y=\"{}\" width=\"{}\" "
      "height=\"{}\"/>\n<text class=\"title\" x=\"{}\" y=\"-8\">{}</text>\n{}\n</svg>\n",
      -room, Axes::width, Axes::height + room, Axes::width, Axes::height + room, plain_style, -room, Axes::width,
      Axes::height + room, Axes::left, escaped(title), drawing_of(figure(chart)));
}

}  // namespace beadwork::report
