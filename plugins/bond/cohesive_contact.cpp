#include <fmt/format.h>

#include "core/base/failure.hpp"
#include "core/base/units.hpp"
#include "core/domain/vocabulary.hpp"
#include "core/mechanics/cohesive_stiffness.hpp"
#include "core/plugin/bond_loop.hpp"

namespace beadwork {

namespace {

const OwnField opening_field{"opening", On::bonds, "m", "Distance of the centres over that at rest, positive when pulled apart"};
const OwnField sliding_field{"sliding", On::bonds, "m", "Sliding of the two faces against each other"};

}  // namespace

/// What the three cohesive laws share: rest state, history, and what is told of a bond.
struct CohesiveColumns {
  View<const Real> length, area;
  View<const Vec3> arm1, arm2;
  View<Real> largest_opening, largest_sliding;  // null where the mode is not asked for
  View<Real> let_go;                            // energy that failure in the other mode took; both modes only
  View<Real> damage, opening, sliding;          // null where nobody reads them
  CohesiveLaws<Real> laws;

  template <class At>
  [[gnu::always_inline]] auto rest(const At& at) const {
    return CohesiveRest<typename At::Number>{at(length), at(area)};
  }
};

/// Opening alone: a central force.   Eqs (3)-(5)
struct CohesiveOpening : CohesiveColumns {
  static constexpr bool turns = false;

  template <Pass pass, class At, class T>
  [[gnu::always_inline]] Wrench<T> act(const At& at, const Ends<T>& ends) const {
    const T history = at(largest_opening);
    const CohesivePull<T> pull = cohesive_pull<T>(as<T>(laws.normal), rest(at), ends.apart, history);
    if constexpr (pass.settle) {
      at.store(largest_opening, pull.history);
      at.flag(newly(history, pull.history, laws.normal.onset) || newly(history, pull.history, laws.normal.open));
    }
    if constexpr (pass.sections) {
      if (damage) at.store(damage, beadwork::damage<T>(as<T>(laws.normal), pull.history));
      if (opening) at.store(opening, normal_opening<T>(rest(at), ends.apart));
    }
    return {pull.force, zero<Vec<T>>(), zero<Vec<T>>()};
  }

  template <class At, class T>
  T stored(const At& at, const Ends<T>& ends) const {
    const auto r = rest(at);
    return r.area * stored_per_area<T>(as<T>(laws.normal), normal_opening<T>(r, ends.apart), at(largest_opening));
  }

  template <class At>
  auto dissipated(const At& at) const {
    return at(area) * dissipated_per_area<Real>(laws.normal, at(largest_opening));
  }

  template <class T>
  static auto newly(const T& before, const T& after, Real mark) {
    return before < T(mark) && after >= T(mark);
  }
};

/// Sliding alone, or both modes; failure in either removes both.
template <CohesiveModes modes>
struct CohesiveSliding : CohesiveColumns {
  static constexpr bool turns = true;

  template <class At>
  auto arms(const At& at) const {
    return ContactArms<typename At::Number>{at(arm1), at(arm2)};
  }
  template <class At>
  auto history(const At& at) const {
    using T = typename At::Number;
    if constexpr (modes == CohesiveModes::both)
      return Openings<T>{at(largest_opening), at(largest_sliding)};
    else
      return Openings<T>{T(0), at(largest_sliding)};
  }

  template <Pass pass, class At, class T>
  [[gnu::always_inline]] Wrench<T> act(const At& at, const TurningEnds<T>& ends) const {
    const Openings<T> before = history(at);
    const auto now = cohesive_wrench<modes, T>(as<T>(laws), rest(at), arms(at), ends.apart, ends.q1, ends.q2, before);
    if constexpr (pass.settle) {
      at.store(largest_sliding, now.history.shear);
      if constexpr (modes == CohesiveModes::both) {
        const auto state = contact_state<T>(rest(at), arms(at), ends.apart, ends.q1, ends.q2);
        at.store(let_go, at(let_go) + cohesive_released<modes, T>(as<T>(laws), rest(at), state.opening, before));
        at.store(largest_opening, now.history.normal);
      }
      const auto slid = CohesiveOpening::newly(before.shear, now.history.shear, laws.shear.onset) ||
                        CohesiveOpening::newly(before.shear, now.history.shear, laws.shear.open);
      if constexpr (modes == CohesiveModes::both)
        at.flag(slid || CohesiveOpening::newly(before.normal, now.history.normal, laws.normal.onset) ||
                CohesiveOpening::newly(before.normal, now.history.normal, laws.normal.open));
      else
        at.flag(slid);
    }
    if constexpr (pass.sections) tell(at, ends, now.history);
    return now.wrench;
  }

