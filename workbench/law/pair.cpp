#include "workbench/law/pair.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/text.hpp"

namespace beadwork::law {

namespace {

constexpr std::array<const char*, 6> axes{"x", "y", "z", "rx", "ry", "rz"};
constexpr std::array<const char*, 2> ends{"first", "second"};

std::string with_unit(Real value, const std::string& unit) { return format_number(value) + " " + unit; }

PlainNode element(const char* set, Real x, Real radius) {
  return {"element",
          {{"set", set},
           {"at", format_number(x) + " 0 0 m"},
           {"radius", with_unit(radius, "m")},
           {"density", "1000 kg/m^3"}},
          {}};
}

// The rate of one degree of freedom, which goes `factor` times as far as s.
PlainAttribute motion_of(const Course& course, const Mode& mode, Real factor) {
  const std::string unit = mode.unit + "/s";
  if (course.table.empty())
    return {"velocity", fmt::format("{} * exp({} * t / 1 s)", with_unit(factor * course.first_rate, unit),
                                    format_number(course.growth))};
  std::vector<std::string> rows;
  for (const auto& [time, rate] : course.table)
    rows.push_back(with_unit(time, "s") + " " + with_unit(factor * rate, unit));
  return {"table", join(rows)};
}

// What moves with s is driven, all else is held.
PlainNode loads(const Family& family, const Mode& mode, const Course& course) {
  PlainNode section{"load", {}, {}};
  for (std::size_t end = 0; end < ends.size(); ++end) {
    std::vector<std::string> held;
    for (std::size_t axis = 0; axis < axes.size(); ++axis) {
      const Real factor = mode.moves[6 * end + axis];
      const bool turns = axis >= 3;
      if (turns && !family.turns) continue;
      if (factor == 0) {
        held.emplace_back(axes[axis]);
        continue;
      }
      section.children.push_back(
          {turns ? "turn" : "pull",
           {{"set", ends[end]}, {"axis", std::string(1, axes[axis][turns ? 1 : 0])}, motion_of(course, mode, factor)},
           {}});
    }
    section.children.push_back({"hold", {{"set", ends[end]}, {"axes", join(held, " ")}}, {}});
  }
  return section;
}

// A curve for each end that is driven.
PlainNode watchers(const Mode& mode) {
  PlainNode section{"watch", {}, {}};
  for (std::size_t end = 0; end < ends.size(); ++end)
    for (std::size_t axis = 0; axis < axes.size(); ++axis)
      if (mode.moves[6 * end + axis] != 0)
        section.children.push_back(
            {"force-curve", {{"of", ends[end]}, {"axis", axes[axis]}, {"name", ends[end]}, {"every", "1"}}, {}});
  section.children.push_back({"energy-ledger", {{"every", "1"}}, {}});
  return section;
}

}  // namespace

Course search_course(const Mode& mode, const Pair& pair) {
  constexpr Real nearest = 1e-8, growth = 0.01;  // where it begins, over its scale; by how much it grows in a step
  const Real begin = nearest * pair.scale(mode);
  return {.first_rate = mode.sign * begin * growth,
          .growth = growth,
          .end = std::log1p(mode.look * pair.scale(mode) / begin) / growth};
}

// Between two ends the rate rises and falls in straight lines over 2 s.
Course cycles_course(const std::vector<Real>& amplitudes) {
  constexpr Real steps = 70;  // from one end to the other: a picture draws every row of six cycles
  Course course{.table = {{0, 0}}, .step = 2 / steps};
  Real time = 0;
  for (const Real amplitude : amplitudes)
    for (const Real rate : {amplitude, -amplitude}) {
      course.table.push_back({time + 1, rate});
      course.table.push_back({time + 2, 0});
      time += 2;
    }
  course.end = time;
  return course;
}

std::string pair_deck(const Scene& scene, const Family& family, const Mode& mode, const Pair& pair,
                      const Course& course, const std::string& name, const std::string& about) {
  PlainNode root{"scene", {}, {}};
  for (const PlainAttribute& each : scene.resolved_tree.attributes)
    root.attributes.push_back({each.name, each.name == "name" ? name : each.value});
  root.children = {
      {"fill",
       {},
       {element("first", 0, pair.radius1), element("second", pair.distance() * (1 - mode.press), pair.radius2)}},
      {family.is_contact ? "contact" : "bond", {}, {family.node}}};
  if (!family.criteria.empty()) root.children.push_back({"fail", {}, family.criteria});
  if (!family.derived.empty()) root.children.push_back({"derive", {}, family.derived});
  root.children.push_back(loads(family, mode, course));
  root.children.push_back(
      {"move",
       {},
       {{"static", {{"time-step", with_unit(course.step, "s")}, {"until", with_unit(course.end, "s")}}, {}}}});
  root.children.push_back(watchers(mode));
  std::string xml = resolved_xml(root);
  return xml.insert(xml.find('\n') + 1, "<!-- " + about + " -->\n");
}

}  // namespace beadwork::law
