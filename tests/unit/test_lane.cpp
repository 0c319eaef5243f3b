// The laws are written once over a number type. Here it is a pack of two lanes: each lane must get the bits
// that the scalar law gives, whichever side of a threshold the other lane is on.
#include "core/mechanics/lane.hpp"

#include <gtest/gtest.h>

#include <array>

#include "core/base/random.hpp"
#include "core/mechanics/beam.hpp"
#include "core/mechanics/cohesive.hpp"
#include "core/mechanics/spring.hpp"
#include "core/mechanics/verlet.hpp"

namespace lanes {

struct Mask {
  bool a, b;
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
    const auto r = round_beam(Vec3(1, 0.5, -0.2), 3, 0.3, 0.4),
               s = round_beam(Vec3(0.8, 0.1, 0.4), 5, 0.2, 0.2);
    const BeamRest<Two> rest{both(r.axis, s.axis),
                             {r.length, s.length},
                             {r.axial, s.axial},
                             {r.bending, s.bending},
                             {r.torsion, s.torsion}};
    expect_lanes(beam_wrench<Two>(rest, both(a.d, b.d), both(a.q1, b.q1), both(a.q2, b.q2)),
                 beam_wrench(r, a.d, a.q1, a.q2), beam_wrench(s, b.d, b.q1, b.q2));
    const auto pack =
        beam_stress<Two>(beam_section<Two>(rest, both(a.d, b.d), both(a.q1, b.q1), both(a.q2, b.q2)), 0.3);
    EXPECT_EQ(pack.principal.a, beam_stress<Real>(beam_section(r, a.d, a.q1, a.q2), 0.3).principal);
    EXPECT_EQ(pack.principal.b, beam_stress<Real>(beam_section(s, b.d, b.q1, b.q2), 0.3).principal);
  }
}

TEST(lane, a_contact_in_a_pack_has_the_bits_of_a_contact_alone_on_either_side_of_every_threshold) {
  Random random(2);
  constexpr auto modes = CohesiveModes::both;
  const CohesiveLaws<Real> laws{{60, 0.05, 0.4}, {40, 0.05, 0.4}};
  const CohesiveLaws<Two> packed{{60., 0.05, 0.4}, {40., 0.05, 0.4}};
  const Vec3 bonded(1, 0.5, -0.2);
  const auto arms = contact_arms(bonded, 1, 1, identity(), identity());
  const CohesiveRest<Real> rest{bonded.norm(), 2};
  int failed = 0, pressed = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const State a = random_state(random), b = random_state(random);
    const Openings<Real> ka{random.uniform(0, 0.5), random.uniform(0, 0.5)}, kb{random.uniform(0, 0.1), 0};
    const auto one = cohesive_wrench<modes>(laws, rest, arms, a.d, a.q1, a.q2, ka);
    const auto other = cohesive_wrench<modes>(laws, rest, arms, b.d, b.q1, b.q2, kb);
    const auto pack = cohesive_wrench<modes, Two>(
        packed, {rest.length, 2.}, {both(arms.arm1, arms.arm1), both(arms.arm2, arms.arm2)}, both(a.d, b.d),
        both(a.q1, b.q1), both(a.q2, b.q2), {Two(ka.normal, kb.normal), Two(ka.shear, kb.shear)});
    expect_lanes(pack.wrench, one.wrench, other.wrench);
    EXPECT_EQ(pack.history.normal.a, one.history.normal);
    EXPECT_EQ(pack.history.shear.b, other.history.shear);
    failed += has_failed<modes>(laws, one.history);
    pressed += a.d.norm() < rest.length;
  }
  EXPECT_GT(failed, 20);
  EXPECT_LT(failed, 180);
  EXPECT_GT(pressed, 20);
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
  EXPECT_EQ(count([&] { beam_wrench<Counted>(BeamRest<Counted>{axis, 1., 1., 1., 1.}, apart, turn, turn); }), (std::array{190, 1, 1}));
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