  template <class At, class T>
  void tell(const At& at, const TurningEnds<T>& ends, const Openings<T>& next) const {
    const auto state = contact_state<T>(rest(at), arms(at), ends.apart, ends.q1, ends.q2);
    if (opening) at.store(opening, state.opening.normal);
    if (sliding) at.store(sliding, state.opening.shear);
    if (!damage) return;
    const T shear = beadwork::damage<T>(as<T>(laws.shear), next.shear);
    if constexpr (modes == CohesiveModes::both)
      at.store(damage, max(shear, beadwork::damage<T>(as<T>(laws.normal), next.normal)));
    else
      at.store(damage, shear);
  }

  template <class At, class T>
  T stored(const At& at, const TurningEnds<T>& ends) const {
    const auto state = contact_state<T>(rest(at), arms(at), ends.apart, ends.q1, ends.q2);
    return cohesive_stored<modes, T>(as<T>(laws), rest(at), state.opening, history(at));
  }

  template <class At>
  auto dissipated(const At& at) const {
    const Real softened = cohesive_dissipated<modes, Real>(laws, rest(at), history(at));
    if constexpr (modes == CohesiveModes::both)
      return softened + at(let_go);
    else
      return softened;
  }
};

/// Cohesive contact (CCM): linear up to the strength, then linear softening to zero.   Eqs (3)-(5)
/// docs/theory/cohesive-contact.md
class CohesiveContact final
    : public BondLawOf<CohesiveOpening, CohesiveSliding<CohesiveModes::shear>, CohesiveSliding<CohesiveModes::both>> {
 public:
  static constexpr const char* about = "Cohesive contact (CCM): elastic up to the strength, then softening in a straight line to zero";
  Param<std::string> modes{this, {.name = "modes", .doc = "Which displacements the contact resists", .fallback = "normal", .choices = {"normal", "shear", "both"}}};
  Param<Real> strength{this, {.name = "strength", .unit = "Pa", .range = positive, .doc = "Traction sigma at which damage starts"}};
  Param<Real> energy_{this, {.name = "energy", .unit = "J/m2", .range = positive, .doc = "Fracture energy G of the contact's area, Eq (5): u_p = 2 G / sigma"}};
  Param<Real> shear_strength{this, {.name = "shear-strength", .unit = "Pa", .range = positive, .doc = "Strength against sliding; as 'strength' where absent", .optional = true}};
  Param<Real> shear_energy{this, {.name = "shear-energy", .unit = "J/m2", .range = positive, .doc = "Fracture energy of sliding; as 'energy' where absent", .optional = true}};
  Param<Real> stiffness{this, {.name = "stiffness", .unit = "Pa/m", .range = positive, .doc = "Traction over opening while sound, K; exactly one of stiffness, onset, onset-ratio", .optional = true}};
  Param<Real> onset{this, {.name = "onset", .unit = "m", .range = positive, .doc = "Opening u_e at which damage starts", .optional = true}};
  Param<Real> onset_ratio{this, {.name = "onset-ratio", .range = {0, 1, true, true}, .doc = "u_e / u_p", .optional = true}};
  Param<std::string> area_rule{this, {.name = "area", .doc = "literal: S = pi R^2 of each contact; normalised: scaled so that all contacts together have the area 'interface-area'", .fallback = "literal", .choices = {"literal", "normalised"}}};
  Param<std::string> area_radius{this, {.name = "area-radius", .doc = "R of a contact: the mean of its two radii (elements of like size), or the smaller one (small elements on a large one)", .fallback = "mean", .choices = {"mean", "smaller"}}};
  Param<Real> interface_area{this, {.name = "interface-area", .unit = "m2", .range = positive, .doc = "Area of the interface; needed for 'normalised', else only reported", .optional = true}};
  Param<Formula> where{this,
                       {.name = "where",
                        .unit = "",
                        .doc = "Only contacts whose middle fulfils this condition on x, y, z: leaves out a pre-crack",
                        .optional = true,
                        .variables = {{"x", metre()}, {"y", metre()}, {"z", metre()}}}};

  Reads<Vec3> position{this, field::position};
  Reads<Quat> orientation{this, field::orientation};
  Reads<Real> radius{this, field::radius};
  Adds<Vec3> force{this, field::force};
  Adds<Vec3> torque{this, field::torque};
  Keeps<Real> length{this, field::rest_length};
  Keeps<Real> area{this, {"area", On::bonds, "m2", "Area S that the contact stands for"}};
  Keeps<Vec3> arm1{this, {"arm-1", On::bonds, "m", "Contact point in the first element's body"}};
  Keeps<Vec3> arm2{this, {"arm-2", On::bonds, "m", "Contact point in the second element's body"}};
  Keeps<Real> largest_opening{this, {"largest-opening", On::bonds, "m", "Largest opening so far"}};
  Keeps<Real> largest_sliding{this, {"largest-sliding", On::bonds, "m", "Largest sliding so far"}};
  Keeps<Real> let_go{this, {"let-go", On::bonds, "J", "Recoverable energy that was lost when the other mode failed"}};
  Writes<Real> damage{this, field::damage};
  Writes<Real> opening{this, opening_field};
  Writes<Real> sliding{this, sliding_field};

  void check(Complaints& complaints) const override {
    exactly_one({&stiffness, &onset, &onset_ratio}, at(), complaints);
    if (*area_rule == "normalised" && !interface_area.given())
      complaints.error(area_rule.at(), "'area' normalised needs 'interface-area', the area that all contacts together stand for");
    if (!strength.given() || !energy_.given()) return;
    const CohesiveLaws<Real> all = laws();
    for (const Softening<Real>& mode : {all.normal, all.shear})
      if (!is_softening(mode)) {
        const ParamBase& cause = onset.given() ? static_cast<const ParamBase&>(onset) : stiffness;
        complaints.error(cause.at(), fmt::format("the onset u_e = {:.4g} m must be below u_p = 2 G / sigma = {:.4g} m: give a larger "
                                                 "'stiffness' or 'energy', or a smaller 'onset'",
                                                 mode.onset, mode.open));
        return;
      }
  }

  void choose() override {
    const bool slides = *modes != "normal";
    for (FieldUse* use : {static_cast<FieldUse*>(&orientation), static_cast<FieldUse*>(&torque), static_cast<FieldUse*>(&arm1),
                          static_cast<FieldUse*>(&arm2), static_cast<FieldUse*>(&largest_sliding), static_cast<FieldUse*>(&sliding)})
      use->want(slides);
    largest_opening.want(*modes != "shear");
    let_go.want(*modes == "both");
  }

  bool accepts(const Domain&, Index i, Index j) const override {
    if (!where.given()) return true;
    const Vec3 middle = 0.5 * (position[i] + position[j]);
    return (*where)({middle.data(), 3}) == 1;
  }

  bool acts_when_broken() const override { return true; }

  void connect(Domain&, BondTable& table) override {
    Real sum = 0;
    for (Index row = 0; row < table.size(); ++row) {
      const Index i = table.first()[row];
      const Index j = table.second()[row];
      const Vec3 apart = position[j] - position[i];
      if (!(apart.norm() > 1e-12 * (radius[i] + radius[j])))
        refuse(at(), fmt::format("elements {} and {} of family '{}' stand at one place: a contact between them has no normal; move one "
                                 "of them or leave it out of the sets",
                                 i, j, *name));
      length[row] = apart.norm();
      area[row] = *area_radius == "mean" ? contact_area(radius[i], radius[j]) : contact_area_on_large(std::min(radius[i], radius[j]));
      sum += area[row];
      if (!arm1) continue;
      const ContactArms<Real> arms = contact_arms(apart, radius[i], radius[j], orientation[i], orientation[j]);
      arm1.set(row, arms.arm1);
      arm2.set(row, arms.arm2);
    }
    literal_area_ = sum;
    if (*area_rule == "normalised")
      for (Index row = 0; row < table.size(); ++row) area[row] *= *interface_area / sum;
  }

  std::string remark() const override {
    if (!interface_area.given()) return fmt::format("contacts of area {:.6g} m2 in all (pi R^2 each)", literal_area_);
    return fmt::format("contacts of area {:.6g} m2 in all (pi R^2 each), {:.4g} of the interface; {}", literal_area_,
                       literal_area_ / *interface_area, *area_rule == "literal" ? "taken as it is" : "scaled to the interface");
  }

  Matrix12 tangent(const Domain&, const BondTable& table, Index row) const override {
    const One one{row, nullptr};
    const CohesiveColumns all = columns();
    const Index i = table.first()[row];
    const Index j = table.second()[row];
    const Vec3 apart = position[j] - position[i];
    if (*modes == "normal") return cohesive_stiffness(all.laws.normal, all.rest(one), apart, 0, CohesiveSlope::sound);
    const ContactArms<Real> arms{arm1[row], arm2[row]};
    const Openings<Real> none{0, 0};
    if (*modes == "shear")
      return cohesive_stiffness<CohesiveModes::shear>(all.laws, all.rest(one), arms, apart, orientation[i], orientation[j], none, CohesiveSlope::sound);
    return cohesive_stiffness<CohesiveModes::both>(all.laws, all.rest(one), arms, apart, orientation[i], orientation[j], none, CohesiveSlope::sound);
  }

 protected:
  AnyLaw law() const override {
    if (*modes == "normal") return CohesiveOpening{columns()};
    if (*modes == "shear") return CohesiveSliding<CohesiveModes::shear>{columns()};
    return CohesiveSliding<CohesiveModes::both>{columns()};
  }

  void note_changes(BondTable& table, std::span<const Index> flagged, std::vector<BondEvent>& events) override {
    const CohesiveLaws<Real> all = laws();
    for (const Index c : flagged) {
      const Chunk& chunk = table.chunks()[static_cast<std::size_t>(c)];
      for (Index b = chunk.begin; b < chunk.live_end; ++b) {
        const bool opened = largest_opening && largest_opening[b] >= all.normal.open;
        const bool slid = largest_sliding && largest_sliding[b] >= all.shear.open;
        const bool softens = (largest_opening && largest_opening[b] > all.normal.onset) || (largest_sliding && largest_sliding[b] > all.shear.onset);
        State& state = table.state()[b];
        if ((opened || slid) && state != State::broken) {
          state = State::broken;
          events.push_back({b, opened ? "opened" : "slid", dissipated_by(b)});
        } else if (softens && state == State::intact) {
          state = State::softening;
        }
      }
    }
  }

 private:
  static Dimension metre() { return find_unit("m")->dimension; }

  Real dissipated_by(Index row) const {
    return std::visit([&](const auto& value) -> Real { return value.dissipated(One{row, nullptr}); }, law());
  }

  CohesiveLaws<Real> laws() const {
    const auto mode = [&](Real sigma, Real G) {
      if (onset.given()) return softening_by_onset(sigma, G, *onset);
      if (onset_ratio.given()) return softening_by_ratio(sigma, G, *onset_ratio);
      return softening_by_stiffness(sigma, G, *stiffness);
    };
    return {mode(*strength, *energy_), mode(shear_strength.given() ? *shear_strength : *strength, shear_energy.given() ? *shear_energy : *energy_)};
  }

  CohesiveColumns columns() const {
    return {length.view(), area.view(), arm1.view(), arm2.view(), largest_opening.view(), largest_sliding.view(), let_go.view(),
            damage.view(), opening.view(), sliding.view(), laws()};
  }

  Real literal_area_ = 0;
};

}  // namespace beadwork
