// The laws are written once over a number type. Here it is a pack of two lanes: each lane must get the bits
// that the scalar law gives, whichever side of a threshold the other lane is on.
#include "core/mechanics/lane.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <tuple>

#include "core/base/random.hpp"
#include "core/mechanics/beam.hpp"
#include "core/mechanics/cohesive_modes.hpp"
#include "core/mechanics/spring.hpp"
#include "core/mechanics/verlet.hpp"

namespace lanes {

struct Mask {
  bool a, b;
  friend Mask operator&&(Mask x, Mask y) { return {x.a && y.a, x.b && y.b}; }
  friend Mask operator||(Mask x, Mask y) { return {x.a || y.a, x.b || y.b}; }
};
struct Two {
  double a, b;
  Two() = default;
  Two(double both) : a(both), b(both) {}
  Two(double first, double second) : a(first), b(second) {}
  friend Two operator+(Two x, Two y) { return {x.a + y.a, x.b + y.b}; }
  friend Two operator-(Two x, Two y) { return {x.a - y.a, x.b - y.b}; }
  friend Two operator*(Two x, Two y) { return {x.a * y.a, x.b * y.b}; }
  friend Two operator/(Two x, Two y) { return {x.a / y.a, x.b / y.b}; }
  friend Two operator-(Two x) { return {-x.a, -x.b}; }
  friend Mask operator<(Two x, Two y) { return {x.a < y.a, x.b < y.b}; }
  friend Mask operator>(Two x, Two y) { return {x.a > y.a, x.b > y.b}; }
  friend Mask operator<=(Two x, Two y) { return {x.a <= y.a, x.b <= y.b}; }
  friend Mask operator>=(Two x, Two y) { return {x.a >= y.a, x.b >= y.b}; }
};
Two sqrt(Two x) { return {std::sqrt(x.a), std::sqrt(x.b)}; }
Two min(Two x, Two y) { return {beadwork::min(x.a, y.a), beadwork::min(x.b, y.b)}; }
Two max(Two x, Two y) { return {beadwork::max(x.a, y.a), beadwork::max(x.b, y.b)}; }
Two select(Mask m, Two x, Two y) { return {m.a ? x.a : y.a, m.b ? x.b : y.b}; }

/// A number that counts what is done with it.
struct Counted {
  double value;
  Counted() = default;
  Counted(double v) : value(v) {}
  static inline int plain = 0, divisions = 0, roots = 0;
  static Counted one(double v) { return ++plain, Counted(v); }
  friend Counted operator+(Counted x, Counted y) { return one(x.value + y.value); }
  friend Counted operator-(Counted x, Counted y) { return one(x.value - y.value); }
  friend Counted operator*(Counted x, Counted y) { return one(x.value * y.value); }
  friend Counted operator/(Counted x, Counted y) { return ++divisions, Counted(x.value / y.value); }
  friend Counted operator-(Counted x) { return Counted(-x.value); }
  friend Counted sqrt(Counted x) { return ++roots, Counted(std::sqrt(x.value)); }
};

}  // namespace lanes

namespace Eigen {
template <>
struct NumTraits<lanes::Two> : GenericNumTraits<double> {
  using Real = lanes::Two;
  using NonInteger = lanes::Two;
  using Nested = lanes::Two;
};
template <>
struct NumTraits<lanes::Counted> : GenericNumTraits<double> {
  using Real = lanes::Counted;
  using NonInteger = lanes::Counted;
  using Nested = lanes::Counted;
};
}  // namespace Eigen

