#include "workbench/law/mode.hpp"

#include <algorithm>

namespace beadwork::law {

namespace {

constexpr int second = 6, about = 3;  // of the moves: where those of the second element, and of turns, begin

Mode pulled(const std::string& name, const std::string& motion, int axis, Real sign) {
  Mode mode{.name = name, .motion = motion, .unit = "m", .load = "force", .load_unit = "N", .sign = sign};
  mode.moves[static_cast<std::size_t>(second + axis)] = 1;
  return mode;
}

// Half forwards and half backwards: the bond between bends to an arc, and no shear force arises.
Mode bent() {
  Mode mode{.name = "bending", .motion = "bend", .unit = "rad", .load = "moment", .load_unit = "N.m"};
  mode.moves[about + 2] = -0.5;
  mode.moves[second + about + 2] = 0.5;
  return mode;
}

Mode twisted() {
  Mode mode{.name = "torsion", .motion = "twist", .unit = "rad", .load = "torque", .load_unit = "N.m"};
  mode.moves[second + about] = 1;
  return mode;
}

Mode within(Mode mode, Real look, Real show, Real press = 0) {
  mode.look = look, mode.show = show, mode.press = press;
  return mode;
}

}  // namespace

std::vector<Mode> modes_of(const Family& family, const Reach& reach) {
  std::vector<Mode> modes;
  const Mode compression = pulled("compression", "opening", 0, -1), shear = pulled("shear", "sliding", 1, 1);
  if (family.is_contact) {
    constexpr Real pressed = 1e-3;
    modes = {within(compression, 0.01, 0.01), within(shear, 4 * pressed, 4 * pressed, pressed)};
  } else {
    modes = {within(pulled("tension", "opening", 0, 1), 1, 0.1), within(compression, 0.3, 0.1), within(shear, 1, 0.1)};
    if (family.turns) {
      modes.push_back(within(bent(), 1, 0.2));
      modes.push_back(within(twisted(), 1, 0.2));
    }
  }
  constexpr Real nearest = 0.1;  // of their distance: beyond it two centres would meet
  for (Mode& mode : modes) {
    const auto& given = mode.is_turn() ? reach.angle : reach.strain;
    if (given) mode.look = mode.show = mode.sign < 0 ? std::min(*given, 1 - nearest) : *given;
  }
  return modes;
}

std::string missing_modes(const Family& family) {
  if (family.is_contact)
    return "a contact bears no tension, and spheres touch in a point, which neither bends nor twists: compression, and "
           "shear under an overlap of 0.1 percent";
  return family.turns ? "" : "this law sees no turns: there is neither bending nor torsion";
}

}  // namespace beadwork::law
