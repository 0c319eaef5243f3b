#include "core/loop/handed_over.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/failure.hpp"

namespace beadwork {

namespace {

[[noreturn]] void blame(const Plugin& by, const std::string& what) {
  throw PhysicsFailure(fmt::format("{}: error: plugin {} {}", by.at().where(), by.id(), what));
}

enum class Of { all, all_but_walls };

void check_positive(const Filler& by, const Domain& domain, const char* name, Of which) {
  const Column* column = domain.elements().find(name);
  if (!column) return;
  const auto value = column->view<Real>();
  for (Index row = 0; row < domain.size(); ++row)
    if (!(std::isfinite(value[row]) && value[row] > 0) && !(which == Of::all_but_walls && domain.walls().is_wall(row)))
      blame(by, fmt::format("left element {} with {} = {} {}: it must be finite and > 0", row, name, value[row],
                            column->field().unit));
}

void check_set(const Filler& by, const std::string& name, const Set& set, Index elements) {
  for (std::size_t k = 0; k < set.size(); ++k) {
    if (set[k] < 0 || set[k] >= elements)
      blame(by, fmt::format("put row {} into set '{}', but there are {} elements", set[k], name, elements));
    if (k > 0 && set[k] <= set[k - 1])
      blame(by, fmt::format("left set '{}' out of order: row {} stands behind row {}", name, set[k], set[k - 1]));
  }
}

}  // namespace

void check_elements(const Filler& by, const Domain& domain) {
  const auto position = domain.elements().column("position").view<Vec3>();
  constexpr Real farthest = 1e100;  // squares of distances are still numbers
  for (Index row = 0; row < domain.size(); ++row) {
    const Vec3 x = position[row];
    if (!(x.cwiseAbs().maxCoeff() <= farthest) || !x.allFinite())
      blame(by, fmt::format("left element {} at {} {} {} m: not a finite place, or too far away to compute with", row,
                            x.x(), x.y(), x.z()));
  }
  check_positive(by, domain, "radius", Of::all_but_walls);
  for (const char* name : {"mass", "inertia"}) check_positive(by, domain, name, Of::all);
  for (const auto& [name, set] : domain.sets()) check_set(by, name, set, domain.size());
}

void check_rows(std::span<const Index> rows, Index size, const char* what, const Plugin& by, const Moment& moment) {
  for (const Index row : rows)
    if (row < 0 || row >= size)
      blame(by, fmt::format("failed at step {}: of the {} bonds there are it gave row {} among {}", moment.step, size,
                            row, what));
}

void check_constraint(const Constraint& c, const Domain& domain, const Plugin& by) {
  if (!domain.sets().contains(c.set)) blame(by, fmt::format("constrains set '{}', which is not there", c.set));
  if (c.axis < 0 || c.axis > 5)
    blame(by, fmt::format("constrains axis {} of set '{}': axes are 0 to 5", c.axis, c.set));
  if (c.body && (!c.turns() || c.grip != Grip::each))
    blame(by, fmt::format("has set '{}' turn as a body, along axis {} or by its mean", c.set, c.axis));
  if (!c.motion) blame(by, fmt::format("constrains set '{}' without a motion", c.set));
}

}  // namespace beadwork
