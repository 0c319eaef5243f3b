#include <fmt/format.h>

#include "core/base/failure.hpp"
#include "plugins/fill/spheres.hpp"

namespace beadwork {

/// Elements of one radius on a simple cubic lattice, each touching its neighbours along the axes.
class Lattice final : public ElementMaker {
 public:
  static constexpr const char* about = "Elements of one radius on a simple cubic lattice, touching along the axes";
  Param<Vec3> from{this, {.name = "from", .unit = "m", .doc = "Centre of the first element", .fallback = "0 0 0 m"}};
  Param<Vec3> count{this, {.name = "count", .range = {1}, .doc = "Number of elements along x, y and z"}};
  Param<Real> radius{this,
                     {.name = "radius", .unit = "m", .range = positive, .doc = "Radius; the spacing is twice that"}};

  void check(Complaints& complaints) const override {
    for (int axis = 0; axis < 3; ++axis)
      if (count->coeff(axis) != std::floor(count->coeff(axis)))
        complaints.error(count.at(), "'count' wants three whole numbers");
    if (count->prod() > static_cast<Real>(most_elements))
      complaints.error(count.at(),
                       fmt::format("'count' asks for {} elements, more than rows can be numbered", count->prod()));
  }

  void fill(Domain& domain, const FillJob& job) override {
    const auto number = static_cast<std::size_t>(count->prod());
    require_room(domain, number);
    std::vector<Vec3> centres;
    centres.reserve(number);
    for (Real i = 0; i < count->x(); ++i)
      for (Real j = 0; j < count->y(); ++j) {
        if (j == 0 || count->z() > 1000) job.pause();
        for (Real k = 0; k < count->z(); ++k) centres.push_back(*from + 2 * *radius * Vec3(i, j, k));
      }
    add_spheres(domain, centres, std::vector<Real>(centres.size(), *radius));
  }
};

}  // namespace beadwork
