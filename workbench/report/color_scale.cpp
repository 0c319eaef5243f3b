#include "workbench/report/color_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace beadwork::report {

namespace {

// Anchors of viridis (van der Walt and Smith 2015, CC0) and of the cool-warm map (Moreland 2009, "Diverging Color Maps
// for Scientific Visualization"): even steps of lightness, legible for colour-blind eyes.
constexpr std::array<Color, 5> sequential = {color(0x440154), color(0x3B528B), color(0x21918C), color(0x5EC962),
                                             color(0xFDE725)};
constexpr std::array<Color, 5> two_sided = {color(0x3B4CC0), color(0x8DB0FE), color(0xDDDDDD), color(0xF49A7B),
                                            color(0xB40426)};
constexpr Color nothing = color(0xB8B8B8);
constexpr Real left_out = 0.005;  // at each end

const std::array<Color, 5>& anchors(const ColorScale& scale) { return scale.diverging() ? two_sided : sequential; }

}  // namespace

Color ColorScale::operator()(Real value) const {
  if (!std::isfinite(value)) return nothing;
  const auto& map = anchors(*this);
  const Real share = constant() ? 0.5 : std::clamp((value - low) / (high - low), 0.0, 1.0);
  const Real place = share * static_cast<Real>(map.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(place), map.size() - 2);
  return mix(map[k], map[k + 1], static_cast<float>(place - static_cast<Real>(k)));
}

std::string ColorScale::css() const {
  std::string stops;
  const auto& map = anchors(*this);
  for (std::size_t k = 0; k < map.size(); ++k)
    stops += fmt::format(", {} {:.0f}%", report::css(map[k]),
                         100.0 * static_cast<double>(k) / static_cast<double>(map.size() - 1));
  return "linear-gradient(to right" + stops + ")";
}

ColorScale scale_over(std::vector<Real> values) {
  std::erase_if(values, [](Real v) { return !std::isfinite(v); });
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto skipped = static_cast<std::size_t>(left_out * static_cast<Real>(values.size()));
  ColorScale scale{values[skipped], values[values.size() - 1 - skipped]};
  if (scale.constant()) scale = {values.front(), values.back()};  // a field of few values: show these
  if (scale.diverging()) {
    scale.high = std::max(-scale.low, scale.high);
    scale.low = -scale.high;
  }
  scale.below = values.front() < scale.low;
  scale.above = values.back() > scale.high;
  return scale;
}

std::string css(Color c) {
  return fmt::format("#{:02x}{:02x}{:02x}", std::lround(c.red * 255), std::lround(c.green * 255),
                     std::lround(c.blue * 255));
}

}  // namespace beadwork::report
