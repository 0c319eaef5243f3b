#include "core/loop/largest_use.hpp"

#include <fmt/format.h>

#include "core/base/text.hpp"
#include "core/plugin/blame.hpp"

namespace beadwork {

LargestUse::LargestUse(Table& criteria, Index row)
    : value(criteria, "utilisation", "1", "Largest utilisation that a criterion has found so far", row),
      time(criteria, "time", "s", "Time at which it was found", row),
      step(criteria, "step", "1", "Step at which it was found", row),
      bond(criteria, "bond", "1", "Id of the bond that has it", row),
      first(criteria, "first", "1", "Id of the bond's first element", row),
      second(criteria, "second", "1", "Id of the bond's second element", row),
      element(criteria, "element", "1", "Id of the element that has it", row),
      x(criteria, "x", "m", "Its place along x, of a bond the middle", row),
      y(criteria, "y", "m", "Its place along y, of a bond the middle", row),
      z(criteria, "z", "m", "Its place along z, of a bond the middle", row) {
  bond = -1, element = -1;
}

void LargestUse::note(const Judged& highest, const Domain& domain, const Moment& moment) {
  if (highest.row < 0 || !(highest.utilisation > value)) return;
  const auto id = domain.elements().column("id").view<Index>();
  const auto at = domain.elements().column("position").view<Vec3>();
  value = highest.utilisation, time = moment.time, step = static_cast<Real>(moment.step);
  Vec3 place;
  if (highest.table) {
    const Index i = highest.table->first()[highest.row], j = highest.table->second()[highest.row];
    place = 0.5 * (at[i] + at[j]);
    bond = static_cast<Real>(highest.table->id()[highest.row]);
    first = static_cast<Real>(id[i]), second = static_cast<Real>(id[j]);
  } else {
    place = at[highest.row];
    element = static_cast<Real>(id[highest.row]);
  }
  x = place[0], y = place[1], z = place[2];
}

std::string sentence(const LargestUse& use, const Failure& failure) {
  const std::string of = fmt::format("<{} of=\"{}\"> ({})", failure.tag(), join(failure.families(), " "),
                                     blaming(failure, "mode", [&] { return failure.mode(); }));
  if (!use.is_there())
    return fmt::format("{} has found no {} under load", of, failure.judges_elements() ? "element" : "bond");
  const std::string whose = failure.judges_elements() ? fmt::format("element {:.0f}", Real(use.element))
                                                      : fmt::format("bond {:.0f} between elements {:.0f} and {:.0f}",
                                                                    Real(use.bond), Real(use.first), Real(use.second));
  return fmt::format("largest utilisation of {}: {:.4g} at step {:.0f} ({:.4g} s), {}, at ({:.4g}, {:.4g}, {:.4g}) m",
                     of, Real(use.value), Real(use.step), Real(use.time), whose, Real(use.x), Real(use.y), Real(use.z));
}

}  // namespace beadwork
