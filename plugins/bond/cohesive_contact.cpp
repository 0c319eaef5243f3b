#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/failure.hpp"
#include "core/base/units.hpp"
#include "core/domain/vocabulary.hpp"
#include "plugins/bond/cohesive_laws.hpp"
#include "plugins/bond/interface_normals.hpp"

namespace beadwork {

namespace {

const OwnField opening_field{"opening", On::bonds, "m",
                             "Distance of the two faces along the normal, positive when pulled apart"};
const OwnField sliding_field{"sliding", On::bonds, "m", "Sliding of the two faces against each other"};

using Opening = IndependentModes<CohesiveModes::normal>;
using Sliding = IndependentModes<CohesiveModes::shear>;
using Both = IndependentModes<CohesiveModes::both>;

template <class Modes>
using PairFacesLaw = CohesiveFaces<false, Modes>;
template <class Modes>
using CarriedFacesLaw = CohesiveFaces<true, Modes>;

}  // namespace

/// Cohesive contact (CCM): linear up to the strength, then linear softening to zero.   Eqs (3)-(5)
/// docs/theory/cohesive-contact.md
class CohesiveContact final
    : public BondLawOf<CohesiveOpening, PairFacesLaw<Sliding>, PairFacesLaw<Both>, PairFacesLaw<MixedMode>,
                       CarriedFacesLaw<Opening>, CarriedFacesLaw<Sliding>, CarriedFacesLaw<Both>,
                       CarriedFacesLaw<MixedMode>> {
 public:
  static constexpr const char* about =
      "Cohesive contact (CCM): elastic up to the strength, then softening in a straight line to zero";
  Param<std::string> modes{this,
                           {.name = "modes",
                            .doc = "Which displacements the contact resists",
                            .fallback = "normal",
                            .choices = {"normal", "shear", "both"}}};
  Param<std::string> normal{
      this,
      {.name = "normal",
       .doc =
           "What opening and sliding are measured against: pair, the line of centres (Eqs (3), (4); oblique contacts "
           "lock in shear); plane, the plane that the interface lies in; axis, away from the axis of a fibre",
       .fallback = "pair",
       .choices = {"pair", "plane", "axis"}}};
  Param<Vec3> plane_normal{
      this,
      {.name = "plane-normal",
       .doc = "Normal of the plane, of any length and either sign; fitted to the points of contact where absent",
       .optional = true}};
  Param<Vec3> axis_point{this,
                         {.name = "axis-point",
                          .unit = "m",
                          .doc = "A point on the axis; where absent, rows of elements of the first set of 'between' "
                                 "are fibres with an axis each",
                          .optional = true}};
  Param<Vec3> axis_direction{
      this,
      {.name = "axis-direction", .doc = "Direction of the axis, of any length and either sign", .optional = true}};
  Param<Real> strength{
      this, {.name = "strength", .unit = "Pa", .range = positive, .doc = "Traction sigma at which damage starts"}};
  Param<Real> energy_{this,
                      {.name = "energy",
                       .unit = "J/m2",
                       .range = positive,
                       .doc = "Fracture energy G of the contact's area, Eq (5): u_p = 2 G / sigma"}};
  Param<Real> shear_strength{this,
                             {.name = "shear-strength",
                              .unit = "Pa",
                              .range = positive,
                              .doc = "Strength against sliding; as 'strength' where absent",
                              .optional = true}};
  Param<Real> shear_energy{this,
                           {.name = "shear-energy",
                            .unit = "J/m2",
                            .range = positive,
                            .doc = "Fracture energy of sliding; as 'energy' where absent",
                            .optional = true}};
  Param<std::string> coupling{
      this,
      {.name = "coupling",
       .doc = "none: each mode by its own law, failure in either takes both; linear and benzeggagh-kenane: one damage "
              "for both modes, failure at the energy of that criterion for the mode mix",
       .fallback = "none",
       .choices = {"none", "linear", "benzeggagh-kenane"}}};
  Param<Real> exponent{this,
                       {.name = "exponent",
                        .range = {0.5, 10},
                        .doc = "Exponent of Benzeggagh and Kenane, often 1.5 to 2.5",
                        .optional = true}};
  Param<Real> stiffness{this,
                        {.name = "stiffness",
                         .unit = "Pa/m",
                         .range = positive,
                         .doc = "Traction over opening while undamaged, K",
                         .knob = Knob::smaller_is_faster,
                         .one_of = "onset"}};
  Param<Real> onset{this,
                    {.name = "onset",
                     .unit = "m",
                     .range = positive,
                     .doc = "Opening u_e at which damage starts",
                     .one_of = "onset"}};
  Param<Real> onset_ratio{this,
                          {.name = "onset-ratio", .range = {0, 1, true, true}, .doc = "u_e / u_p", .one_of = "onset"}};
  Param<std::string> area_rule{this,
                               {.name = "area",
                                .doc = "literal: S = pi R^2 of each contact; normalised: scaled so that all contacts "
                                       "together have the area 'interface-area'",
                                .fallback = "literal",
                                .choices = {"literal", "normalised"}}};
  Param<std::string> area_radius{this,
                                 {.name = "area-radius",
                                  .doc = "R of a contact: the mean of its two radii (elements of like size), or the "
                                         "smaller one (small elements on a large one)",
                                  .fallback = "mean",
                                  .choices = {"mean", "smaller"}}};
  Param<Real> interface_area{this,
                             {.name = "interface-area",
                              .unit = "m2",
                              .range = positive,
                              .doc = "Area of the interface; needed for 'normalised', else only reported",
                              .optional = true}};
  Param<std::string> broken{
      this,
      {.name = "broken",
       .doc = "What a contact does that has failed. resists: it still resists closing, without friction; leaves: "
              "nothing more, and laws of <contact> take its pair, with their friction",
       .fallback = "resists",
       .choices = {"resists", "leaves"}}};
  Param<Formula> where{this,
                       {.name = "where",
                        .unit = "",
                        .doc = "Only contacts whose middle fulfils this condition on x, y, z: leaves out a pre-crack",
                        .optional = true,
                        .variables = {{"x", metre()}, {"y", metre()}, {"z", metre()}}}};

  Reads<Real> radius{this, field::radius};
  Keeps<Real> length{this, field::rest_length};
  Keeps<Real> area{this, {"area", On::bonds, "m2", "Area S that the contact stands for"}};
  Keeps<Vec3> arm1{this, {"arm-1", On::bonds, "m", "Contact point in the first element's body"}};
  Keeps<Vec3> arm2{this, {"arm-2", On::bonds, "m", "Contact point in the second element's body"}};
  Keeps<Vec3> normal1{this, {"normal-1", On::bonds, "1", "Normal of the contact in the first element's body"}};
  Keeps<Vec3> normal2{this, {"normal-2", On::bonds, "1", "Normal of the contact in the second element's body"}};
  Keeps<Real> largest_opening{this, {"largest-opening", On::bonds, "m", "Largest opening so far"}};
  Keeps<Real> largest_sliding{this, {"largest-sliding", On::bonds, "m", "Largest sliding so far"}};
  Keeps<Real> integrity{this, {"integrity", On::bonds, "1", "Smallest share of the stiffness so far, 1 - damage"}};
  Keeps<Real> mix{this, {"mode-mix", On::bonds, "1", "Share of sliding in the energy of the last opening"}};
  Keeps<Real> parted{
      this,
      {"parted", On::bonds, "1", "1 when the faces have slid past one another, 0.5 in the step in which they do"}};
  Keeps<Real> extra_dissipation{this,
                                {"extra-dissipation", On::bonds, "J",
                                 "Energy dissipated beyond what the largest openings tell: when the other mode fails, "
                                 "by coupled modes, when the two faces lie too far apart"}};
  Writes<Real> damage{this, field::damage};
  Writes<Real> opening{this, opening_field};
  Writes<Real> sliding{this, sliding_field};

  void check(Complaints& complaints) const override {
    if (*area_rule == "normalised" && !interface_area.given())
      complaints.error(area_rule.at(),
                       "'area' normalised needs 'interface-area', the area that all contacts together stand for");
    check_normal(complaints);
    if (coupled() && *modes != "both")
      complaints.error(coupling.at(), "'coupling' joins opening and sliding: it needs modes=\"both\"");
    if (exponent.given() != (*coupling == "benzeggagh-kenane"))
      complaints.error(exponent.given() ? exponent.at() : coupling.at(),
                       "'exponent' stands with coupling=\"benzeggagh-kenane\", and only there");
    else if (strength.given() && energy_.given() && onset.given() + onset_ratio.given() + stiffness.given() == 1)
      check_softening(complaints);
  }

  void choose() override {
    const bool slides = *modes != "normal", opens = *modes != "shear";
    BondLawOf::choose();
    for (FieldUse* use :
         {static_cast<FieldUse*>(&arm1), static_cast<FieldUse*>(&arm2), static_cast<FieldUse*>(&sliding)})
      use->want(slides || carried());
    for (FieldUse* use :
         {static_cast<FieldUse*>(&normal1), static_cast<FieldUse*>(&normal2), static_cast<FieldUse*>(&parted)})
      use->want(carried());
    length.want(!carried());
    largest_opening.want(opens && !coupled());
    largest_sliding.want(slides && !coupled());
    integrity.want(coupled());
    mix.want(coupled());
    extra_dissipation.want(*modes == "both" || carried());
  }

  bool accepts(const Domain&, Index i, Index j) const override {
    if (!where.given()) return true;
    const Vec3 middle = 0.5 * (position[i] + position[j]);
    return (*where)({middle.data(), 3}) == 1;
  }

  bool acts_when_broken() const override { return *broken == "resists"; }
  bool is_in_stress() const override { return false; }  // Eq (6) is of beams

  void connect(Domain& domain, BondTable& table) override {
    const auto id = domain.elements().column("id").view<Index>();
    Real sum = 0;
    for (Index row = 0; row < table.size(); ++row) {
      const Index i = table.first()[row];
      const Index j = table.second()[row];
      const Vec3 apart = position[j] - position[i];
      if (!(apart.norm() > 1e-12 * (radius[i] + radius[j])))
        refuse(at(), fmt::format("elements {} and {} of family '{}' stand at one place: a contact between them has no "
                                 "normal; move one of them or leave it out of the sets",
                                 id[i], id[j], *name));
      if (length) length[row] = apart.norm();
      area[row] = *area_radius == "mean" ? contact_area(radius[i], radius[j])
                                         : contact_area_on_large(std::min(radius[i], radius[j]));
      sum += area[row];
      if (integrity) integrity[row] = 1;
      if (!arm1) continue;
      const ContactArms<Real> arms = contact_arms(apart, radius[i], radius[j], orientation[i], orientation[j]);
      arm1.set(row, arms.arm1);
      arm2.set(row, arms.arm2);
    }
    literal_area_ = sum;
    if (*area_rule == "normalised")
      for (Index row = 0; row < table.size(); ++row) area[row] *= *interface_area / sum;
    if (carried()) set_normals(domain, table);
    tilt_ = carried() ? Tilt{} : tilt_of_lines(domain, table, (*between)[0]);
    for (const auto& family : domain.families()) may_meet_ |= family->is_of_contacts();
  }

  std::string remark() const override {
    const std::string all = fmt::format("contacts of area {:.6g} m2 in all (pi R^2 each)", literal_area_);
    if (!interface_area.given()) return all + about_normals_;
    return fmt::format("{}, {:.4g} of the interface; {}{}", all, literal_area_ / *interface_area,
                       *area_rule == "literal" ? "taken as it is" : "scaled to the interface", about_normals_);
  }

  std::string caution() const override {
    constexpr Real little = 10;  // degrees
    std::string all;
    if (*broken == "leaves" && !may_meet_)
      all =
          "broken=\"leaves\" leaves its pairs to laws of <contact>, and there are none: what has failed may pass "
          "through";
    if (*modes == "both" && tilt_.degrees > little)
      all += fmt::format(
          "{}its lines of centres lie {:.0f} degrees off {} (rms): measured against them, contacts lock when the "
          "interface is sheared and take more than their strength and energy; normal=\"plane\", or \"axis\" around a "
          "fibre, gives them the interface's normal",
          all.empty() ? "" : "; ", tilt_.degrees, tilt_.at_fibres ? "the fibres' radii" : "their mean");
    return all;
  }

  void end(Domain& domain, BondTable& table, Index row) override {
    BondLawOf::end(domain, table, row);
    if (parted && parted[row] > 0) parted[row] = 1;
  }

 protected:
  AnyLaw law() const override { return carried() ? law_of<true>() : law_of<false>(); }

  void note_changes(BondTable& table, std::span<const Index> flagged, std::vector<BondEvent>& events) override {
    std::visit(
        [&](const auto& value) {
          for (const Index c : flagged) {
            const Chunk& chunk = table.chunks()[static_cast<std::size_t>(c)];
            for (Index b = chunk.begin; b < chunk.live_end; ++b) {
              const One one{b, nullptr};
              State& state = table.state()[b];
              if (state != State::broken && value.has_failed(one)) {
                state = State::broken;
                events.push_back({b, value.has_slid(one) ? "slid" : "opened", value.dissipated(one)});
              } else if (value.parts(one)) {
                events.push_back({b, "", 0});
              } else if (state == State::intact && value.softens(one)) {
                state = State::softening;
              }
            }
          }
        },
        law());
  }

 private:
  static Dimension metre() { return find_unit("m")->dimension; }

  bool carried() const { return *normal != "pair"; }
  bool coupled() const { return *coupling != "none"; }

  void check_normal(Complaints& complaints) const {
    const auto belongs = [&](const ParamBase& param, const char* which) {
      if (param.given() && *normal != which)
        complaints.error(param.at(), fmt::format("'{}' is for normal=\"{}\", and this is \"{}\"", param.info().name,
                                                 which, *normal));
    };
    belongs(plane_normal, "plane");
    belongs(axis_point, "axis");
    belongs(axis_direction, "axis");
    for (const Param<Vec3>* direction : {&plane_normal, &axis_direction})
      if (direction->given() && !(direction->value().norm() > 0))
        complaints.error(direction->at(), fmt::format("'{}' must have a direction", direction->info().name));
    if (axis_point.given() != axis_direction.given())
      complaints.error((axis_point.given() ? axis_point : axis_direction).at(),
                       "'axis-point' and 'axis-direction' stand together, or neither does");
  }

  void check_softening(Complaints& complaints) const {
    const ParamBase& cause = onset.given() ? static_cast<const ParamBase&>(onset) : stiffness;
    for (const Softening<Real>& mode : {opening_law(), sliding_law()})
      if (!is_softening(mode)) {
        complaints.error(cause.at(), fmt::format("the onset u_e = {:.4g} m must be below u_p = 2 G / sigma = {:.4g} m: "
                                                 "give a larger 'stiffness' or 'energy', or a smaller 'onset'",
                                                 mode.onset, mode.open));
        return;
      }
    if (!coupled()) return;
    const MixedMode mixed = mixed_law();
    for (int k = 0; k <= 100; ++k)
      if (!is_softening(mixed.at_mix(Real(k) / 100))) {
        complaints.error(coupling.at(),
                         fmt::format("at a mode mix of {:.2f} the energy of this coupling is less than what is stored "
                                     "when damage starts: give a larger 'stiffness' or a smaller 'onset' or 'exponent'",
                                     Real(k) / 100));
        return;
      }
  }

  void set_normals(const Domain& domain, const BondTable& table) {
    std::vector<Meeting> meetings;
    const auto is_in = [&](std::size_t which) {
      std::vector<char> member(static_cast<std::size_t>(domain.size()), 0);
      for (const Index row : domain.set((*between)[which])) member[static_cast<std::size_t>(row)] = 1;
      return member;
    };
    const std::vector<char> one = is_in(0), other = is_in(1);
    for (Index row = 0; row < table.size(); ++row) {
      const Index first = table.first()[row], second = table.second()[row];
      const auto i = static_cast<std::size_t>(first), j = static_cast<std::size_t>(second);
      meetings.push_back({first, second, position[first] + rotate(orientation[first], arm1[row]),
                          position[second] - position[first], (one[i] && other[j]) - (one[j] && other[i])});
    }
    InterfaceNormals finder(std::move(meetings), normal.at());
    const std::vector<Vec3> normals =
        *normal == "plane"   ? finder.of_plane(plane_normal.given() ? std::optional<Vec3>(*plane_normal) : std::nullopt)
        : axis_point.given() ? finder.of_axis({*axis_point, axis_direction->normalized()})
                             : finder.of_fibres(domain, (*between)[0]);
    for (Index row = 0; row < table.size(); ++row) {
      const auto carried = carried_normals(normals[static_cast<std::size_t>(row)], orientation[table.first()[row]],
                                           orientation[table.second()[row]]);
      normal1.set(row, carried.normal1);
      normal2.set(row, carried.normal2);
    }
    about_normals_ = finder.remark();
  }

  template <bool carried>
  AnyLaw law_of() const {
    if (coupled()) return CohesiveFaces<carried, MixedMode>{columns(), mixed_law()};
    if (*modes == "both") return CohesiveFaces<carried, Both>{columns(), {opening_law(), sliding_law()}};
    if (*modes == "shear") return CohesiveFaces<carried, Sliding>{columns(), {opening_law(), sliding_law()}};
    if constexpr (carried) return CohesiveFaces<carried, Opening>{columns(), {opening_law(), sliding_law()}};
    return CohesiveOpening{columns(), opening_law()};
  }

  Softening<Real> mode(Real sigma, Real G) const {
    if (onset.given()) return softening_by_onset(sigma, G, *onset);
    if (onset_ratio.given()) return softening_by_ratio(sigma, G, *onset_ratio);
    return softening_by_stiffness(sigma, G, *stiffness);
  }
  Softening<Real> opening_law() const { return mode(*strength, *energy_); }
  Softening<Real> sliding_law() const {
    return mode(shear_strength.given() ? *shear_strength : *strength, shear_energy.given() ? *shear_energy : *energy_);
  }
  MixedMode mixed_law() const {
    return {opening_law(), sliding_law(), {*coupling == "linear", UnitPower(exponent.given() ? *exponent : 1)}};
  }

  CohesiveColumns columns() const {
    return {length.view(),
            area.view(),
            arm1.view(),
            arm2.view(),
            normal1.view(),
            normal2.view(),
            largest_opening.view(),
            largest_sliding.view(),
            integrity.view(),
            mix.view(),
            parted.view(),
            extra_dissipation.view(),
            damage.view(),
            opening.view(),
            sliding.view()};
  }

  Real literal_area_ = 0;
  bool may_meet_ = false;  // the deck has laws of contact
  Tilt tilt_;              // of the lines of centres, where they are the normals
  std::string about_normals_;
};

}  // namespace beadwork
