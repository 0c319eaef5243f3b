#include <fmt/format.h>

#include <set>

#include "core/base/failure.hpp"
#include "core/domain/vocabulary.hpp"
#include "core/mechanics/beam.hpp"
#include "core/mechanics/beam_stiffness.hpp"
#include "core/plugin/bond_law_of.hpp"

namespace beadwork {

/// The columns of the beams, and what is done with one of them.
struct CohesiveBeamLaw {
  View<const Vec3> axis;
  View<const Real> length, axial, bending;
  Real torsion_to_bending = 0;
  View<Real> axial_force, bending_moment, twisting_moment, section_radius;  // null where nobody reads them

  static constexpr bool turns = true;

  template <class At>
  [[gnu::always_inline]] auto rest(const At& at) const {
    using T = typename At::Number;
    const T b = at(bending);
    return BeamRest<T>{at(axis), at(length), at(axial), b, T(torsion_to_bending) * b};
  }

  template <Pass pass, class At, class T>
  [[gnu::always_inline]] Wrench<T> act(const At& at, const TurningEnds<T>& ends) const {
    const Wrench<T> wrench = beam_wrench<T>(rest(at), ends.apart, ends.q1, ends.q2);
    if constexpr (pass.sections) tell(at, beam_section<T>(ends.apart, wrench));
    return wrench;
  }

  // in single precision
  template <class At, class T>
  [[gnu::always_inline]] BeamShift<T> shift(const At& at, const TurningEnds<T>& ends) const {
    return beam_shift<T>(rest(at), ends.apart, ends.q1, ends.q2);
  }
  template <Pass pass, class At, class T>
  [[gnu::always_inline]] Wrench<T> act(const At& at, const BeamShift<T>& s) const {
    const auto r = rest(at);
    const Wrench<T> wrench = beam_wrench<T>(r, s);
    if constexpr (pass.sections) tell(at, beam_section<T>(r.length * s.normal + s.moved, wrench));
    return wrench;
  }

  template <class At, class T>
  [[gnu::always_inline]] void tell(const At& at, const BeamSection<T>& section) const {
    if (axial_force) at.store(axial_force, section.axial_force);
    if (bending_moment) at.store(bending_moment, max(section.moment1, section.moment2));
    if (twisting_moment) at.store(twisting_moment, section.torque);
    if (section_radius) at.store(section_radius, sqrt(T(2) * at(bending) / at(axial)));  // B = k_n r^2 / 2
  }

  template <class At, class T>
  T stored(const At& at, const TurningEnds<T>& ends) const {
    return beam_energy<T>(rest(at), ends.apart, ends.q1, ends.q2).total();
  }

  Matrix12 stiffness(const One& at, const TurningEnds<Real>& ends, Slope slope) const {
    return beam_stiffness(rest(at), ends.apart, slope);
  }
};

/// Beams between elements that had turned before they were bonded: orientations count from the bonding.
struct CohesiveBeamFromTurned : CohesiveBeamLaw {
  View<const Quat> reference1, reference2;

  template <class At, class T>
  [[gnu::always_inline]] TurningEnds<T> since_bonding(const At& at, const TurningEnds<T>& ends) const {
    TurningEnds<T> since;
    since.apart = ends.apart;
    since.q1 = ends.q1 * conjugate(at(reference1));
    since.q2 = ends.q2 * conjugate(at(reference2));
    return since;
  }
  template <Pass pass, class At, class T>
  [[gnu::always_inline]] Wrench<T> act(const At& at, const TurningEnds<T>& ends) const {
    return CohesiveBeamLaw::act<pass>(at, since_bonding(at, ends));
  }
  template <Pass pass, class At, class T>
  [[gnu::always_inline]] Wrench<T> act(const At& at, const BeamShift<T>& s) const {
    return CohesiveBeamLaw::act<pass>(at, s);
  }
  template <class At, class T>
  [[gnu::always_inline]] BeamShift<T> shift(const At& at, const TurningEnds<T>& ends) const {
    return CohesiveBeamLaw::shift(at, since_bonding(at, ends));
  }
  template <class At, class T>
  T stored(const At& at, const TurningEnds<T>& ends) const {
    return CohesiveBeamLaw::stored(at, since_bonding(at, ends));
  }
};

/// Cohesive beam: resists stretching, bending and twisting.   docs/theory/cohesive-beam.md
class CohesiveBeam final : public BondLawOf<CohesiveBeamLaw, CohesiveBeamFromTurned> {
 public:
  static constexpr const char* about = "Beams of round section between neighbouring elements: a bonded elastic solid";
  Param<Real> young{
      this,
      {.name = "young", .unit = "Pa", .range = positive, .doc = "Young's modulus E_mu of the beams (microscopic)"}};
  Param<Real> poisson{this,
                      {.name = "poisson",
                       .range = {-1, 0.5, true, false},
                       .doc = "Poisson's ratio nu_mu of the beams (microscopic)",
                       .fallback = "0.3"}};
  Param<Real> radius_ratio{
      this,
      {.name = "radius-ratio", .range = positive, .doc = "Radius of a beam over the mean radius of its two elements"}};
  Param<std::string> radius_of{
      this,
      {.name = "radius-of",
       .doc =
           "Whose mean radius that is: of the two elements of a beam, or of all elements that are bonded, so that all "
           "beams have one section",
       .fallback = "pair",
       .choices = {"pair", "family"}}};

