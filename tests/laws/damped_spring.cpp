#include "core/domain/vocabulary.hpp"
#include "core/mechanics/dashpot.hpp"
#include "core/mechanics/spring_stiffness.hpp"
#include "core/plugin/bond_law_of.hpp"

namespace beadwork {

struct DampedSpringLaw {
  View<const Real> length;
  Real stiffness_, viscosity;

  static constexpr bool turns = false;
  static constexpr bool moves = true;  // reads velocities: `ends` has them

  template <Pass pass, class At, class T>
  [[gnu::always_inline]] Wrench<T> act(const At& at, const MovingEnds<T>& ends) const {
    const T distance = sqrt(dot(ends.apart, ends.apart));
    const T pull = T(stiffness_) * (distance - at(length)) + T(viscosity) * parting(ends);
    return {(-pull / distance) * ends.apart, zero<Vec<T>>(), zero<Vec<T>>()};
  }

  template <class At, class T>
  T stored(const At& at, const MovingEnds<T>& ends) const {
    const T longer = sqrt(dot(ends.apart, ends.apart)) - at(length);
    return T(0.5 * stiffness_) * longer * longer;
  }

  // What the damping takes [W]: the core books it.
  template <class At, class T>
  T power(const At&, const MovingEnds<T>& ends) const {
    return T(viscosity) * parting(ends) * parting(ends);
  }

  Matrix12 stiffness(const One& at, const MovingEnds<Real>& ends, Slope slope) const {
    return spring_stiffness({at(length), stiffness_}, ends.apart, slope);
  }
  // For the time step: how the force opposes velocities, at its largest.
  Matrix12 damping(const One&, const MovingEnds<Real>& ends) const {
    return dashpot_matrix({.along = viscosity}, ends.apart);
  }

  // Rate of the length.
  template <class T>
  [[gnu::always_inline]] static T parting(const MovingEnds<T>& ends) {
    return dot(ends.apart, ends.v2 - ends.v1) / sqrt(dot(ends.apart, ends.apart));
  }
};

/// Spring and dashpot side by side.
class DampedSpring final : public BondLawOf<DampedSpringLaw> {
 public:
  static constexpr const char* about = "Spring and dashpot side by side";
  Param<Real> stiffness{this,
                        {.name = "stiffness", .unit = "N/m", .range = not_negative, .doc = "Force over elongation"}};
  Param<Real> viscosity{
      this, {.name = "viscosity", .unit = "N.s/m", .range = positive, .doc = "Force over rate of elongation"}};

  Keeps<Real> length{this, field::rest_length};

  void connect(Domain&, BondTable& table) override {
    for (Index row = 0; row < table.size(); ++row) length[row] = apart(table, row).norm();
  }

 protected:
  AnyLaw law() const override { return DampedSpringLaw{length.view(), *stiffness, *viscosity}; }

 private:
  Vec3 apart(const BondTable& table, Index row) const {
    return position[table.second()[row]] - position[table.first()[row]];
  }
};

}  // namespace beadwork