namespace beadwork {
namespace {

using lanes::Two;

Vec<Two> both(const Vec3& a, const Vec3& b) { return {Two(a[0], b[0]), Two(a[1], b[1]), Two(a[2], b[2])}; }
Quaternion<Two> both(const Quat& a, const Quat& b) { return {Two(a.w, b.w), both(a.v, b.v)}; }

void expect_lanes(const Vec<Two>& pack, const Vec3& a, const Vec3& b) {
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(pack[c].a, a[c]);
    EXPECT_EQ(pack[c].b, b[c]);
  }
}
void expect_lanes(const Wrench<Two>& pack, const Wrench<Real>& a, const Wrench<Real>& b) {
  expect_lanes(pack.force, a.force, b.force);
  expect_lanes(pack.torque1, a.torque1, b.torque1);
  expect_lanes(pack.torque2, a.torque2, b.torque2);
}

struct State {
  Vec3 d;
  Quat q1, q2;
};
State random_state(Random& random) {
  const auto vector = [&](Real size) {
    const Real x = random.normal(), y = random.normal(), z = random.normal();
    return Vec3(x * size, y * size, z * size);
  };
  return {Vec3(1, 0.5, -0.2) + vector(0.3), exp_map(vector(0.3)), exp_map(vector(0.3))};
}

TEST(lane, a_beam_in_a_pack_has_the_bits_of_a_beam_alone) {
  Random random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const State a = random_state(random), b = random_state(random);
    const auto r = round_beam(Vec3(1, 0.5, -0.2), 3, 0.3, 0.4), s = round_beam(Vec3(0.8, 0.1, 0.4), 5, 0.2, 0.2);
    const BeamRest<Two> rest{
        both(r.axis, s.axis), {r.length, s.length}, {r.axial, s.axial}, {r.bending, s.bending}, {r.torsion, s.torsion}};
    expect_lanes(beam_wrench<Two>(rest, both(a.d, b.d), both(a.q1, b.q1), both(a.q2, b.q2)),
                 beam_wrench(r, a.d, a.q1, a.q2), beam_wrench(s, b.d, b.q1, b.q2));
    const auto pack =
        beam_stress<Two>(beam_section<Two>(rest, both(a.d, b.d), both(a.q1, b.q1), both(a.q2, b.q2)), 0.3);
    EXPECT_EQ(pack.principal.a, beam_stress<Real>(beam_section(r, a.d, a.q1, a.q2), 0.3).principal);
    EXPECT_EQ(pack.principal.b, beam_stress<Real>(beam_section(s, b.d, b.q1, b.q2), 0.3).principal);
  }
}

template <bool carried, class T>
auto faces_of(const ContactArms<T>& arms, const Vec<T>& d, const Quaternion<T>& q1, const Quaternion<T>& q2) {
  if constexpr (carried)
    return carried_faces<T>(arms, {T(1.76) * arms.arm1, T(-1.76) * arms.arm2}, d, q1, q2);
  else
    return pair_faces<T>(1.1, arms, d, q1, q2);
}

template <bool carried, class T, class Modes>
auto contact_of(const Modes& modes, const ContactArms<T>& arms, const Vec<T>& d, const Quaternion<T>& q1,
                const Quaternion<T>& q2, const CohesiveHistory<Modes, T>& history) {
  const auto at = faces_of<carried, T>(arms, d, q1, q2);
  const auto now = cohesive_state<Modes>(modes, at, T(2), history);
  return std::tuple(cohesive_wrench(modes, at, T(2), now.share), now.after,
                    cohesive_lost<Modes>(modes, at, T(2), history, now.after));
}

template <bool carried, class Modes>
void a_contact_has_the_bits_of_one_alone(const Modes& modes, int seed) {
  Random random(static_cast<std::uint64_t>(seed));
  const auto arms = contact_arms(Vec3(1, 0.5, -0.2), 1, 1, identity(), identity());
  const ContactArms<Two> both_arms{both(arms.arm1, arms.arm1), both(arms.arm2, arms.arm2)};
  int failed = 0, held = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const State a = random_state(random), b = random_state(random);
    CohesiveHistory<Modes, Real> ka{{random.uniform(0, 0.5), random.uniform(0, 0.5)}, Real(trial % 7 == 0)},
        kb{{random.uniform(0, 0.1), 0}, 0};
    const auto [one, one_after, one_lost] = contact_of<carried, Real>(modes, arms, a.d, a.q1, a.q2, ka);
    const auto [other, other_after, other_lost] = contact_of<carried, Real>(modes, arms, b.d, b.q1, b.q2, kb);
    const auto history = std::bit_cast<std::array<Real, 3>>(ka), second = std::bit_cast<std::array<Real, 3>>(kb);
    const std::array<Two, 3> lanes{Two(history[0], second[0]), Two(history[1], second[1]), Two(history[2], second[2])};
    const auto [pack, after, lost] =
        contact_of<carried, Two>(modes, both_arms, both(a.d, b.d), both(a.q1, b.q1), both(a.q2, b.q2),
                                 std::bit_cast<CohesiveHistory<Modes, Two>>(lanes));
    expect_lanes(pack, one, other);
    EXPECT_EQ(lost.a, one_lost);
    EXPECT_EQ(lost.b, other_lost);
    const auto packed = std::bit_cast<std::array<Two, 3>>(after);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(packed[k].a, (std::bit_cast<std::array<Real, 3>>(one_after)[k]));
      EXPECT_EQ(packed[k].b, (std::bit_cast<std::array<Real, 3>>(other_after)[k]));
    }
    failed += modes.failed(one_after.modes);
    held += one.force.norm() > 0;
  }
  EXPECT_GT(failed, 20);
  EXPECT_LT(failed, 180);
  EXPECT_GT(held, 50);
}