  Reads<Real> radius{this, field::radius};
  Keeps<Vec3> axis{this,
                   {"axis", On::bonds, "1", "Direction from the first to the second element when the bond was made"}};
  Keeps<Real> length{this, field::rest_length};
  Keeps<Real> axial{this, {"axial-stiffness", On::bonds, "N/m", "E A / L"}};
  Keeps<Real> bending{this, {"bending-stiffness", On::bonds, "N.m", "2 E I / L"}};
  // Only where elements had turned before they were bonded, which is known when they are.
  Keeps<Quat> reference1{this,
                         {"reference-1", On::bonds, "1", "Orientation of the first element when the bond was made"}};
  Keeps<Quat> reference2{this,
                         {"reference-2", On::bonds, "1", "Orientation of the second element when the bond was made"}};
  Writes<Real> section_radius{this, field::section_radius};
  Writes<Real> axial_force{this, field::axial_force};
  Writes<Real> bending_moment{this, field::bending_moment};
  Writes<Real> twisting_moment{this, field::twisting_moment};

  void choose() override {
    BondLawOf::choose();
    reference1.want(false);
    reference2.want(false);
  }

  void connect(Domain& domain, BondTable& table) override {
    note_turned(domain, table);
    const auto id = domain.elements().column("id").view<Index>();
    const Real of_family = *radius_of == "family" ? mean_radius(table) : 0;
    for (Index row = 0; row < table.size(); ++row) {
      const Index i = table.first()[row];
      const Index j = table.second()[row];
      const Real r = *radius_ratio * (of_family > 0 ? of_family : 0.5 * (radius[i] + radius[j]));
      const Vec3 apart = position[j] - position[i];
      if (!(apart.norm() > 1e-12 * (radius[i] + radius[j])))
        refuse(at(), fmt::format("elements {} and {} of family '{}' stand at one place: a beam between them has no "
                                 "direction; move one of them or leave it out of the sets",
                                 id[i], id[j], *name));
      const BeamRest<Real> rest = round_beam(apart, *young, *poisson, r);
      axis.set(row, rest.axis);
      length[row] = rest.length;
      axial[row] = rest.axial;
      bending[row] = rest.bending;
    }
  }

 protected:
  AnyLaw law() const override {
    if (reference1) return CohesiveBeamFromTurned{columns(), reference1.view(), reference2.view()};
    return columns();
  }

 private:
  // Of the elements that are bonded, each counted once.
  Real mean_radius(const BondTable& table) const {
    std::set<Index> bonded;
    for (Index row = 0; row < table.size(); ++row) bonded.insert({table.first()[row], table.second()[row]});
    Real sum = 0;
    for (const Index element : bonded) sum += radius[element];
    return bonded.empty() ? 0 : sum / static_cast<Real>(bonded.size());
  }
  void note_turned(Domain& domain, BondTable& table) {
    bool turned = false;
    for (Index row = 0; row < table.size(); ++row)
      for (const Index end : {table.first()[row], table.second()[row]}) turned |= orientation[end].v.squaredNorm() > 0;
    if (!turned) return;
    for (FieldUse* use : {static_cast<FieldUse*>(&reference1), static_cast<FieldUse*>(&reference2)})
      table.rows().add(use->field()).keep();
    table.rebind();
    bind(domain);
    for (Index row = 0; row < table.size(); ++row) {
      reference1.set(row, orientation[table.first()[row]]);
      reference2.set(row, orientation[table.second()[row]]);
    }
  }

  CohesiveBeamLaw columns() const {
    return {axis.view(),
            length.view(),
            axial.view(),
            bending.view(),
            torsion_to_bending(*poisson),
            axial_force.view(),
            bending_moment.view(),
            twisting_moment.view(),
            section_radius.view()};
  }
};

}  // namespace beadwork
