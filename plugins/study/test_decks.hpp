#pragma once
// The decks of the tests that a calibration's sample is put to beside tension: bent, twisted, struck.

#include "plugins/study/sample_decks.hpp"

namespace beadwork::calibration {

/// Slices across a sample, an eighth of its length thick, at a quarter and three quarters of it.
inline std::string gauges_deck() {
  std::string regions;
  for (const auto& [name, place] : {std::pair{"quarter", 4}, {"three-quarters", 12}})
    regions += fmt::format(
        "    <region set=\"{0}\" where=\"nx*x + ny*y + nz*z > {1}/16*length and nx*x + ny*y + nz*z &lt; "
        "{2}/16*length\"/>\n",
        name, place - 1, place + 1);
  return fmt::format("{}  <fill>\n{}  </fill>\n</scene>\n", deck_head(true), regions);
}

/// Of a displacement. What nothing binds stays where it is to the last bit, and tells nothing of the solid.
inline constexpr const char* bound_only = R"( where="value &lt; 0 or value > 0")";

/// Two sensors of a set: SET-place, its mean place along `across`, and SET-shift, its mean displacement along the axis.
inline std::string gauge(const std::string& set, const std::string& across, int every) {
  return fmt::format(
      R"(    <sensor field="position" component="{1}" set="{0}" every="1000" name="{0}-place"/>
    <sensor field="displacement" component="${{axis}}" set="{0}"{2} every="{3}" name="{0}-shift"/>
)",
      set, across, bound_only, every);
}

/// The ends are turned against each other about y, an axis across: both stay plane, and their places along y are free.
/// Halves of the slices tell by how much these have turned.
inline std::string bending_deck(const SampleDecks& d) {
  const std::string across = d.is_cylinder ? "x" : "z";
  std::string halves, gauges;
  for (const char* slice : {"quarter", "three-quarters"})
    for (const auto& [half, side] : {std::pair{"below", "&lt;"}, {"above", ">"}}) {
      const std::string set = fmt::format("{}-{}", slice, half);
      const int place = std::string(slice) == "quarter" ? 4 : 12;
      halves += fmt::format(
          "    <region set=\"{}\" where=\"nx*x + ny*y + nz*z > {}/16*length and nx*x + ny*y + nz*z &lt; {}/16*length "
          "and "
          "{} {} a/2\"/>\n",
          set, place - 1, place + 1, across, side);
      gauges += gauge(set, across, 1);
    }
  const char* near = d.is_cylinder ? "${a/2} ${a/2} ${R}" : "${R} ${a/2} ${a/2}";
  const char* far = d.is_cylinder ? "${a/2} ${a/2} ${length - R}" : "${length - R} ${a/2} ${a/2}";
  return fmt::format(
      R"({}<scene name="bending">
  <include file="sample.xml"/>
  <include file="gauges.xml"/>
  <parameter name="angle" value="1e-6"/>               <!-- between the ends -->
  <parameter name="every" value="1"/>
  <fill>
{}  </fill>
  <load>
    <hold set="near" axes="y" grip="mean"/>
    <turn set="near" axis="y" about="{}" along="free" velocity="${{-angle/2}} rad/s"/>
    <turn set="far"  axis="y" about="{}" along="free" velocity="${{angle/2}} rad/s"/>
  </load>
  <move><static time-step="1 s" free="pin" until="1 s"/></move>
  <watch>
    <force-curve of="far" axis="ry" every="1" name="torque"/>
    <sensor field="position" component="${{axis}}" set="quarter"        every="1000" name="quarter-place"/>
    <sensor field="position" component="${{axis}}" set="three-quarters" every="1000" name="three-quarters-place"/>
{}  </watch>
</scene>
)",
      deck_head(false), halves, near, far, gauges);
}

/// The ends are turned against each other about the sample's axis, along which they are free to warp.
inline std::string torsion_deck() {
  return fmt::format(
      R"({}<scene name="torsion">
  <include file="sample.xml"/>
  <parameter name="angle" value="1e-6"/>               <!-- between the ends -->
  <parameter name="every" value="1"/>
  <load>
    <hold set="near" axes="${{axis}}" grip="mean"/>
    <turn set="near" axis="${{axis}}" about="${{a/2}} ${{a/2}} ${{a/2}}" along="free" velocity="${{-angle/2}} rad/s"/>
    <turn set="far"  axis="${{axis}}" about="${{a/2}} ${{a/2}} ${{a/2}}" along="free" velocity="${{angle/2}} rad/s"/>
  </load>
  <move><static time-step="1 s" free="pin" until="1 s"/></move>
  <watch><force-curve of="far" axis="r${{axis}}" every="1" name="torque"/></watch>
</scene>
)",
      deck_head(false));
}

/// One end is pushed in by `stretch` within `rise`; the step of the displacement runs past the slices.
inline std::string wave_deck() {
  return fmt::format(
      R"({}<scene name="wave">
  <include file="sample.xml"/>
  <include file="gauges.xml"/>
  <parameter name="stretch" value="1e-6 mm"/>
  <parameter name="rise"    value="1 us"/>
  <parameter name="time"    value="2 us"/>
  <parameter name="every"   value="1000"/>
  <load><pull set="near" axis="${{axis}}" table="0 s 0 m/s, ${{rise/2}} ${{2*stretch/rise}}, ${{rise}} 0 m/s"/></load>
  <move><verlet until="${{time}}"/></move>
  <watch>
    <sensor field="mass" reduce="sum" set="gauged" every="1000" name="mass"/>
    <sensor field="mass" reduce="count" set="gauged" every="1000" name="all"/>
    <sensor field="displacement" component="${{axis}}" reduce="count" set="gauged"{} every="2" name="bound"/>
{}  </watch>
  <fill><region set="gauged" where="nx*x + ny*y + nz*z > length/4 and nx*x + ny*y + nz*z &lt; 3/4*length"/></fill>
</scene>
)",
      deck_head(false), bound_only, gauge("quarter", "${axis}", 2) + gauge("three-quarters", "${axis}", 2));
}

}  // namespace beadwork::calibration
