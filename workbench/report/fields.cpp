// The fields that the frames recorded, each with its colour bar.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "workbench/report/color_scale.hpp"
#include "workbench/report/sections.hpp"
#include "workbench/report/specimen.hpp"
#include "workbench/report/text.hpp"

namespace beadwork::report {

namespace {

constexpr std::size_t most_frames = 4;
constexpr int widest = 1120, tallest = 330;  ///< pixels

/// A field as it is found in several frames, on elements or on bonds.
struct Found {
  std::string name, unit;
  bool of_bonds, is_length;
};

std::vector<Found> fields_of(const std::vector<record::Frame>& frames) {
  std::vector<Found> all;
  const auto note = [&](const record::FieldValues& field, bool of_bonds) {
    const auto same = [&](const Found& f) { return f.name == field.name && f.of_bonds == of_bonds; };
    if (std::none_of(all.begin(), all.end(), same)) all.push_back({field.name, field.unit, of_bonds, field.is_length});
  };
  for (const record::Frame& frame : frames) {
    for (const auto& field : frame.fields) note(field, false);
    for (const auto& bonds : frame.bonds)
      for (const auto& field : bonds.fields) note(field, true);
  }
  return all;
}

template <class Each>
void each_column(const record::Frame& frame, const Found& field, const Each& each) {
  const auto look = [&](const std::vector<record::FieldValues>& columns) {
    for (const auto& column : columns)
      if (column.name == field.name) each(column);
  };
  if (!field.of_bonds) return look(frame.fields);
  for (const auto& bonds : frame.bonds) look(bonds.fields);
}

std::vector<Real> values_in(const std::vector<record::Frame>& frames, const Found& field) {
  std::vector<Real> all;
  for (const record::Frame& frame : frames)
    each_column(frame, field,
                [&](const auto& column) { all.insert(all.end(), column.values.begin(), column.values.end()); });
  return all;
}

std::string title_of(const Found& field) {
  const std::string name = spaced(field.name);
  return field.is_length ? "length of " + name : name;
}

std::string bar(const ColorScale& scale, const Scale& unit) {
  const auto label = [&](Real value) { return number(value * unit.factor); };
  return fmt::format(
      "<div class=\"colorbar\"><span>{}{}</span><i style=\"background:{}\"></i><span>{}{}{}</span></div>",
      scale.below ? "≤ " : "", label(scale.low), scale.css(), scale.above ? "≥ " : "", label(scale.high),
      unit.unit == "1" || unit.unit.empty() ? "" : " " + unit.unit);
}

std::string not_numbers(std::size_t many) { return plural(static_cast<std::int64_t>(many), "value") + " not a number"; }

std::string figure_of(const Stage& stage, const Found& field, const std::vector<record::Frame>& frames) {
  const std::vector<Real> values = values_in(frames, field);
  const std::size_t odd =
      static_cast<std::size_t>(std::count_if(values.begin(), values.end(), [](Real v) { return !std::isfinite(v); }));
  const ColorScale scale = scale_over(values);
  const Scale unit = readable(field.unit, std::max(std::abs(scale.low), std::abs(scale.high)));
  std::string head = "<b>" + escaped(title_of(field)) + "</b>" + (field.of_bonds ? " of the bonds" : "");
  if (scale.constant()) {
    const std::string everywhere = values.size() > odd
                                       ? number(scale.low * unit.factor) + (unit.unit == "1" ? "" : " " + unit.unit)
                                       : "no numbers";
    return "<p>" + head + ": " + everywhere + " everywhere" + (odd > 0 ? "; " + not_numbers(odd) : "") + ".</p>";
  }
  std::string out = "<figure class=\"field\"><figcaption>" + head + bar(scale, unit);
  if (odd > 0) out += "<span class=\"note\">" + not_numbers(odd) + ", in grey</span>";
  out += "</figcaption><div class=\"frames\">";
  const View& view = stage.views.front();
  for (const record::Frame& frame : frames) {
    bool there = false;
    each_column(frame, field, [&](const auto&) { there = true; });
    if (!there) continue;
    const Image image = draw_field(stage, view, frame, field.name, field.of_bonds, scale,
                                   width_in_pixels(stage, view, widest, tallest));
    const auto bytes = png(image);
    out += fmt::format(
        "<div class=\"view\"><img src=\"data:image/png;base64,{}\" width=\"{}\" height=\"{}\" alt=\"{}\"><small>step "
        "{}</small></div>",
        base64(bytes.data(), bytes.size()), image.width, image.height, escaped(title_of(field)),
        count(frame.head.step));
  }
  return out + "</div></figure>\n";
}

/// At most `most` of them, the last one among them.
std::vector<record::Frame> some_of(const std::vector<record::Frame>& frames, std::size_t most) {
  if (frames.size() <= most) return frames;
  std::vector<record::Frame> some;
  for (std::size_t k = 1; k <= most; ++k) some.push_back(frames[k * frames.size() / most - 1]);
  return some;
}

}  // namespace

std::string field_pictures(const Stage& stage, const std::vector<record::Frame>& frames) {
  const std::vector<record::Frame> shown = some_of(frames, most_frames);
  std::string body;
  for (const Found& field : fields_of(shown)) body += figure_of(stage, field, shown);
  return section("Recorded fields", body);
}

}  // namespace beadwork::report
