#pragma once
// The decks of the samples that a calibration tests: ordinary decks, which anybody can look at and run by hand.

#include <fmt/format.h>

#include <string>

#include "core/base/types.hpp"

namespace beadwork::calibration {

/// What stands in the decks as values that are there without --set.
struct SampleDecks {
  bool is_cylinder;
  std::int64_t elements;
  Real spread, coordination;
  std::string counted;  ///< whose contacts: all or bulk
  std::string by;       ///< the mover: static or verlet
  Real within;          ///< share by which what breaks may be below what breaks first
};

/// Along which a sample is longest.
inline const char* first_axis(const SampleDecks& d) { return d.is_cylinder ? "z" : "x"; }

inline const char* deck_head(bool is_part) {
  return is_part ? "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- Made by beadwork calibrate; included by the decks "
                   "beside it. -->\n<scene>\n"
                 : "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- Made by beadwork calibrate. -->\n";
}

/// How often a sample is as long as it is wide.
inline Real slenderness(bool is_cylinder) { return is_cylinder ? 2 : 1; }

/// Sizes: of a box with side a, or of a cylinder with radius a/2. As many elements of mean radius R as fill 0.64 of it.
inline std::string size_deck(const SampleDecks& d) {
  return fmt::format(
      R"({}  <parameter name="elements" value="{}"/>
  <parameter name="slender" value="{}"/>               <!-- how often it is as long as it is wide -->
  <parameter name="R"       value="1 mm"/>            <!-- mean radius -->
  <parameter name="a"       value="${{(elements*{}/(3*0.64*slender))^(1/3)*R}}"/>  <!-- {} -->
  <parameter name="length"  value="${{slender*a}}"/>    <!-- along {} -->
</scene>
)",
      deck_head(true), d.elements, slenderness(d.is_cylinder), d.is_cylinder ? "16" : "4*pi",
      d.is_cylinder ? "diameter" : "side", first_axis(d));
}

inline std::string packing_deck(const SampleDecks& d) {
  const std::string shape = d.is_cylinder
                                ? R"(cylinder-radius="${a/2}" from="${a/2} ${a/2} 0 mm" to="${a/2} ${a/2} ${length}")"
                                : R"(box="${length} ${a} ${a}")";
  return fmt::format(
      R"({}<scene name="packing" seed="${{seed}}">
  <parameter name="seed" value="1"/>
  <include file="size.xml"/>
  <fill>
    <free-filling   set="solid" {} count="${{elements}}" spread="{}" density="1000 kg/m^3"/>
    <forced-filling set="solid" coordination="{}" counted="{}"/>
    <relaxation     set="solid" overlap="1e-7"/>
  </fill>
  <move><verlet time-step="1 s" until="1"/></move>
  <watch><snapshot every="1"/></watch>
</scene>
)",
      deck_head(false), shape, d.spread, d.coordination, d.counted);
}

/// A sample: its bonds, the grips one element deep at both ends, and its core.
inline std::string sample_deck(const SampleDecks& d, const std::string& packing) {
  const std::string core =
      d.is_cylinder ? "(x - a/2)^2 + (y - a/2)^2 &lt; (a/2 - 3*R)^2 and z > 3*R and z &lt; length - 3*R"
                    : "x > 3*R and x &lt; length - 3*R and y > 3*R and y &lt; a - 3*R and z > 3*R and z &lt; a - 3*R";
  return fmt::format(
      R"({}  <include file="size.xml"/>
  <parameter name="packing" value="{}"/>
  <parameter name="axis"   value="{}"/>
  <parameter name="nx" value="{}"/>
  <parameter name="ny" value="0"/>
  <parameter name="nz" value="{}"/>
  <parameter name="young"  value="1 GPa"/>            <!-- of the bonds, as all that follows -->
  <parameter name="poisson" value="0.3"/>
  <parameter name="radius-ratio" value="0.3"/>
  <fill>
    <read-packing set="solid" file="${{packing}}" density="1000 kg/m^3"/>
    <region set="near" where="nx*x + ny*y + nz*z &lt; 2*R"/>
    <region set="far"  where="nx*x + ny*y + nz*z > length - 2*R"/>
    <region set="core" where="{}"/>
  </fill>
  <bond><cohesive-beam name="beam" between="solid solid" young="${{young}}" poisson="${{poisson}}" radius-ratio="${{radius-ratio}}"/></bond>
  <watch>
    <sensor field="position" component="${{axis}}" set="near" every="${{every}}" name="near"/>
    <sensor field="position" component="${{axis}}" set="far"  every="${{every}}" name="far"/>
  </watch>
</scene>
)",
      deck_head(true), packing, first_axis(d), d.is_cylinder ? "0" : "1", d.is_cylinder ? "1" : "0", core);
}

