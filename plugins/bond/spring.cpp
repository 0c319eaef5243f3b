#include <fmt/format.h>

#include <numbers>

#include "core/base/failure.hpp"
#include "core/domain/vocabulary.hpp"
#include "core/mechanics/spring.hpp"
#include "core/mechanics/spring_stiffness.hpp"
#include "core/plugin/bond_law_of.hpp"

namespace beadwork {

/// The columns of the springs, and what is done with one of them.
struct SpringLaw {
  View<const Real> length, axial;
  Real young = 0;
  View<Real> axial_force, section_radius;  // null where nobody reads them

  static constexpr bool turns = false;

  template <class At>
  [[gnu::always_inline]] auto rest(const At& at) const {
    return SpringRest<typename At::Number>{at(length), at(axial)};
  }

  template <Pass pass, class At, class T>
  [[gnu::always_inline]] Wrench<T> act(const At& at, const Ends<T>& ends) const {
    const SpringRest<T> spring = rest(at);
    if constexpr (pass.sections) {
      if (axial_force) at.store(axial_force, spring_tension<T>(spring, ends.apart));
      if (section_radius) at.store(section_radius, sqrt(spring.axial * spring.length / T(std::numbers::pi * young)));
    }
    return {spring_force<T>(spring, ends.apart), zero<Vec<T>>(), zero<Vec<T>>()};
  }

  template <class At, class T>
  T stored(const At& at, const Ends<T>& ends) const {
    return spring_energy<T>(rest(at), ends.apart);
  }

  Matrix12 stiffness(const One& at, const Ends<Real>& ends, Slope slope) const {
    return spring_stiffness(rest(at), ends.apart, slope);
  }
};

/// Spring: resists stretching along the line of centres, and nothing else.   docs/theory/spring.md
class Spring final : public BondLawOf<SpringLaw> {
 public:
  static constexpr const char* about =
      "Springs between the centres of neighbouring elements: they resist stretching, and neither bending nor twisting";
  Param<Real> young{this,
                    {.name = "young", .unit = "Pa", .range = positive, .doc = "Young's modulus E of the springs"}};
  Param<Real> radius_ratio{this,
                           {.name = "radius-ratio",
                            .range = positive,
                            .doc = "Radius of a spring's section over the mean radius of its two elements",
                            .fallback = "1"}};

  Reads<Real> radius{this, field::radius};
  Keeps<Real> length{this, field::rest_length};
  Keeps<Real> axial{this, {"axial-stiffness", On::bonds, "N/m", "E A / L"}};
  Writes<Real> section_radius{this, field::section_radius};
  Writes<Real> axial_force{this, field::axial_force};

  void connect(Domain& domain, BondTable& table) override {
    const auto id = domain.elements().column("id").view<Index>();
    for (Index row = 0; row < table.size(); ++row) {
      const Index i = table.first()[row];
      const Index j = table.second()[row];
      const Real distance = (position[j] - position[i]).norm();
      if (!(distance > 1e-12 * (radius[i] + radius[j])))
        refuse(at(), fmt::format("elements {} and {} of family '{}' stand at one place: a spring between them has no "
                                 "direction; move one of them or leave it out of the sets",
                                 id[i], id[j], *name));
      const SpringRest<Real> rest = round_spring(distance, *young, *radius_ratio * 0.5 * (radius[i] + radius[j]));
      length[row] = rest.length;
      axial[row] = rest.axial;
    }
  }

 protected:
  AnyLaw law() const override {
    return SpringLaw{length.view(), axial.view(), *young, axial_force.view(), section_radius.view()};
  }
};

}  // namespace beadwork
