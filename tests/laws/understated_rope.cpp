#include "core/domain/vocabulary.hpp"
#include "core/mechanics/spring_stiffness.hpp"
#include "core/plugin/bond_law_of.hpp"

namespace beadwork {

struct UnderstatedRopeLaw {
  View<const Real> length;
  Real stiff, stated;  // stated: the share of the stiffness that it owns up to
  static constexpr bool turns = false;

  template <Pass pass, class At, class T>
  [[gnu::always_inline]] Wrench<T> act(const At& at, const Ends<T>& ends) const {
    const T distance = sqrt(dot(ends.apart, ends.apart));
    return {(-T(stiff) * max(T(0), distance - at(length)) / distance) * ends.apart, zero<Vec<T>>(), zero<Vec<T>>()};
  }
  template <class At, class T>
  T stored(const At& at, const Ends<T>& ends) const {
    const T longer = max(T(0), sqrt(dot(ends.apart, ends.apart)) - at(length));
    return T(0.5 * stiff) * longer * longer;
  }
  Matrix12 stiffness(const One& at, const Ends<Real>& ends, Slope slope) const {
    return spring_stiffness({at(length), stated * stiff}, ends.apart, slope);
  }
};

/// A mistake: a rope that states a share of its stiffness only. As it goes slack, what it gains by that stays small for
/// long.
class UnderstatedRope final : public BondLawOf<UnderstatedRopeLaw> {
 public:
  static constexpr const char* about = "Rope that states a share of its stiffness only";
  Param<Real> stiffness{this, {.name = "stiffness", .unit = "N/m", .range = positive, .doc = "Force over elongation"}};
  Param<Real> stated{this, {.name = "stated", .range = positive, .doc = "Share of it that the tangent states"}};

  Keeps<Real> length{this, field::rest_length};

  void connect(Domain&, BondTable& table) override {
    for (Index row = 0; row < table.size(); ++row)
      length[row] = (position[table.second()[row]] - position[table.first()[row]]).norm();
  }

 protected:
  AnyLaw law() const override { return UnderstatedRopeLaw{length.view(), *stiffness, *stated}; }
};

}  // namespace beadwork
