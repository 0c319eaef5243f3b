// What a bond law may read, and what it has to say: mistakes are errors of the compiler.
#include <type_traits>

#include "core/plugin/bond_law_of.hpp"

namespace beadwork {
namespace {

template <class E>
concept HasVelocities = requires(E ends) {
  ends.v1, ends.v2;
};
template <class E>
concept HasSpins = requires(E ends) {
  ends.w1, ends.w2;
};
template <class E>
concept HasOrientations = requires(E ends) {
  ends.q1, ends.q2;
};

struct Still {
  static constexpr bool turns = false;
};
struct Turning {
  static constexpr bool turns = true;
};
struct Moving {
  static constexpr bool turns = false, moves = true;
};
struct TurningMoving {
  static constexpr bool turns = true, moves = true;
};

template <class Law>
constexpr int seen_by =
    HasOrientations<EndsOf<Law, Real>> * 100 + HasVelocities<EndsOf<Law, Real>> * 10 + HasSpins<EndsOf<Law, Real>>;

static_assert(seen_by<Still> == 0);
static_assert(seen_by<Turning> == 100);
static_assert(seen_by<Moving> == 10);
static_assert(seen_by<TurningMoving> == 111);

/// Reads velocities, and does not say so: nobody would have written them.
struct Forgetful {
  static constexpr bool turns = false;
  template <Pass, class At, class T>
  Wrench<T> act(const At&, const MovingEnds<T>& ends) const {
    return {ends.v2 - ends.v1, zero<Vec<T>>(), zero<Vec<T>>()};
  }
};
struct Honest : Forgetful {
  static constexpr bool moves = true;
  template <class At, class T>
  T power(const At&, const MovingEnds<T>&) const {
    return 0;
  }
  template <class At, class T>
  T stored(const At&, const Ends<T>&) const {
    return 0;
  }
};

template <class Law>
concept Acts = requires(Law law, EndsOf<Law, Real> ends) {
  law.template act<Pass{}>(One{}, ends);
};
static_assert(Acts<Honest>);
static_assert(!Acts<Forgetful>);

struct Thorough : Honest {
  Matrix12 damping(const One&, const MovingEnds<Real>&) const { return Matrix12::Zero(); }
};
static_assert(!SaysHowItDamps<Honest>);
static_assert(SaysHowItDamps<Thorough>);
static_assert(SaysHowItDamps<Still>);

}  // namespace
}  // namespace beadwork
