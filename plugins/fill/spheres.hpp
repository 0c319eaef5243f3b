#pragma once
// What every plugin that makes elements declares and sets.

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <span>

#include "core/base/failure.hpp"
#include "core/base/memory.hpp"
#include "core/domain/neighbours.hpp"
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
  /// Throws DeckFailure if so many more elements cannot be numbered, or held by this machine.
  void require_room(const Domain& domain, std::size_t count) const {
    const auto room = static_cast<std::size_t>(most_elements - domain.size());
    if (count > room)
      refuse(at(),
             fmt::format("{} elements more than the {} that are there cannot be numbered: a scene holds {} at most",
                         count, domain.size(), most_elements));
    constexpr Real least_bytes = 200;  // place, radius, mass, velocity, force of an element, and a bond or two
    if (const std::string why = why_no_memory(static_cast<Real>(count), "elements", least_bytes); !why.empty())
      refuse(at(), why);
  }

  /// New rows behind all others, members of the set; what stands in them is still to be given. Returns the first.
  Index add_rows(Domain& domain, const std::string& set, std::size_t count) {
    require_room(domain, count);
    const Index first = domain.add_elements(static_cast<Index>(count));
    Set& members = domain.sets()[set];
    for (Index row = first; row < domain.size(); ++row) members.push_back(row);
    return first;
  }

  /// Deepest overlap over the sum of the radii between elements from `first` on and those before it that are not `known`.
  static Real deepest_into_others(const Domain& domain, Index first, const std::set<Index>& known, const Pause& pause) {
    const auto position = domain.elements().column("position").view<Vec3>();
    const auto radius = domain.elements().column("radius").view<Real>();
    std::vector<Vec3> place;
    std::vector<Real> size;
    for (Index row = first; row < domain.size(); ++row) place.push_back(position[row]), size.push_back(radius[row]);
    const std::size_t own = place.size();
    for (Index row = 0; row < first; ++row)
      if (!domain.walls().is_wall(row) && !known.contains(row))
        place.push_back(position[row]), size.push_back(radius[row]);
    Real deepest = 0;
    if (place.size() == own) return deepest;
    for (const Pair& near : find_pairs_around(place, size, own, 0, 0, pause)) {
      const auto i = static_cast<std::size_t>(near.i), j = static_cast<std::size_t>(near.j);
      if (j >= own) deepest = std::max(deepest, 1 - (place[j] - place[i]).norm() / (size[i] + size[j]));
    }
    return deepest;
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
  Param<std::string> set{
      this,
      {.name = "set", .doc = "Name of the set that the elements form; it may exist already", .role = Role::makes_set}};
  Param<Real> density{
      this,
      {.name = "density", .unit = "kg/m^3", .range = positive, .doc = "Mass of an element over its volume 4/3 pi R^3"}};

 protected:
  /// Returns the first row.
  Index add_spheres(Domain& domain, std::span<const Vec3> centres, std::span<const Real> radii) {
    const Index first = add_rows(domain, *set, centres.size());
    shape(domain, first, centres, radii, *density);
    return first;
  }
};

}  // namespace beadwork