TEST(lane, a_contact_in_a_pack_has_the_bits_of_a_contact_alone_on_either_side_of_every_threshold) {
  const Softening<Real> opens{60, 0.05, 0.4}, slides{40, 0.06, 0.5};
  const IndependentModes<CohesiveModes::both> independent{opens, slides};
  a_contact_has_the_bits_of_one_alone<false>(independent, 2);
  a_contact_has_the_bits_of_one_alone<true>(independent, 3);
  for (const Coupling& coupling : {Coupling{true, UnitPower(1)}, Coupling{false, UnitPower(2.284)}}) {
    a_contact_has_the_bits_of_one_alone<false>(MixedMode{opens, slides, coupling}, 4);
    a_contact_has_the_bits_of_one_alone<true>(MixedMode{opens, slides, coupling}, 5);
  }
}

TEST(lane, springs_and_steps_do_too) {
  const Vec3 a(1, 2, 3), b(-1, 0.5, 0.1);
  expect_lanes(spring_force<Two>({1., Two(2, 3)}, both(a, b)), spring_force<Real>({1, 2}, a),
               spring_force<Real>({1, 3}, b));
  const Quat qa = exp_map(a), qb = exp_map(b);
  const auto pack = turn<Two>(both(qa, qb), both(a, b), both(b, a), 0.1);
  EXPECT_EQ(pack.w.a, (turn<Real>(qa, a, b, 0.1).w));
  EXPECT_EQ(pack.w.b, (turn<Real>(qb, b, a, 0.1).w));
}

// What docs/performance.md says of a bond. Recorded 2026-11: counted, not derived.
TEST(lane, a_beam_takes_some_two_hundred_operations_one_division_and_one_root) {
  using lanes::Counted;
  const auto count = [](const auto& f) {
    Counted::plain = Counted::divisions = Counted::roots = 0;
    f();
    return std::array{Counted::plain, Counted::divisions, Counted::roots};
  };
  const Vec<Counted> axis(1., 0., 0.), apart(1.01, 0.02, 0.03);
  const Quaternion<Counted> turn{1., Vec<Counted>(0.01, 0.02, 0.03)};
  EXPECT_EQ(count([&] {
              beam_wrench<Counted>(BeamRest<Counted>{axis, 1., 1., 1., 1.}, apart, turn, turn);
            }),
            (std::array{190, 1, 1}));
  EXPECT_EQ(count([&] { spring_force<Counted>({1., 1.}, apart); }), (std::array{10, 1, 1}));
}

TEST(lane, select_takes_the_first_where_the_mask_holds) {
  EXPECT_EQ(select(true, 1., 2.), 1);
  EXPECT_EQ(select(false, 1.f, 2.f), 2);
  EXPECT_EQ(max(1., 2.), 2);
  EXPECT_EQ(min(1.f, 2.f), 1);
}

TEST(lane, vectors_take_whole_numbers_as_factors) {
  const Vec3 v = 2 * Vec3(1, 2, 3) * 3;
  EXPECT_EQ(v, Vec3(6, 12, 18));
}

}  // namespace
}  // namespace beadwork