/// A sample that is pulled along an axis, its sides free.
inline std::string pulled_deck(const SampleDecks& d) {
  const std::string volume = d.is_cylinder ? "pi*(a/2 - 3*R)^2*(length - 6*R)" : "(a - 6*R)^2*(length - 6*R)";
  return fmt::format(
      R"({}  <include file="sample.xml"/>
  <parameter name="others" value="{}"/>
  <parameter name="turns"  value="{}"/>               <!-- about the axis -->
  <load>
    <hold set="near" axes="${{axis}}"/>
    <hold set="near" axes="${{others}} ${{turns}}" grip="mean"/>
  </load>
  <watch>
    <force-curve of="far" axis="${{axis}}" every="${{every}}" title="Tension"/>
    <stress-strain of="core" volume="${{{}}}" every="${{every}}" name="core"/>
  </watch>
</scene>
)",
      deck_head(true), d.is_cylinder ? "x y" : "y z", d.is_cylinder ? "rz" : "rx", volume);
}

/// Stretched by `stretch`, or pressed where `sense` is -1: at once to the equilibrium; or, with inertia, over `time`,
/// and half as long again kept there, to come to rest.
inline std::string elastic_deck(const std::string& by) {
  const bool is_static = by == "static";
  return fmt::format(
      R"({}<scene name="elastic">
  <include file="pulled.xml"/>
  <parameter name="stretch" value="1e-4 mm"/>
  <parameter name="sense"   value="1"/>
  <parameter name="time"    value="1 ms"/>
  <parameter name="every"   value="{}"/>
  <load><pull set="far" axis="${{axis}}" {}/></load>
  <move>{}</move>
</scene>
)",
      deck_head(false), is_static ? 1 : 100,
      is_static ? R"(velocity="${sense*stretch/time}")"
                : R"(table="0 s 0 m/s, ${time/2} ${2*sense*stretch/time}, ${time} 0 m/s")",
      is_static ? R"(<static increment="${stretch}" free="pin" until="${stretch}"/>)"
                : R"(<verlet bond-damping="0.1" until="${1.5*time}"/>)");
}

/// Stretched until it breaks, by this mover. `criterion`: the plugin in <fail>. Without inertia one breaks after the
/// other, and an increment ends where the first of them does: it may be long, and a small fall tells that the peak is
/// behind.
inline std::string strength_deck(const SampleDecks& d, const std::string& by, const std::string& criterion) {
  const bool is_static = by == "static";
  const std::string within = fmt::format(
      "  <parameter name=\"within\"   value=\"{}\"/>  <!-- what comes so near to breaking first breaks too -->\n",
      d.within);
  const std::string mover =
      is_static ? "<static increment=\"${stretch/4}\" at-once=\"1000\" within=\"${within}\" free=\"pin\"\n"
                  "                until=\"${stretch} or force of far &lt; 80 percent of its maximum\"/>"
                : "<verlet bond-damping=\"0.1\" until=\"${time} or force of far &lt; 50 percent of its maximum\"/>";
  return fmt::format(
      R"({}<scene name="strength">
  <include file="pulled.xml"/>
  <parameter name="strength" value="1 MPa"/>
  <parameter name="stretch"  value="1 mm"/>           <!-- in which it should have broken -->
  <parameter name="time"     value="1 ms"/>           <!-- that this takes -->
  <parameter name="every"    value="{}"/>
{}  <load><pull set="far" axis="${{axis}}" velocity="${{stretch/time}}"{}/></load>
  <fail><{} strength="${{strength}}"/></fail>
  <move>{}</move>
</scene>
)",
      deck_head(false), is_static ? 1 : 20, is_static ? within : "", is_static ? "" : R"( rise="${time/20}")",
      criterion, mover);
}

}  // namespace beadwork::calibration
