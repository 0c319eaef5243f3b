#pragma once
// What every plugin that makes elements declares and sets.

#include <numbers>

#include "core/domain/vocabulary.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork {

/// A filling plugin that makes elements of one density in one set.
class ElementMaker : public Filler {
 public:
  Param<std::string> set{this, {.name = "set", .doc = "Name of the set that the elements form; it may exist already", .role = Role::makes_set}};
  Param<Real> density{this, {.name = "density", .unit = "kg/m^3", .range = positive, .doc = "Mass of an element over its volume 4/3 pi R^3"}};
  Writes<Real> mass{this, field::mass};
  Writes<Real> inertia{this, field::inertia};

 protected:
  /// Adds spheres; their masses and moments of inertia follow from the density. Returns the first row.
  Index add_spheres(Domain& domain, std::span<const Vec3> centres, std::span<const Real> radii) {
    const auto count = static_cast<Index>(centres.size());
    const Index first = domain.add_elements(count);
    bind(domain);
    const auto position = domain.elements().column("position").view<Vec3>();
    const auto radius = domain.elements().column("radius").view<Real>();
    Set& members = domain.sets()[*set];
    for (Index k = 0; k < count; ++k) {
      const Index row = first + k;
      const Real r = radii[static_cast<std::size_t>(k)];
      position.set(row, centres[static_cast<std::size_t>(k)]);
      radius[row] = r;
      members.push_back(row);
      set_inertia(row, *density * 4.0 / 3.0 * std::numbers::pi * r * r * r, r);
    }
    return first;
  }

  /// I = 2/5 m R^2 of a homogeneous sphere.
  void set_inertia(Index row, Real m, Real r) {
    if (mass) mass[row] = m;
    if (inertia) inertia[row] = 0.4 * m * r * r;
  }
};

}  // namespace beadwork
