#pragma once
// Line charts, stacked areas and histograms as inline SVG. Colours come from the page's style sheet (classes
// s0 to s7), so a chart is legible on light and dark pages.

#include <string>
#include <vector>

namespace beadwork::report {

enum class Stroke { solid, dashed };

struct Series {
  std::string label;
  std::vector<double> x, y;  ///< in the units of the axes; NaN is a gap
  int color = 0;             ///< 0 to 7
  Stroke stroke = Stroke::solid;
  bool reference = false;  ///< from elsewhere: it does not set the scale, and may leave the drawing
};

/// A numbered dot on the first series, at its row `row`: where a picture was taken.
struct Marker {
  std::size_t row;
  std::string label;
};

struct Chart {
  std::string title, x_label, y_label;  ///< labels with their units
  std::string x_name, x_unit;           ///< for the readout under the pointer
  std::vector<Series> series;
  std::vector<Marker> markers;
  bool stacked = false;  ///< solid series as areas on top of each other; they share their x
};

/// A <figure> with title, legend and drawing. Thousands of points are thinned to the least and greatest of
/// each bin.
std::string figure(const Chart&);

struct Bars {
  std::string title, x_label, y_label;
  std::vector<double> edges, heights;  ///< one edge more than heights
};
std::string figure(const Bars&);

/// Round numbers covering from..to, about `wanted` of them.
std::vector<double> ticks(double from, double to, int wanted);

/// At most about `most` rows that keep the shape: first, last, least and greatest of each bin, in their
/// order.
std::vector<std::size_t> thinned(const std::vector<double>& y, std::size_t most);

}  // namespace beadwork::report
