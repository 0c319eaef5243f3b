#include <fmt/format.h>

#include "core/base/units.hpp"
#include "core/io/packing_file.hpp"
#include "plugins/fill/spheres.hpp"

namespace beadwork {

/// Elements from a packing that was stored before: a run.h5, or lines `x y z r`.
class ReadPacking final : public ElementMaker {
 public:
  static constexpr const char* about = "Elements from a stored packing: the first frame of a run.h5, or a text with lines x y z r";
  Param<std::string> file{this, {.name = "file", .doc = "The file, from the deck's folder: .h5, or a text"}};
  Param<std::string> unit{this, {.name = "unit", .doc = "Unit of the lengths in the file (a run.h5 is in m)", .fallback = "m"}};

  void check(Complaints& complaints) const override {
    const auto found = find_unit(*unit);
    if (!found || !(found->dimension == find_unit("m")->dimension))
      complaints.error(unit.at(), fmt::format("'unit' wants a unit of length such as \"mm\", got \"{}\"", *unit));
  }

  void fill(Domain& domain, const FillJob& job) override {
    const StoredPacking packing = read_packing(job.resolve_path(*file), find_unit(*unit)->scale);
    add_spheres(domain, packing.position, packing.radius);
    job.say(fmt::format("{}: {} elements from {}", tag(), packing.position.size(), *file));
  }
};

}  // namespace beadwork
