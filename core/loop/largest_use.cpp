#include "core/loop/largest_use.hpp"

#include <fmt/format.h>

#include "core/plugin/blame.hpp"

namespace beadwork {

void LargestUse::note(const Verdict& verdict, const Domain& domain, const BondTable& table, const Moment& moment) {
  if (verdict.row < 0 || !(verdict.largest > value)) return;
  const auto id = domain.elements().column("id").view<const Index>();
  const auto at = domain.elements().column("position").view<const Vec3>();
  const Index i = table.first()[verdict.row], j = table.second()[verdict.row];
  const Vec3 middle = 0.5 * (at[i] + at[j]);
  *this = {verdict.largest, moment.time, static_cast<Real>(moment.step), static_cast<Real>(table.id()[verdict.row]), static_cast<Real>(id[i]),
           static_cast<Real>(id[j]), middle[0], middle[1], middle[2]};
}

std::string sentence(const LargestUse& use, const Failure& failure) {
  const std::string of = fmt::format("<{} of=\"{}\"> ({})", failure.tag(), failure.family(), blaming(failure, "mode", [&] { return failure.mode(); }));
  if (!use.is_there()) return fmt::format("{} has found no bond under load", of);
  return fmt::format("largest utilisation of {}: {:.4g} at step {:.0f} ({:.4g} s), bond {:.0f} between elements {:.0f} and {:.0f}, at ({:.4g}, {:.4g}, {:.4g}) m", of,
                     use.value, use.step, use.time, use.bond, use.first, use.second, use.x, use.y, use.z);
}

}  // namespace beadwork
