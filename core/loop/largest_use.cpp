#include "core/loop/largest_use.hpp"

#include <fmt/format.h>

#include "core/plugin/blame.hpp"

namespace beadwork {

LargestUse::LargestUse(Table& criteria, Index row)
    : value(criteria, "utilisation", "1", "Largest utilisation that a criterion has found so far", row),
      time(criteria, "time", "s", "Time at which it was found", row),
      step(criteria, "step", "1", "Step at which it was found", row),
      bond(criteria, "bond", "1", "Id of the bond that has it", row),
      first(criteria, "first", "1", "Id of the bond's first element", row),
      second(criteria, "second", "1", "Id of the bond's second element", row),
      x(criteria, "x", "m", "Place of the bond's middle along x", row),
      y(criteria, "y", "m", "Place of the bond's middle along y", row),
      z(criteria, "z", "m", "Place of the bond's middle along z", row) {
  bond = -1;
}

void LargestUse::note(const Verdict& verdict, const Domain& domain, const BondTable& table, const Moment& moment) {
  if (verdict.row < 0 || !(verdict.largest > value)) return;
  const auto id = domain.elements().column("id").view<const Index>();
  const auto at = domain.elements().column("position").view<const Vec3>();
  const Index i = table.first()[verdict.row], j = table.second()[verdict.row];
  const Vec3 middle = 0.5 * (at[i] + at[j]);
  value = verdict.largest, time = moment.time, step = static_cast<Real>(moment.step);
  bond = static_cast<Real>(table.id()[verdict.row]), first = static_cast<Real>(id[i]),
  second = static_cast<Real>(id[j]);
  x = middle[0], y = middle[1], z = middle[2];
}

std::string sentence(const LargestUse& use, const Failure& failure) {
  const std::string of = fmt::format("<{} of=\"{}\"> ({})", failure.tag(), failure.family(),
                                     blaming(failure, "mode", [&] { return failure.mode(); }));
  if (!use.is_there()) return fmt::format("{} has found no bond under load", of);
  return fmt::format(
      "largest utilisation of {}: {:.4g} at step {:.0f} ({:.4g} s), bond {:.0f} between elements {:.0f} and {:.0f}, at "
      "({:.4g}, {:.4g}, {:.4g}) m",
      of, Real(use.value), Real(use.step), Real(use.time), Real(use.bond), Real(use.first), Real(use.second),
      Real(use.x), Real(use.y), Real(use.z));
}

}  // namespace beadwork
