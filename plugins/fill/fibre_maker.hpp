#pragma once
// Fibres as rows of elements that overlap, their neighbours listed.   Section 4 of the paper; docs/theory/packing.md

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/domain/neighbours.hpp"
#include "core/mechanics/sphere.hpp"
#include "plugins/fill/spheres.hpp"

namespace beadwork {

/// Centres at first + k step, k < count.
struct FibreLine {
  Vec3 first, step;
  std::size_t count;
  Real spacing;  ///< [m]
  Real share;    ///< length of the fibre that one element stands for [m]
};

/// A filling plugin that makes fibres.
class FibreMaker : public SphereFiller {
 public:
  Param<std::string> set{
      this, {.name = "set", .doc = "Name of the set that the elements of the fibres form", .role = Role::makes_set}};
  Param<Real> density{
      this,
      {.name = "density",
       .unit = "kg/m^3",
       .range = positive,
       .doc = "Density rho of the fibre: an element has the mass of its share of it, rho pi R^2 length / count"}};
  Param<Real> radius{
      this, {.name = "radius", .unit = "m", .range = positive, .doc = "Radius R of the fibre and of its elements"}};
  Param<std::int64_t> count{this,
                            {.name = "count",
                             .range = {1},
                             .doc = "Number of elements of a fibre",
                             .knob = Knob::smaller_is_faster,
                             .one_of = "elements"}};
  Param<Real> spacing{this,
                      {.name = "spacing",
                       .unit = "m",
                       .range = positive,
                       .doc = "Distance of neighbouring centres, rounded so that a whole number fits",
                       .one_of = "elements"}};
  Param<Real> overlap{this,
                      {.name = "overlap",
                       .range = {0, 1, false, true},
                       .doc = "1 - spacing/(2 R), rounded likewise",
                       .one_of = "elements"}};
  Param<std::string> ends{
      this,
      {.name = "ends",
       .doc = "Where the row ends. cut: its pieces fill the length, so the first and the last element reach out of it; "
              "inside: all elements lie inside; centred: the first and the last centre are its ends",
       .fallback = "cut",
       .choices = {"cut", "inside", "centred"}}};

 protected:
  /// The row of a fibre. Throws DeckFailure where no row fits.
  FibreLine row_between(const Vec3& from, const Vec3& to) const {
    const Real length = (to - from).norm(), inset = *ends == "inside" ? *radius : 0, room = length - 2 * inset;
    if (!(room >= 0) || !(length > 0))
      refuse(at(), fmt::format("a fibre {:.6g} m long has no room for an element of radius {:.6g} m inside", length,
                               *radius));
    const bool cut = *ends == "cut";
    const Real wanted = spacing.given() ? *spacing : overlap.given() ? 2 * *radius * (1 - *overlap) : 0;
    const Real pieces = count.given() ? static_cast<Real>(*count) - (cut ? 0 : 1) : std::round(room / wanted);
    constexpr Real most = 1e9;
    if (pieces > most) refuse(at(), fmt::format("{:.3g} elements in one fibre are too many", pieces));
    if (!cut && pieces < 1)
      refuse(at(), fmt::format("ends=\"{}\" wants two elements at least, one at each end", *ends));
    const Real step = room / std::max<Real>(1, pieces);
    if (!cut && !(step > 0)) refuse(at(), "a fibre no longer than one element has room for no second one inside");
    if (step > 2 * *radius * (1 + 1e-9))
      refuse(at(), fmt::format("elements {:.6g} m apart do not touch, with a radius of {:.6g} m: ask for more of them, "
                               "at least {:.0f}",
                               step, *radius, std::ceil(room / (2 * *radius)) + (cut ? 0 : 1)));
    const Vec3 along = (to - from) / length;
    const auto number = static_cast<std::size_t>(std::max<Real>(1, pieces)) + (cut ? 0 : 1);
    return {from + (cut ? step / 2 : inset) * along, step * along, number, step, length / static_cast<Real>(number)};
  }

  /// Makes the elements of these fibres and lists their neighbours.
  void make(Domain& domain, std::span<const FibreLine> fibres) {
    std::vector<Vec3> centres;
    for (const FibreLine& row : fibres)
      for (std::size_t k = 0; k < row.count; ++k) centres.push_back(row.first + static_cast<Real>(k) * row.step);
    require_free(domain, centres);
    const Index first = add_rows(domain, *set, centres.size());
    shape(domain, first, centres, std::vector<Real>(centres.size(), *radius), *density);
    PairList& pairs = domain.pairs()[*set];
    Index here = first;
    for (const FibreLine& row : fibres)
      for (std::size_t k = 0; k < row.count; ++k, ++here) {
        const Real m = *density * std::numbers::pi * *radius * *radius * row.share;
        if (mass) mass[here] = m;
        if (inertia) inertia[here] = sphere_inertia(m, *radius);
        if (k > 0) pairs.emplace_back(here - 1, here);
      }
  }

  std::string row_words(const FibreLine& row) const {
    return fmt::format("{} elements {:.6g} m apart, overlap {:.4g}", row.count, row.spacing, overlap_of(row));
  }
  std::string row_json(const FibreLine& row) const {
    return fmt::format(R"("elements_of_a_fibre":{},"spacing":{:.8g},"overlap":{:.6g})", row.count, row.spacing,
                       overlap_of(row));
  }

 private:
  Real overlap_of(const FibreLine& row) const { return 1 - row.spacing / (2 * *radius); }

  /// Throws DeckFailure where a new element overlaps one that was there.
  void require_free(const Domain& domain, std::span<const Vec3> centres) const {
    std::vector<Vec3> place(centres.begin(), centres.end());
    std::vector<Real> size(centres.size(), *radius);
    const auto position = domain.elements().column("position").view<Vec3>();
    const auto there = domain.elements().column("radius").view<Real>();
    for (Index row = 0; row < domain.size(); ++row) {
      if (domain.walls().is_wall(row)) continue;
      place.push_back(position[row]);
      size.push_back(there[row]);
    }
    for (const Pair& near : find_pairs(place, size)) {
      const auto i = static_cast<std::size_t>(near.i), j = static_cast<std::size_t>(near.j);
      if (i >= centres.size() || j < centres.size()) continue;
      if ((place[j] - place[i]).norm() >= (1 - 1e-6) * (size[i] + size[j])) continue;  // they touch
      const Vec3& x = place[j];
      refuse(at(), fmt::format("this fibre overlaps an element that is there already, at {:.6g} {:.6g} {:.6g} m: move "
                               "it, or make fibres before what is packed around them",
                               x.x(), x.y(), x.z()));
    }
  }
};

}  // namespace beadwork
