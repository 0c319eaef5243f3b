#include "workbench/report/specimen.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace beadwork::report {

namespace {

bool finite(const Vec3& v) { return std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z()); }

bool is_interface(const Stage& stage, const record::Bonds& bonds) {
  return std::find(stage.interfaces.begin(), stage.interfaces.end(), bonds.family) != stage.interfaces.end();
}

/// A family that softens is drawn whole if it is a surface, not the bulk of the specimen.
std::vector<std::string> find_interfaces(const std::vector<record::Frame>& shown) {
  std::vector<std::string> names;
  for (const record::Frame& frame : shown)
    for (const record::Bonds& bonds : frame.bonds) {
      const bool softens = bonds.has_damage || bonds.law.starts_with("cohesive-contact") ||
                           std::find(bonds.state.begin(), bonds.state.end(), State::softening) != bonds.state.end();
      const bool surface = bonds.ends.size() < frame.position.size();
      if (softens && surface && std::find(names.begin(), names.end(), bonds.family) == names.end())
        names.push_back(bonds.family);
    }
  return names;
}

/// Largest of 1, 2, 5, 10, ... with which displacements stay below a twelfth of the specimen's length.
Real choose_magnification(const std::vector<record::Frame>& shown, Real length) {
  Real largest = 0;
  for (const record::Frame& frame : shown) {
    std::vector<Real> sizes;
    for (const Vec3& u : frame.displacement)
      if (finite(u)) sizes.push_back(u.norm());
    if (sizes.empty()) continue;
    // The hundredth part that moves most may be splinters; what they do is not the deformation.
    const auto rank = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() * 99 / 100);
    std::nth_element(sizes.begin(), rank, sizes.end());
    largest = std::max(largest, *rank);
  }
  if (!(largest > 1e-9 * length)) return 1;
  const Real room = length / 12 / largest;
  Real factor = 1;
  for (Real power = 1; power < 1e4; power *= 10)
    for (const Real nice : {1.0, 2.0, 5.0})
      if (nice * power <= room) factor = nice * power;
  return factor;
}

View view_along(Show show, const std::string& name, int axis, const Box& box, Real margin) {
  const Camera camera = camera_along(axis, box, margin);
  return {show, name + ", " + orientation(camera), camera};
}

Box stage_box(const Stage& stage, const Box& rest, const std::vector<record::Frame>& shown) {
  Box all = rest;
  for (const record::Frame& frame : shown) {
    const Box box = box_magnified(frame, stage.magnification);
    all = {all.low.cwiseMin(box.low), all.high.cwiseMax(box.high)};
  }
  // Splinters may fly far; the picture stays with the specimen.
  const Vec3 room = Vec3::Constant(0.35 * rest.size().maxCoeff());
  return {all.low.cwiseMax(rest.low - room), all.high.cwiseMin(rest.high + room)};
}

/// The smallest set that holds an element gives its colour: a grip shows on the ply that it holds.
void color_sets(Stage& stage, const std::map<std::string, std::vector<std::int64_t>>& sets, std::size_t elements) {
  std::vector<const std::pair<const std::string, std::vector<std::int64_t>>*> by_size;
  for (const auto& set : sets)
    if (!set.second.empty()) by_size.push_back(&set);
  std::stable_sort(by_size.begin(), by_size.end(),
                   [](auto* a, auto* b) { return a->second.size() > b->second.size(); });
  // The first colour is almost the body's: for a set that makes up most of it.
  std::size_t next = !by_size.empty() && 2 * by_size.front()->second.size() < elements ? 1 : 0;
  for (const auto* set : by_size) {
    if (set->second.size() == elements && by_size.size() > 1) continue;  // everything: says nothing
    const Color c = palette::sets[next++ % std::size(palette::sets)];
    stage.sets.push_back({set->first, c});
    for (const std::int64_t id : set->second) stage.element_color[id] = c;
  }
}

/// The worst state of the bonds at each element. One bond does not speak for an element much larger than its
/// other.
std::vector<State> worst_states(const record::Frame& frame) {
  std::vector<State> worst(frame.position.size(), State::intact);
  for (const record::Bonds& bonds : frame.bonds)
    for (std::size_t b = 0; b < bonds.ends.size(); ++b)
      for (const int side : {0, 1}) {
        const auto here = static_cast<std::size_t>(bonds.ends[b][static_cast<std::size_t>(side)]);
        const auto there = static_cast<std::size_t>(bonds.ends[b][static_cast<std::size_t>(1 - side)]);
        if (frame.radius[here] < 2.5 * frame.radius[there]) worst[here] = std::max(worst[here], bonds.state[b]);
      }
  return worst;
}

Color color_of(State state) {
  return state == State::broken ? palette::broken : state == State::softening ? palette::softening : palette::elastic;
}

