#pragma once
// The frame of a chart: ranges, ticks, grid, and the way from values to places in the drawing.

#include <string>
#include <vector>

namespace beadwork::report {

struct Range {
  double low = 0, high = 1;
  double span() const { return high - low; }
};

/// Least and greatest finite value; {0, 0} if there is none.
Range range_of(const std::vector<double>& values);
Range united(const Range&, const Range&);
/// A little wider; down or up to zero where that is near; never empty.
Range padded(Range);

struct Axes {
  static constexpr double width = 640, height = 350;
  static constexpr double left = 58, right = 16, top = 26, bottom = 48;

  Range x, y;
  std::string x_label, y_label;

  double across(double value) const { return left + (value - x.low) / x.span() * (width - left - right); }
  double down(double value) const { return height - bottom - (value - y.low) / y.span() * (height - top - bottom); }
  std::string svg() const;  ///< grid, ticks with their numbers, labels
};

}  // namespace beadwork::report
