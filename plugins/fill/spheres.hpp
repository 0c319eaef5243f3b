#pragma once
// What every plugin that makes elements declares and sets.

#include <span>

#include "core/domain/vocabulary.hpp"
#include "core/mechanics/sphere.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork {

/// A filling plugin that makes or changes elements.
class SphereFiller : public Filler {
 public:
  Writes<Real> mass{this, field::mass};
  Writes<Real> inertia{this, field::inertia};

 protected:
  /// New rows behind all others, members of the set; what stands in them is still to be given. Returns the first.
  Index add_rows(Domain& domain, const std::string& set, Index count) {
    const Index first = domain.add_elements(count);
    Set& members = domain.sets()[set];
    for (Index row = first; row < first + count; ++row) members.push_back(row);
    return first;
  }

  /// Makes the rows from `first` on these spheres; their masses and moments of inertia follow from the density.
  void shape(Domain& domain, Index first, std::span<const Vec3> centres, std::span<const Real> radii, Real density) {
    bind(domain);
    const auto position = domain.elements().column("position").view<Vec3>();
    const auto radius = domain.elements().column("radius").view<Real>();
    for (std::size_t k = 0; k < centres.size(); ++k) {
      const Index row = first + static_cast<Index>(k);
      const Real m = sphere_mass(density, radii[k]);
      position.set(row, centres[k]);
      radius[row] = radii[k];
      if (mass) mass[row] = m;
      if (inertia) inertia[row] = sphere_inertia(m, radii[k]);
    }
  }
};

/// A filling plugin that makes elements of one density in one set.
class ElementMaker : public SphereFiller {
 public:
  Param<std::string> set{this, {.name = "set", .doc = "Name of the set that the elements form; it may exist already", .role = Role::makes_set}};
  Param<Real> density{this, {.name = "density", .unit = "kg/m^3", .range = positive, .doc = "Mass of an element over its volume 4/3 pi R^3"}};

 protected:
  /// Returns the first row.
  Index add_spheres(Domain& domain, std::span<const Vec3> centres, std::span<const Real> radii) {
    const Index first = add_rows(domain, *set, static_cast<Index>(centres.size()));
    shape(domain, first, centres, radii, *density);
    return first;
  }
};

}  // namespace beadwork