Color base_color(const Stage& stage, std::int64_t id) {
  const auto found = stage.element_color.find(id);
  return found == stage.element_color.end() ? palette::body : found->second;
}

Real mean_radius(const record::Frame& frame) {
  Real sum = 0;
  std::size_t count = 0;  // without walls, which have none
  for (const Real r : frame.radius)
    if (r > 0) sum += r, ++count;
  return count == 0 ? 1 : sum / static_cast<Real>(count);
}

/// Elements from front to back, those without a place or a size left out.
template <class Place>
std::vector<std::size_t> front_to_back(const record::Frame& frame, const Place& place, const Vec3& toward) {
  std::vector<std::pair<Real, std::size_t>> order;
  for (std::size_t i = 0; i < frame.position.size(); ++i)
    if (finite(place(i)) && frame.radius[i] > 0) order.emplace_back(-place(i).dot(toward), i);
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> rows;
  for (const auto& [depth, row] : order) rows.push_back(row);
  return rows;
}

void draw_walls(Canvas& canvas, const record::Frame& frame) {
  const Real thickness = 0.3 * mean_radius(frame);
  for (const auto& [from, to] : frame.walls)
    if (finite(from) && finite(to)) canvas.segment(from, to, thickness, palette::wall);
}

void draw_bodies(Canvas& canvas, const Stage& stage, const record::Frame& frame, const Vec3& toward) {
  const auto worst = worst_states(frame);
  const auto place = [&](std::size_t i) { return magnified(frame, i, stage.magnification); };
  for (const std::size_t i : front_to_back(frame, place, toward)) {
    const Color base = base_color(stage, frame.id[i]);
    canvas.sphere(place(i), frame.radius[i], worst[i] == State::intact ? base : mix(base, color_of(worst[i]), 0.88F));
  }
  canvas.darken_hollows(4 * mean_radius(frame), 0.42F);
  draw_walls(canvas, frame);
}

void draw_bond(Canvas& canvas, const record::Frame& frame, const std::array<Index, 2>& ends, const Vec3& toward,
               Color c) {
  const auto i = static_cast<std::size_t>(ends[0]), j = static_cast<std::size_t>(ends[1]);
  const Vec3 a = at_rest(frame, i), b = at_rest(frame, j);
  const Real smaller = std::min(frame.radius[i], frame.radius[j]);
  if (!finite(a) || !finite(b) || !(smaller > 0)) return;
  const Vec3 middle = a + (b - a) * (frame.radius[i] / (frame.radius[i] + frame.radius[j]));
  canvas.disc(middle, toward, 0.68 * smaller, c);  // facing us: an even field of dots shows a front best
}

void draw_bonds(Canvas& canvas, const Stage& stage, const record::Frame& frame, const Vec3& toward) {
  const auto place = [&](std::size_t i) { return at_rest(frame, i); };
  for (const std::size_t i : front_to_back(frame, place, toward))
    canvas.sphere(place(i), frame.radius[i], palette::body);
  canvas.darken_hollows(4 * mean_radius(frame));
  canvas.fade(0.38F);
  // Broken over softening over elastic: what went wrong is never hidden by what is whole.
  for (const State state : {State::intact, State::softening, State::broken}) {
    canvas.flatten();
    for (const record::Bonds& bonds : frame.bonds) {
      if (state == State::intact && !is_interface(stage, bonds)) continue;
      for (std::size_t b = 0; b < bonds.ends.size(); ++b)
        if (bonds.state[b] == state) draw_bond(canvas, frame, bonds.ends[b], toward, color_of(state));
    }
  }
}

}  // namespace

void complete_displacement(record::Frame& frame, const record::Frame& first) {
  if (!frame.displacement.empty()) return;
  std::unordered_map<std::int64_t, std::size_t> row;
  for (std::size_t i = 0; i < first.id.size(); ++i) row[first.id[i]] = i;
  std::vector<Vec3> displacement;  // apart, as `first` may be this very frame
  for (std::size_t i = 0; i < frame.position.size(); ++i) {
    const auto found = row.find(frame.id[i]);
    displacement.push_back(found == row.end() ? Vec3(Vec3::Zero())
                                              : Vec3(frame.position[i] - at_rest(first, found->second)));
  }
  frame.displacement = std::move(displacement);
}

