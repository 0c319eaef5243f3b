// Contacts whose normal is carried by the two elements: forces, moments and energies against closed forms.
#include "core/mechanics/cohesive_faces.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/mechanics/cohesive_stiffness.hpp"
#include "core/mechanics/spread.hpp"
#include "core/mechanics/stability.hpp"
#include "core/mechanics/verlet.hpp"
#include "tests/support/mechanics.hpp"

namespace beadwork {
namespace {

using namespace test;
using std::numbers::pi;

using Normal = IndependentModes<CohesiveModes::normal>;
using Shear = IndependentModes<CohesiveModes::shear>;
using Both = IndependentModes<CohesiveModes::both>;

const Softening<Real> opens{60, 0.1, 1}, slides{40, 0.15, 0.8};
const Normal normal{opens, slides};
const Shear shear{opens, slides};
const Both both{opens, slides};
const MixedMode mixed{opens, slides, {false, UnitPower(2.284)}};
constexpr Real area = 0.5;

template <class Modes>
CohesiveHistory<Modes, Real> undamaged_history() {
  return {{Modes::coupled ? 1. : 0., 0}, 0};
}

/// Two elements whose contact has a normal of its own.
struct Contact {
  Pair p;
  ContactArms<Real> arms;
  CarriedNormals<Real> normals;
};

CarriedFaces<Real> faces(const Contact& c, const Pair& p) {
  return carried_faces<Real>(c.arms, c.normals, p.d(), p.q1, p.q2);
}

Contact bonded(const Pair& p, const Vec3& n) {
  return {p, contact_arms(p.d(), 0.8, 1.2, p.q1, p.q2), carried_normals(n, p.q1, p.q2)};
}

/// Bonded with any normal, then moved apart and turned by `size`.
Contact moved_contact(Random& random, Real size) {
  const Vec3 x1 = random_vector(random, 1), way = random_vector(random, 1).normalized();
  const Quat q1 = random_rotation(random), q2 = random_rotation(random);
  Contact c = bonded({x1, x1 + 2 * way, q1, q2}, random_vector(random, 1).normalized());
  c.p = moved(c.p, Vector12::NullaryExpr([&](Eigen::Index) { return size * random.normal(); }));
  return c;
}

template <class Modes>
struct Acted {
  Wrench<Real> wrench;
  CohesiveHistory<Modes, Real> after;
  Real lost;
};

template <class Modes>
Acted<Modes> act(const Modes& modes, const CarriedFaces<Real>& at, const CohesiveHistory<Modes, Real>& before) {
  const auto now = cohesive_state(modes, at, area, before);
  return {cohesive_wrench(modes, at, area, now.share), now.after, cohesive_lost(modes, at, area, before, now.after)};
}

template <class Modes>
Real stored(const Modes& modes, const CarriedFaces<Real>& at, const CohesiveHistory<Modes, Real>& history) {
  return held_energy(modes, area, at.opening, cohesive_state(modes, at, area, history).share);
}

TEST(cohesive_faces, a_new_contact_is_closed_and_its_normal_the_given_one) {
  Random random(1);
  const Vec3 n = random_vector(random, 1).normalized();
  const Contact c = bonded({Vec3(1, 2, 3), Vec3(2, 1, 5), random_rotation(random), random_rotation(random)}, n);
  EXPECT_LT(std::abs(faces(c, c.p).opening.normal), 1e-15);
  EXPECT_LT(faces(c, c.p).opening.shear, 1e-15);
  EXPECT_LT((faces(c, c.p).normal - n).norm(), 1e-15);
}

template <class Modes>
void force_is_the_gradient(const Modes& modes, const typename Modes::template History<Real>& remembered) {
  Random random(2);
  const CohesiveHistory<Modes, Real> history{remembered, 0};
  int counted = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Contact c = moved_contact(random, 0.1);
    const auto at = faces(c, c.p);
    if (std::abs(at.opening.normal) < 0.02 || at.opening.shear < 0.02) continue;                // the kink at u_n = 0
    if (modes.damage(modes.next(at.opening, remembered)) > modes.damage(remembered)) continue;  // with the damage held
    if (at.opening.normal > 0.5 || at.opening.shear > 0.5) continue;
    ++counted;
    const Vector12 expected = -gradient([&](const Pair& p) { return stored(modes, faces(c, p), history); }, c.p);
    const Vector12 found = generalised(act(modes, at, history).wrench);
    EXPECT_LT((found - expected).norm(), 1e-8 * expected.norm()) << trial;
  }
  EXPECT_GT(counted, 30);
}

TEST(cohesive_faces, force_and_torques_are_minus_the_gradient_while_the_damage_stands) {
  force_is_the_gradient(normal, {0.7, 0});
  force_is_the_gradient(shear, {0, 0.6});
  force_is_the_gradient(both, {0.7, 0.6});
  force_is_the_gradient(mixed, {0.05, 0.5});
}

TEST(cohesive_faces, no_net_torque_and_nothing_changes_in_a_rigid_motion_or_with_the_ends_called_the_other_way_round) {
  Random random(3);
  for (int trial = 0; trial < 200; ++trial) {
    const Contact c = moved_contact(random, 0.2);
    const auto before = undamaged_history<Both>();
    const auto one = act(both, faces(c, c.p), before);
    const Wrench<Real>& w = one.wrench;
    const Real scale = w.torque1.norm() + w.torque2.norm() + w.force.norm() * c.p.d().norm();
    EXPECT_LE((w.torque1 + w.torque2 + c.p.d().cross(w.force)).norm(), 2e-15 * scale);

    const Quat turn = random_rotation(random);
    const auto turned = act(both, faces(c, moved_rigidly(c.p, turn, random_vector(random, 1))), before);
    EXPECT_LE((generalised(turned.wrench) - in_blocks(turn) * generalised(w)).norm(), 1e-13 * generalised(w).norm());
    EXPECT_NEAR(turned.after.modes.shear, one.after.modes.shear, 1e-14);

    const Contact other{
        {c.p.x2, c.p.x1, c.p.q2, c.p.q1}, {c.arms.arm2, c.arms.arm1}, {-c.normals.normal2, -c.normals.normal1}};
    const auto swapped = act(both, faces(other, other.p), before);
    EXPECT_LE((swapped.wrench.force + w.force).norm(), 1e-14 * scale);
    EXPECT_LE((swapped.wrench.torque1 - w.torque2).norm() + (swapped.wrench.torque2 - w.torque1).norm(), 1e-14 * scale);
    EXPECT_NEAR(swapped.after.modes.normal, one.after.modes.normal, 1e-15);
  }
}

TEST(cohesive_faces, a_line_of_centres_at_any_angle_gives_strength_times_area_and_its_energy) {
  for (const Real degrees : {0., 45., 90.})
    for (const int axis : {0, 2}) {
      const Real a = degrees * pi / 180;
      const Contact c =
          bonded({Vec3(0, 0, 0), 2 * Vec3(std::sin(a), 0, std::cos(a)), identity(), identity()}, Vec3(0, 0, 1));
      const Softening<Real>& mode = axis == 2 ? opens : slides;
      auto history = undamaged_history<Both>();
      Real work = 0, before = 0, peak = 0;
      const int steps = 20000;
      for (int k = 1; k <= steps + 10; ++k) {
        Pair p = c.p;
        p.x2[axis] += k * mode.open / steps;
        const auto now = act(both, faces(c, p), history);
        history = now.after;
        const Real force = -now.wrench.force[axis];
        EXPECT_NEAR(now.wrench.force.norm(), std::abs(force), 1e-12);
        peak = std::max(peak, force);
        work += 0.5 * (before + force) * mode.open / steps;
        before = force;
      }
      EXPECT_NEAR(peak, mode.stiffness * mode.onset * area, 1e-3 * peak) << degrees << " " << axis;
      EXPECT_NEAR(work, fracture_energy(mode) * area, 1e-6 * work) << degrees << " " << axis;
      EXPECT_TRUE(both.failed(history.modes));
    }
}

// Why there is a normal other than the line of centres: a pair at 45 degrees that is slid, and the like of it on the
// other side, of which one is pressed: it never fails.
TEST(cohesive_faces, a_pair_that_is_slid_towards_its_line_of_centres_locks) {
  const Vec3 d(std::sqrt(2), 0, std::sqrt(2));
  const auto arms = contact_arms(d, 1, 1, identity(), identity());
  const Real slid = 0.7 * slides.open;
  const auto at = pair_faces<Real>(d.norm(), arms, d - Vec3(slid, 0, 0), identity(), identity());
  const auto now = cohesive_state(both, at, area, undamaged_history<Both>());
  EXPECT_GT(cohesive_wrench(both, at, area, now.share).force[0], 1.5 * slides.stiffness * slides.onset * area);
  EXPECT_FALSE(both.failed(now.after.modes));
}

TEST(cohesive_faces, turning_a_fibre_about_its_axis_takes_shear_strength_times_area_times_radius) {
  // the fibre's element at the axis z, its radius .8; its contact at x: a turn by phi slides by 2 R sin(phi/2)
  const Contact c = bonded({Vec3(0, 0, 0), Vec3(2, 0, 0), identity(), identity()}, Vec3(1, 0, 0));
  const Real R = 0.8, phi = 2 * std::asin(0.5 * slides.onset / R);
  Pair p = c.p;
  p.q1 = exp_map(Vec3(0, 0, phi));
  const auto at = faces(c, p);
  EXPECT_NEAR(at.opening.shear, slides.onset, 1e-14);
  EXPECT_NEAR(at.opening.normal, 0, 1e-15);
  const auto now = act(both, at, undamaged_history<Both>());
  EXPECT_NEAR(-now.wrench.torque1[2], slides.stiffness * slides.onset * area * R * std::cos(phi / 2), 1e-13);
}

TEST(cohesive_faces,
     the_opening_seen_by_a_contact_one_of_whose_elements_turns_falls_with_the_cosine_of_half_the_angle) {
  const Contact c = bonded({Vec3(0, 0, 0), Vec3(2, 0, 0), identity(), identity()}, Vec3(1, 0, 0));
  for (const Real phi : {0.1, 0.8}) {
    const Pair p{Vec3(0, 0, 0), Vec3(2.05, 0, 0), exp_map(Vec3(0, 0, phi)), identity()};
    EXPECT_NEAR(faces(c, p).opening.normal, 0.05 * std::cos(phi / 2), 1e-15);
  }
}

TEST(cohesive_faces, the_stiffness_is_the_derivative_of_the_force_of_a_closed_contact) {
  Random random(4);
  const Contact c = moved_contact(random, 0);
  const auto check = [&](const auto& modes) {
    using Modes = std::remove_cvref_t<decltype(modes)>;
    const auto forces = [&](const Pair& p) {
      return generalised(act(modes, faces(c, p), undamaged_history<Modes>()).wrench);
    };
    const Matrix12 expected = -jacobian(forces, c.p);
    EXPECT_LT((shared_stiffness(modes, faces(c, c.p), area, Openings<Real>{1, 1}) - expected).norm(),
              1e-8 * expected.norm());
    EXPECT_GT((expected.block<3, 3>(3, 3).norm()), 1);  // it resists turning
  };
  check(normal);
  check(shear);
  check(both);
  check(mixed);
}

TEST(cohesive_faces, openings_follow_the_coordinates_as_the_stiffness_says_also_where_it_has_opened) {
  Random random(5);
  for (int trial = 0; trial < 20; ++trial) {
    const Contact c = moved_contact(random, 0.2);
    const OpeningRows rows = opening_rows(faces(c, c.p));
    const Vector12 opening = gradient([&](const Pair& p) { return faces(c, p).opening.normal; }, c.p);
    EXPECT_LT((rows.normal.transpose() - opening).norm(), 1e-8);
    for (int k = 0; k < 3; ++k) {
      const Vector12 slip = gradient([&](const Pair& p) { return faces(c, p).slip[k]; }, c.p);
      EXPECT_LT((rows.slip.row(k).transpose() - slip).norm(), 1e-8);
    }
  }
}

// Two spheres of mass m, I = 2/5 m R^2: sliding at a contact a distance R away also turns them, k (2/m + 2 R^2/I) = 7
// k/m; so does opening, where the normal is at right angles to the line of centres.
TEST(cohesive_faces, the_time_step_knows_that_the_elements_turn) {
  const Real m = 3, R = 1, kn = opens.stiffness * area, ks = slides.stiffness * area;
  Eigen::Matrix<Real, 12, 1> inverse_mass;
  for (int k = 0; k < 12; ++k) inverse_mass[k] = k / 3 % 2 == 0 ? 1 / m : 1 / (0.4 * m * R * R);
  const auto lambda = [&](const Vec3& n, const auto& modes) {
    const Contact c{{Vec3(0, 0, 0), Vec3(0, 0, 2 * R), identity(), identity()},
                    contact_arms(Vec3(0, 0, 2 * R), R, R, identity(), identity()),
                    carried_normals(n, identity(), identity())};
    return bond_lambda(shared_stiffness(modes, faces(c, c.p), area, Openings<Real>{1, 1}), inverse_mass);
  };
  EXPECT_NEAR(lambda(Vec3(0, 0, 1), normal), 2 * kn / m, 1e-10);
  EXPECT_NEAR(lambda(Vec3(0, 0, 1), both), 7 * ks / m, 1e-10);
  EXPECT_NEAR(lambda(Vec3(1, 0, 0), normal), 7 * kn / m, 1e-10);
  EXPECT_NEAR(lambda(Vec3(1, 0, 0), mixed), 7 * kn / m, 1e-10);
}

TEST(cohesive_faces, part_when_they_have_slid_by_their_diameter_and_then_do_nothing_more) {
  const Contact c = bonded({Vec3(0, 0, 0), Vec3(0, 0, 2), identity(), identity()}, Vec3(0, 0, 1));
  const Both brief{opens, {40, 0.15, 0.4}};
  const Real diameter = 2 * std::sqrt(area / pi);
  auto history = undamaged_history<Both>();
  Real work = 0, lost = 0, kept = 0;
  Vec3 at = zero<Vec3>(), force = zero<Vec3>();
  const auto go = [&](const Vec3& to, int steps) {
    const Vec3 from = at;
    for (int k = 1; k <= steps; ++k) {
      Pair p = c.p;
      p.x2 = p.x2 + from + (to - from) * k / steps;
      const auto now = act(brief, faces(c, p), history);
      work -= 0.5 * (force + now.wrench.force).dot((to - from) / steps);
      lost += now.lost;
      history = now.after;
      force = act(brief, faces(c, p), history).wrench.force;  // what acts no more goes at the end of the step
      kept = stored(brief, faces(c, p), history);
    }
    at = to;
  };
  go(Vec3(0, 0, -0.05), 1000);
  go(Vec3(0.99 * diameter, 0, -0.05), 20000);
  EXPECT_TRUE(brief.failed(history.modes));
  EXPECT_NEAR(force[2], opens.stiffness * area * 0.05, 1e-13);  // failed, and pressed: a contact without friction
  EXPECT_NEAR(force[0], 0, 1e-13);
  EXPECT_NEAR(work, kept + lost + area * brief.dissipated(history.modes), 1e-6 * work);
  go(Vec3(1.01 * diameter, 0, -0.05), 100);
  EXPECT_GT(history.parted, 0);
  EXPECT_EQ(force.norm(), 0);
  EXPECT_NEAR(work, lost + area * brief.dissipated(history.modes), 1e-6 * work);
  const Real all = lost + area * brief.dissipated(history.modes);
  go(Vec3(0.5, 0, 3), 100);
  go(Vec3(0, 0, -1), 100);
  EXPECT_EQ(force.norm(), 0);
  EXPECT_EQ(lost + area * brief.dissipated(history.modes), all);
}

TEST(cohesive_faces, part_when_one_turns_over_and_are_numbers_even_then) {
  const Contact c = bonded({Vec3(0, 0, 0), Vec3(0, 0, 2), identity(), identity()}, Vec3(0, 0, 1));
  Pair p = c.p;
  p.q2 = Quat{0, Vec3(1, 0, 0)};
  const auto now = act(normal, faces(c, p), undamaged_history<Normal>());
  EXPECT_GT(now.after.parted, 0);
  EXPECT_EQ(generalised(now.wrench).norm(), 0);
}

TEST(cohesive_faces, an_oscillating_contact_keeps_energy_and_both_momenta_while_it_is_undamaged) {
  const Contact c = bonded({Vec3(0, 0, 0), Vec3(1.2, 0, 1.6), identity(), identity()}, Vec3(0, 0, 1));
  Pair p = c.p;
  Vec3 v1(0, -0.02, 0), v2(0.05, 0.02, 0.01), w1(0, 0.02, 0.03), w2(0, 0, 0.03);
  const Real dt = 1e-3, inertia = 0.4;
  const auto acting = [&] { return act(both, faces(c, p), undamaged_history<Both>()).wrench; };
  const auto energy = [&] {
    return 0.5 * (v1.squaredNorm() + v2.squaredNorm() + inertia * (w1.squaredNorm() + w2.squaredNorm())) +
           stored(both, faces(c, p), undamaged_history<Both>());
  };
  const auto spin = [&]() -> Vec3 { return cross(p.x1, v1) + cross(p.x2, v2) + inertia * (w1 + w2); };
  const Real start = energy();
  const Vec3 spin_start = spin();
  Real worst = 0;
  auto on = acting();
  for (int step = 0; step < 10000; ++step) {
    const auto old = on;
    p = {advance<Real>(p.x1, v1, -old.force, dt), advance<Real>(p.x2, v2, old.force, dt),
         turn<Real>(p.q1, w1, old.torque1 / inertia, dt), turn<Real>(p.q2, w2, old.torque2 / inertia, dt)};
    on = acting();
    v1 = correct<Real>(v1, -old.force, -on.force, 1, dt);
    v2 = correct<Real>(v2, old.force, on.force, 1, dt);
    w1 = correct<Real>(w1, old.torque1 / inertia, on.torque1 / inertia, 1, dt);
    w2 = correct<Real>(w2, old.torque2 / inertia, on.torque2 / inertia, 1, dt);
    worst = std::max(worst, std::abs(energy() / start - 1));
  }
  EXPECT_LT(worst, 2e-4);
  EXPECT_LT((spin() - spin_start).norm(), 1e-13);
}

TEST(spread, finds_the_plane_and_the_line_of_least_squares) {
  Random random(6);
  const Quat turn = random_rotation(random);
  std::vector<Vec3> points;
  for (int k = 0; k < 2000; ++k) {
    const Real x = 3e-6 * random.normal(), y = 1e-6 * random.normal(), z = 1e-7 * random.normal();
    points.push_back(Vec3(1, 2, 3) + rotate(turn, Vec3(x, y, z)));
  }
  const Spread spread = spread_of(points);
  EXPECT_NEAR(std::abs(spread.direction[0].dot(rotate(turn, Vec3(0, 0, 1)))), 1, 1e-4);
  EXPECT_NEAR(std::abs(spread.direction[2].dot(rotate(turn, Vec3(1, 0, 0)))), 1, 1e-3);
  EXPECT_NEAR(spread.rms[0], 1e-7, 1e-8);
  EXPECT_NEAR(spread.rms[2], 3e-6, 3e-7);
}

}  // namespace
}  // namespace beadwork
