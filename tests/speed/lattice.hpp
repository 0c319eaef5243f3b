#pragma once
// What the loops over bonds are measured on: a simple cubic lattice about as large as the bar of xml-cases/speed,
// bonded along axes and one face diagonal, so that there are about 3.1 bonds an element; slightly moved and turned, so
// that no term of the law is zero.

#include <utility>
#include <vector>

#include "core/domain/domain.hpp"
#include "core/domain/vocabulary.hpp"
#include "core/mechanics/beam.hpp"
#include "core/plugin/bond_law_of.hpp"

namespace beadwork::speed {

struct Lattice {
  static constexpr Index nx = 112, ny = 14, nz = 26;
  std::vector<Vec3> place;
  std::vector<std::pair<Index, Index>> pairs;

  Lattice() {
    for (Index i = 0; i < nx; ++i)
      for (Index j = 0; j < ny; ++j)
        for (Index k = 0; k < nz; ++k) {
          const Index here = row(i, j, k);
          place.emplace_back(i, j, k);
          if (k + 1 < nz) pairs.emplace_back(here, row(i, j, k + 1));
          if (j + 1 < ny) pairs.emplace_back(here, row(i, j + 1, k));
          if (i + 1 < nx) pairs.emplace_back(here, row(i + 1, j, k));
          if ((i + j + k) % 4 == 0 && i + 1 < nx && j + 1 < ny) pairs.emplace_back(here, row(i + 1, j + 1, k));
        }
  }
  static Index row(Index i, Index j, Index k) { return (i * ny + j) * nz + k; }

  BeamRest<Real> rest(Index first, Index second) const {
    return round_beam(place[static_cast<std::size_t>(second)] - place[static_cast<std::size_t>(first)], 1, 0.3, 0.25);
  }
};

inline void disturb(Index n, Vec3& x, Quat& q) {
  const Real a = 1e-3 * static_cast<Real>(n % 17 - 8);
  const Real b = 1e-3 * static_cast<Real>(n % 13 - 6);
  x += Vec3(a, b, -a);
  q = normalise(Quat{1, Vec3(b, -a, b)});
}

/// The beam without anything that a scene may ask of it besides.
struct Beams {
  View<const Vec3> axis;
  View<const Real> length, axial, bending;
  static constexpr bool turns = true;

  template <class At>
  [[gnu::always_inline]] auto rest(const At& at) const {
    using T = typename At::Number;
    const T b = at(bending);
    return BeamRest<T>{at(axis), at(length), at(axial), b, T(0.4) * b};
  }
  template <Pass pass, class At, class T>
  [[gnu::always_inline]] Wrench<T> act(const At& at, const TurningEnds<T>& ends) const {
    return beam_wrench<T>(rest(at), ends.apart, ends.q1, ends.q2);
  }
};

/// The lattice as the core has it.
/// What a law that turns reads and adds to.
inline ElementLines lines_of(Domain& domain) {
  Table& elements = domain.elements();
  return ElementLines({elements.column("position").view<Vec3>(), elements.column("orientation").view<Quat>(), {}, {},
                       elements.column("force").view<Vec3>(), elements.column("torque").view<Vec3>(), {}, {},
                       domain.size()});
}

struct Scene {
  Lattice lattice;
  Domain domain;
  BondTable* table;
  Beams law;

  Scene() {
    for (const Field* field : {&field::orientation, &field::force, &field::torque}) domain.elements().add(*field);
    domain.add_elements(static_cast<Index>(lattice.place.size()));
    const auto x = domain.elements().column("position").view<Vec3>();
    const auto q = domain.elements().column("orientation").view<Quat>();
    for (Index n = 0; n < domain.size(); ++n) {
      Vec3 place = lattice.place[static_cast<std::size_t>(n)];
      Quat turn = identity();
      disturb(n, place, turn);
      x.set(n, place);
      q.set(n, turn);
    }
    table = &domain.add_family("beam");
    const auto column = [&](const char* name, Type type) -> Column& {
      return table->rows().add({name, On::bonds, type, "1", "", ""});
    };
    column("axis", Type::vec3), column("length", Type::real), column("axial", Type::real),
        column("bending", Type::real);
    table->create(lattice.pairs, 0);
    domain.cut_families();
    const auto axis = table->rows().column("axis").view<Vec3>();
    const auto number = [&](const char* name) { return table->rows().column(name).view<Real>(); };
    const auto length = number("length"), axial = number("axial"), bending = number("bending");
    for (Index b = 0; b < table->size(); ++b) {
      const auto rest = lattice.rest(table->first()[b], table->second()[b]);
      axis.set(b, rest.axis);
      length[b] = rest.length;
      axial[b] = rest.axial;
      bending[b] = rest.bending;
    }
    law = {axis, length, axial, bending};
  }
};

}  // namespace beadwork::speed
