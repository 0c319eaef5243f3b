#pragma once
// A curve as a picture of its own: an SVG file that needs no page.

#include <string>
#include <vector>

namespace beadwork::report {

struct PictureAxis {
  std::string name, unit;      ///< in SI
  std::vector<double> values;  ///< NaN is a gap
};

/// The file. Units are such as read well: mm, kN.
std::string picture(const std::string& title, const PictureAxis& x, const PictureAxis& y);

}  // namespace beadwork::report
