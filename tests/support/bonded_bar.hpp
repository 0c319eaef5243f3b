#pragma once
// A domain as a run has it in its middle: elements in a line of cubes, a family of bonds with some broken, sets,
// breaks.

#include <cmath>

#include "core/domain/domain.hpp"
#include "core/domain/vocabulary.hpp"

namespace beadwork::testing {

inline const Field stretch{"stretch", On::bonds, Type::vec3, "m", "Stretch when accepted", ""};
inline const Field grip_work{"work", On::scene, Type::real, "J", "Work of the grips", ""};
inline const Field cursor{"cursor", On::scene, Type::index, "1", "Row of the table", ""};

/// Declares what the scene keeps, as an assembly does before there is any element.
inline void declare_bar(Domain& domain) {
  domain.elements().add(field::velocity).keep();
  domain.elements().add(field::orientation).keep();
  domain.elements().add(field::force);
  domain.scene().add(grip_work).keep();
  domain.scene().add(cursor).keep();
  for (const char* family : {"resin", "interface"}) {
    BondTable& bonds = domain.add_family(family);
    bonds.rows().add(field::damage).keep();
    bonds.rows().add(stretch).keep();
    bonds.rows().add(field::axial_force);
    bonds.rebind();
  }
}

/// Some number for place (row, column), with all its bits in use.
inline Real some(Index row, int column) { return std::sin(1.0 + row * 7.7 + column * 1.3) * std::exp2(row % 40 - 20); }

inline void fill_bonds(BondTable& bonds, std::vector<std::pair<Index, Index>> pairs, Index first_id) {
  bonds.create(std::move(pairs), first_id);
  const auto damage = bonds.rows().column("damage").view<Real>();
  const auto held = bonds.rows().column("stretch").view<Vec3>();
  const auto axial = bonds.rows().column("axial-force").view<Real>();
  for (Index b = 0; b < bonds.size(); ++b) {
    damage[b] = some(b, 9);
    held.set(b, Vec3(some(b, 10), some(b, 11), some(b, 12)));
    axial[b] = some(b, 13);
    if (b % 7 == 3) bonds.state()[b] = State::softening;
  }
}

/// Breaks every `nth` bond and writes it into the log.
inline void break_some(Domain& domain, Index family, Index nth, std::int64_t step) {
  BondTable& bonds = *domain.families()[static_cast<std::size_t>(family)];
  const auto position = domain.elements().column("position").view<Vec3>();
  for (Index b = 0; b < bonds.size(); b += nth) {
    if (bonds.state()[b] == State::broken) continue;
    bonds.state()[b] = State::broken;
    domain.breaks().breaks.push_back({1e-7 * static_cast<Real>(step), step, family, bonds.id()[b],
                                      domain.breaks().mode(b % 2 ? "tension" : "shear"), position[bonds.first()[b]],
                                      some(b, 14)});
  }
}

inline void fill_bar(Domain& domain, Index count) {
  domain.add_elements(count);
  const auto position = domain.elements().column("position").view<Vec3>();
  const auto velocity = domain.elements().column("velocity").view<Vec3>();
  const auto orientation = domain.elements().column("orientation").view<Quat>();
  const auto radius = domain.elements().column("radius").view<Real>();
  std::vector<std::pair<Index, Index>> near, far;
  for (Index i = 0; i < count; ++i) {
    position.set(i, Vec3(1e-3 * i, some(i, 0) * 1e-9, some(i, 1) * 1e-9));
    velocity.set(i, Vec3(some(i, 2), some(i, 3), some(i, 4)));
    orientation.set(i, Quat{some(i, 5), Vec3(some(i, 6), some(i, 7), some(i, 8))});
    radius[i] = 0.5e-3 + 1e-5 * (i % 10);
    if (i + 1 < count) near.push_back({i, i + 1});
    if (i + 97 < count) far.push_back({i, i + 97});
  }
  fill_bonds(*domain.families()[0], near, 0);
  fill_bonds(*domain.families()[1], far, static_cast<Index>(near.size()));
  for (Index i = 0; i < count; i += 10) domain.sets()["left"].push_back(i);
  for (Index i = count / 2; i < count; ++i) domain.sets()["right"].push_back(i);
  domain.scene().column("work").view<Real>()[0] = 0.1;
  domain.scene().column("cursor").view<Index>()[0] = 17;
  domain.cut_families();
}

}  // namespace beadwork::testing
