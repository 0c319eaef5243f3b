#include <fmt/format.h>

#include "core/base/failure.hpp"
#include "core/base/units.hpp"
#include "core/io/packing_file.hpp"
#include "plugins/fill/spheres.hpp"

namespace beadwork {

/// Elements from a packing that was stored before: a run.h5, or lines `x y z r`.
class ReadPacking final : public ElementMaker {
 public:
  static constexpr const char* about = "Elements from a stored packing: the first frame of a run.h5, or a text with lines x y z r";
  Param<std::string> file{this, {.name = "file", .doc = "The file, .h5 or a text: its path from the folder of the file that names it", .role = Role::file}};
  Param<std::string> unit{this, {.name = "unit", .doc = "Unit of the lengths in a text, m where absent; a run.h5 states its own", .optional = true}};

  void check(Complaints& complaints) const override {
    if (!unit.in_deck()) return;
    const auto found = find_unit(*unit);
    if (!found || !(found->dimension == find_unit("m")->dimension))
      complaints.error(unit.at(), fmt::format("'unit' wants a unit of length such as \"mm\", got \"{}\"", *unit));
    if (states_its_unit(*file))
      complaints.error(unit.at(), "'unit' belongs to a text; the lengths in a run.h5 state their own: leave it out");
  }

  void fill(Domain& domain, const FillJob& job) override {
    const StoredPacking packing = stored(*file);
    add_spheres(domain, packing.position, packing.radius);
    job.say(fmt::format("{}: {} elements from {}", tag(), packing.position.size(), *file));
  }

 private:
  StoredPacking stored(const std::string& path) const {
    try {
      return read_packing(path, unit.given() ? find_unit(*unit)->scale : 1);
    } catch (const MachineFailure& failure) {
      refuse(file.at(), failure.what());  // it is there, but cannot be opened, or is no HDF5
    }
  }
};

}  // namespace beadwork