Stage set_up(const record::Frame& first, const std::vector<record::Frame>& shown,
             const std::map<std::string, std::vector<std::int64_t>>& sets, const std::string& wanted) {
  Stage stage;
  const Box rest = box_at_rest(first);
  const Real margin = std::max(mean_radius(first), 0.01 * rest.size().maxCoeff());
  stage.magnification = choose_magnification(shown, rest.size().maxCoeff());
  stage.interfaces = find_interfaces(shown);
  color_sets(stage, sets, first.position.size());
  const Weak weak = shown.empty() ? Weak{} : weak_bonds(shown.back(), stage.interfaces);
  const Box around = stage_box(stage, rest, shown);
  const auto look = [&](const std::string& axis) {
    const auto [bodies, bonds, name] = choose_viewpoint(weak, rest.size(), axis);
    const View side = view_along(Show::bodies, name, bodies, around, margin);
    stage.views.push_back(side);
    if (bonds < 0) return;
    View plan = view_along(Show::bonds, stage.interfaces.empty() ? "broken bonds" : "bonds of the interface", bonds,
                           rest, margin);
    // One scale above the other where both have the same axis to the right, so that fronts stand in line.
    if (plan.camera.right == side.camera.right) {
      plan.camera.width = side.camera.width;
      plan.camera.centre += (side.camera.centre - plan.camera.centre).dot(plan.camera.right) * plan.camera.right;
    }
    stage.views.push_back(plan);
  };
  if (wanted.empty()) look("");
  for (const char axis : wanted) look(std::string(1, axis));
  return stage;
}

Camera cropped(const Stage& stage, const View& view, const record::Frame& frame) {
  Camera camera = view.camera;
  if (view.show == Show::bonds) return camera;
  const Box box = box_magnified(frame, stage.magnification);
  const Real bottom = camera.centre.dot(camera.up) - 0.5 * camera.height, top = bottom + camera.height;
  const Real margin = 2 * mean_radius(frame);
  const Real low = std::max(bottom, box.low.dot(camera.up) - margin);
  const Real high = std::min(top, box.high.dot(camera.up) + margin);
  if (!(high > low)) return camera;
  camera.centre += (0.5 * (low + high) - camera.centre.dot(camera.up)) * camera.up;
  camera.height = high - low;
  return camera;
}

int width_in_pixels(const Stage& stage, const View& wanted, int widest, int tallest) {
  Real scale = std::numeric_limits<Real>::max();
  for (const View& view : stage.views)
    scale = std::min({scale, widest / view.camera.width, tallest / view.camera.height});
  return std::max(1, static_cast<int>(std::lround(scale * wanted.camera.width)));
}

Counts counts(const Stage& stage, const record::Frame& frame) {
  Counts out;
  for (const record::Bonds& bonds : frame.bonds) {
    if (!stage.interfaces.empty() && !is_interface(stage, bonds)) continue;
    for (const State state : bonds.state)
      ++(state == State::broken ? out.broken : state == State::softening ? out.softening : out.elastic);
  }
  return out;
}

std::string wanted_view(const std::vector<record::Frame>& shown) {
  std::string wanted;
  for (const record::Frame& frame : shown) {
    std::string axes;
    for (const char letter : frame.head.view)
      if (letter >= 'x' && letter <= 'z' && axes.find(letter) == std::string::npos) axes += letter;
    if (!axes.empty()) wanted = axes;
  }
  return wanted;
}

Image draw(const Stage& stage, const View& view, const record::Frame& frame, int width) {
  Canvas canvas(cropped(stage, view, frame), width);
  const Vec3 toward = view.camera.right.cross(view.camera.up);
  if (view.show == Show::bodies)
    draw_bodies(canvas, stage, frame, toward);
  else
    draw_bonds(canvas, stage, frame, toward);
  return canvas.image();
}

Image draw_field(const Stage& stage, const View& view, const record::Frame& frame, const std::string& field,
                 bool of_bonds, const ColorScale& scale, int width) {
  Canvas canvas(cropped(stage, view, frame), width);
  const Vec3 toward = view.camera.right.cross(view.camera.up);
  const auto place = [&](std::size_t i) { return magnified(frame, i, stage.magnification); };
  const auto named = [&](const std::vector<record::FieldValues>& columns) {
    return std::find_if(columns.begin(), columns.end(), [&](const auto& column) { return column.name == field; });
  };
  const auto own = of_bonds ? frame.fields.end() : named(frame.fields);
  for (const std::size_t i : front_to_back(frame, place, toward))
    canvas.sphere(place(i), frame.radius[i], own == frame.fields.end() ? palette::body : scale(own->values[i]));
  canvas.darken_hollows(4 * mean_radius(frame), 0.42F);
  if (!of_bonds) return canvas.image();
  canvas.fade(0.3F);
  canvas.flatten();
  for (const record::Bonds& bonds : frame.bonds) {
    const auto column = named(bonds.fields);
    if (column == bonds.fields.end()) continue;
    for (std::size_t b = 0; b < bonds.ends.size(); ++b) {
      const auto i = static_cast<std::size_t>(bonds.ends[b][0]), j = static_cast<std::size_t>(bonds.ends[b][1]);
      const Vec3 from = place(i), to = place(j);
      if (finite(from) && finite(to))
        canvas.segment(from, to, 0.5 * std::min(frame.radius[i], frame.radius[j]), scale(column->values[b]));
    }
  }
  return canvas.image();
}

}  // namespace beadwork::report
