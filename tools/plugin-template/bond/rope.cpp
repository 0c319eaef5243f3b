#include "core/domain/vocabulary.hpp"
#include "core/mechanics/spring_stiffness.hpp"
#include "core/plugin/bond_law_of.hpp"

namespace beadwork::ropes {

/// The law: a small value with the columns and numbers of the ropes, and what is done with one of them. T is the number
/// type, Real, a pack of as many as the processor takes at once, or a number with its slopes: nothing may branch on it.
struct RopeLaw {
  View<const Real> length;
  View<Real> stretch;  // null where nobody reads it
  Real stiff;

  static constexpr bool turns = false;  // reads no orientations and gives no torques

  template <Pass pass, class At, class T>
  [[gnu::always_inline]] Wrench<T> act(const At& at, const Ends<T>& ends) const {
    const T distance = sqrt(dot(ends.apart, ends.apart));
    const T longer = distance - at(length);
    const T pull = max(T(0), T(stiff) * longer);
    if constexpr (pass.sections)
      if (stretch) at.store(stretch, longer / at(length));
    return {(-pull / distance) * ends.apart, zero<Vec<T>>(), zero<Vec<T>>()};  // on the second element
  }

  template <class At, class T>
  T stored(const At& at, const Ends<T>& ends) const {
    const T longer = max(T(0), sqrt(dot(ends.apart, ends.apart)) - at(length));
    return T(0.5 * stiff) * longer * longer;
  }

  // For the time step, the stiffest that the bond can become, and for static movers one that is never negative. The
  // derivative of `act` is found from `act` itself.
  Matrix12 stiffness(const One& at, const Ends<Real>& ends, Slope slope) const {
    return spring_stiffness({at(length), stiff}, ends.apart, slope);
  }
};

/// Rope: pulls when it is longer than at rest, and is slack when it is shorter.
class Rope final : public BondLawOf<RopeLaw> {
 public:
  static constexpr const char* about = "Ropes between neighbouring elements: they pull, and never push";

  // What the deck gives: name, unit, range and one line of help. `name`, `between` and `gap` come with every bond law.
  Param<Real> stiffness{this, {.name = "stiffness", .unit = "N/m", .range = positive, .doc = "Force over elongation"}};

  // What it touches besides places and forces, which every bond law does. Nothing else exists for it, and nothing is
  // allocated that no plugin names.
  Keeps<Real> length{this, field::rest_length};
  Writes<Real> stretch{this, {"stretch", On::bonds, "1", "Elongation over the length at rest, negative when slack"}};

  // Once, when the bonds have been made: their state at rest.
  void connect(Domain&, BondTable& table) override {
    for (Index row = 0; row < table.size(); ++row)
      length[row] = (position[table.second()[row]] - position[table.first()[row]]).norm();
  }

 protected:
  AnyLaw law() const override { return RopeLaw{length.view(), stretch.view(), *stiffness}; }
};

}  // namespace beadwork::ropes
