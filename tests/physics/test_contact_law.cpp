// Spheres that touch: collisions, friction, what is left of a broken bond, and that how pairs are found changes nothing.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <numbers>

#include "core/mechanics/restitution.hpp"
#include "tests/support/deck_run.hpp"
#include "tests/support/parts.hpp"

namespace beadwork {
namespace {

using std::numbers::pi;
using testing::DeckRun;
using testing::run_deck;

constexpr Real R = 1e-3, density = 2000, mass = 4 * pi / 3 * R * R * R * density, inertia = 0.4 * mass * R * R;

std::string sphere(const std::string& set, Real x, Real y, Real z) {
  return fmt::format(R"(<element set="{}" at="{:.17g} {:.17g} {:.17g} m" radius="1 mm" density="2000 kg/m^3"/>)", set,
                     x, y, z);
}
std::string velocity(const std::string& set, const Vec3& v, const Vec3& spin = zero<Vec3>()) {
  return fmt::format(R"(<initial-velocity set="{0}" velocity="{1} {2} {3} m/s"/>)", set, v[0], v[1], v[2]) +
         (spin.norm() > 0 ? fmt::format(R"(<initial-velocity set="{0}" spin="{1} {2} {3} s^-1" centre="0 0 1 mm"/>)",
                                        set, spin[0], spin[1], spin[2])
                          : "");
}
std::string deck(const std::string& fill, const std::string& contact, const std::string& load, const std::string& until,
                 const std::string& bond = "", const std::string& more = "", const std::string& step = "") {
  return "<scene seed=\"5\"><fill>" + fill + "</fill>" + (bond.empty() ? "" : "<bond>" + bond + "</bond>") +
         "<contact>" + contact + "</contact>" + (load.empty() ? "" : "<load>" + load + "</load>") + "<move><verlet " +
         step + " until=\"" + until + "\"/></move><watch><energy-ledger every=\"1\"/></watch>" + more + "</scene>";
}

/// Two spheres that fly at one another with 1 m/s each.
DeckRun head_on(const std::string& contact, const std::string& until = "0.4 ms") {
  return run_deck(deck(sphere("a", -1.01e-3, 0, 0) + sphere("b", 1.01e-3, 0, 0), contact,
                       velocity("a", {1, 0, 0}) + velocity("b", {-1, 0, 0}), until));
}
Real time_in_touch(const DeckRun& run) {
  Real steps = 0;
  for (const auto& row : run.curves.at("energy")) steps += row.at("stored") > 0;
  return steps * run.summary.at("time_step").get<Real>();
}

constexpr const char* linear = R"(<penalty name="c" between="a b" stiffness="1 MN/m" steps="{}" {}/>)";
std::string penalty(int steps, const std::string& more = "") { return fmt::format(fmt::runtime(linear), steps, more); }
std::string hertz(int steps, const std::string& more = "") {
  return fmt::format(R"(<hertz name="c" between="a b" young="10 GPa" poisson="0.25" steps="{}" {}/>)", steps, more);
}

// t = pi sqrt(m*/k), m* = m/2; alike, they exchange their velocities.
TEST(Contact, of_two_that_collide_lasts_half_a_period_and_keeps_momentum_and_energy) {
  const DeckRun run = head_on(penalty(200));
  EXPECT_NEAR(time_in_touch(run), pi * std::sqrt(mass / 2 / 1e6), 0.011 * time_in_touch(run));
  EXPECT_NEAR(run.velocity[0][0], -1, 2e-4);
  EXPECT_NEAR(run.velocity[0][0] + run.velocity[1][0], 0, 1e-14);
  EXPECT_EQ(run.velocity[0][1], 0);
  EXPECT_LT(std::abs(run.energy("residual")), 1e-4 * mass);
}

// Hertz: t = 2.9432 (15 m*/(16 E* sqrt(R*)))^(2/5) v^(-1/5); at the turn m* v^2/2 = 8/15 E* sqrt(R*) delta^(5/2).
TEST(Contact, of_hertz_lasts_as_long_as_the_theory_says_and_longer_when_slower) {
  const DeckRun run = head_on(hertz(100));
  const Real modulus = 10e9 / (2 * (1 - 0.25 * 0.25)), reduced = mass / 2, radius = R / 2;
  const Real expected = 2.9432 * std::pow(15 * reduced / (16 * modulus * std::sqrt(radius)), 0.4) * std::pow(2, -0.2);
  EXPECT_NEAR(time_in_touch(run), expected, 0.02 * expected);
  EXPECT_NEAR(run.largest("energy", "stored"), reduced * 2, 1e-3 * reduced);
  EXPECT_NEAR(run.velocity[0][0], -1, 1e-3);
}

TEST(Contact, gives_back_the_share_of_speed_that_the_deck_says) {
  for (const Real e : {0.2, 0.5, 0.9})
    for (const bool by_hertz : {false, true}) {
      const auto error = [&](int steps) {
        const std::string more = fmt::format(R"(restitution="{}")", e);
        const DeckRun run = head_on(by_hertz ? hertz(steps, more) : penalty(steps, more));
        const Real kinetic = mass * (1 - e * e);
        EXPECT_NEAR(run.energy("dissipated"), kinetic, 0.06 * kinetic);
        EXPECT_LT(std::abs(run.energy("residual")), 0.01 * mass) << e;
        return std::abs(0.5 * (run.velocity[1][0] - run.velocity[0][0]) - e);
      };
      EXPECT_LT(error(400), 0.01) << e << (by_hertz ? " Hertz" : " linear");
    }
}

// A contact with dashpot that may pull would give exp(-pi zeta/sqrt(1 - zeta^2)); one that only pushes gives back more.
TEST(Restitution, of_a_contact_that_only_pushes_lies_above_that_of_a_whole_half_period) {
  for (const Real zeta : {0.1, 0.3, 0.6}) {
    const Real w = std::sqrt(1 - zeta * zeta);
    // it ends where its force does, earlier by atan2(2 zeta w, 1 - 2 zeta^2)/w: Schwager and Poeschel 2007
    const Real end = (pi - std::atan2(2 * zeta * w, 1 - 2 * zeta * zeta)) / w;
    EXPECT_NEAR(restitution_of(1, zeta), std::exp(-zeta * end), 1e-6) << zeta;
    EXPECT_GT(restitution_of(1, zeta), std::exp(-pi * zeta / w));
  }
  for (const Real e : {0.1, 0.7, 0.99}) {
    EXPECT_NEAR(restitution_of(1, damping_for(1, e)), e, 1e-9);
    EXPECT_NEAR(restitution_of(1.5, damping_for(1.5, e)), e, 1e-9);
  }
  EXPECT_EQ(damping_for(1.5, 1), 0);
}

/// A sphere that strikes the other, which is held, with 1 m/s downwards and v across. It starts so far beside that the normal
/// is vertical half-way of the contact.
DeckRun oblique(Real v, const std::string& contact) {
  const Real until_then = 0.02e-3 + 0.5 * pi * std::sqrt(mass / 1e6);
  return run_deck(deck(sphere("a", 0, 0, 0) + sphere("b", -v * until_then, 0, 2.02e-3), contact,
                       R"(<hold set="a"/><hold set="a" axes="rx ry rz"/>)" + velocity("b", {v, 0, -1}), "0.05 ms"));
}

// It slides all the time: the impulse across is mu times that along, J = (1 + e) m v_n.
TEST(Contact, that_slides_turns_a_sphere_by_mu_times_the_impulse_along_the_normal) {
  const DeckRun run = oblique(3, penalty(200, R"(friction="0.2")"));
  EXPECT_NEAR(run.velocity[1][0], 3 - 0.2 * 2, 0.01);
  EXPECT_NEAR(run.velocity[1][2], 1, 0.02);
  EXPECT_NEAR(run.energy("residual"), 0, 2e-3 * mass);
  EXPECT_GT(run.energy("dissipated"), 0.5 * mass);
}

// It holds: the slip s swings by k_t (1/m + R^2/I) = 7/2 k_t/m, at k_t = 2/7 k_n as long as the normal does: s' = -s, and
// the momentum across changes by 2/7 of 2 s.
TEST(Contact, that_holds_sends_the_slip_back) {
  const Real v = 0.2;
  const DeckRun run = oblique(v, penalty(200, R"(friction="5")"));
  EXPECT_NEAR(run.velocity[1][0], v - 4. / 7 * v, 0.02 * v);
  EXPECT_NEAR(run.energy("dissipated"), 0, 1e-3 * mass * v * v);
  EXPECT_NEAR(run.energy("residual"), 0, 1e-3 * mass * v * v);
}

// The floor is a sphere of 1 km radius, which is held.
std::string floor_and_ball() {
  return R"(<element set="a" at="0 0 -1000 m" radius="1000 m" density="1 kg/m^3"/>)" + sphere("b", 0, 0, 1e-3);
}
constexpr const char* weight = R"(<gravity set="b"/><hold set="a"/><hold set="a" axes="rx ry rz"/>)";

// v^2/(2 mu g)
// Of second order, though the stiffness across falls as the contact opens.
TEST(Friction, of_hertz_closes_the_ledger_with_the_square_of_the_step) {
  const auto largest = [](int steps) {
    const DeckRun run = oblique(0.5, hertz(steps, R"(friction="0.4")"));
    return std::max(run.largest("energy", "residual"), -run.smallest("energy", "residual"));
  };
  EXPECT_NEAR(largest(20) / largest(80), 16, 2);
}

TEST(Friction, brings_to_rest_what_slides_after_v_squared_over_two_mu_g) {
  const DeckRun run = run_deck(
      deck(floor_and_ball(), R"(<penalty name="c" between="a b" stiffness="1 kN/m" friction="0.3" restitution="0.3"/>)",
           std::string(weight) + R"(<hold set="b" axes="rx ry rz"/>)" + velocity("b", {0.1, 0, 0}), "50 ms"));
  EXPECT_NEAR(run.position[1][0], 0.01 / (2 * 0.3 * 9.80665), 0.01 * 1.7e-3);
  EXPECT_LT(std::abs(run.velocity[1][0]), 1e-3);
  EXPECT_NEAR(run.energy("dissipated"), 0.5 * mass * 0.01, 0.02 * mass * 0.01);
  EXPECT_LT(std::abs(run.energy("residual")), 1e-3 * mass * 0.01);
}

// Thrown without spin a ball slides until it rolls, with 5/7 of its speed; one that rolls goes on as it is.
TEST(Friction, lets_a_ball_roll) {
  const std::string contact =
      R"(<penalty name="c" between="a b" stiffness="1 kN/m" friction="0.3" restitution="0.3"/>)";
  const DeckRun thrown = run_deck(deck(floor_and_ball(), contact, weight + velocity("b", {0.1, 0, 0}), "40 ms"));
  EXPECT_NEAR(thrown.velocity[1][0], 0.1 * 5 / 7, 0.005 * 0.1);
  const DeckRun rolling =
      run_deck(deck(floor_and_ball(), contact, weight + velocity("b", {0.1, 0, 0}, {0, 100, 0}), "40 ms"));
  EXPECT_NEAR(rolling.velocity[1][0], 0.1, 0.002 * 0.1);
  EXPECT_LT(rolling.energy("dissipated"), 0.02 * thrown.energy("dissipated"));
}

// ---- pairs that were bonded

// Pulled until it breaks, then pushed together: nothing resists until the distance at which it broke, or where the
// surfaces touch if that is nearer; then k times what is missing.
TEST(Contact, takes_over_from_a_broken_beam_without_a_jump) {
  const DeckRun run = run_deck(R"(<scene><fill>)" + sphere("a", 0, 0, 0) + sphere("b", 1.9e-3, 0, 0) + R"(</fill>
    <bond><cohesive-beam name="beam" between="a b" young="1 GPa" radius-ratio="0.5"/></bond>
    <fail><bond-stress of="beam" strength="1 MPa"/></fail>
    <contact><penalty name="c" between="a b" stiffness="1 MN/m"/></contact>
    <load><hold set="a"/><hold set="a" axes="rx ry rz"/><pull set="b" axis="x" table="0 s 0 m/s, 1 ms 10 mm/s, 2 ms 0 m/s, 4 ms -10 mm/s, 8 ms -10 mm/s"/></load>
    <move><verlet time-step="1 us" until="7 ms"/></move>
    <watch><force-curve of="b" axis="x" every="1"/><energy-ledger every="1"/></watch></scene>)");
  EXPECT_EQ(run.summary.at("breaks").at("axial-bending"), 1);
  const Real broke = 1.9e-3 * (1 + 1e-3);
  Real largest_jump = 0, before = 0, last = 0, at_break = 0;
  for (const auto& row : run.curves.at("force")) {
    const Real force = row.at("force"), distance = 1.9e-3 + row.at("displacement");
    if (distance > broke) at_break = std::max(at_break, before);
    if (distance < broke && row.at("time") > 3e-3) {
      EXPECT_NEAR(force, -1e6 * (broke - distance), 0.03) << distance;
      largest_jump = std::max(largest_jump, std::abs(force - before));
    } else if (distance > broke + 1e-7) {
      EXPECT_NEAR(force, 0, 1e-3) << distance;
    }
    before = last = force;
  }
  EXPECT_LT(last, -1);
  EXPECT_GT(at_break, 0.7);
  EXPECT_LT(largest_jump, 0.05);
  EXPECT_LT(std::abs(run.energy("residual")), 1e-3 * run.energy("work"));
}

// Broken at 1.8 mm, drawn far beyond any skin, and brought back to 1.9 mm: what touched at 1.8 does so again, not earlier.
TEST(Contact, of_what_was_bonded_is_at_the_distance_of_the_break_however_far_it_went_meanwhile) {
  for (const char* skin : {"0.1", "3"}) {
    const DeckRun run = run_deck("<scene><fill>" + sphere("a", 0, 0, 0) + sphere("b", 1.8e-3, 0, 0) + R"(</fill>
      <bond><spring name="s" between="a b" young="1 GPa"/></bond><fail><bond-stress of="s" strength="10 kPa" measure="axial"/></fail>
      <contact><penalty name="c" between="a b" stiffness="1 MN/m" skin=")" +
                                 skin + R"("/></contact>
      <load><hold set="a"/><pull set="b" axis="x" table="0 s 10 mm/s, 80 ms 10 mm/s, 81 ms 0 m/s, 82 ms -10 mm/s, 160 ms -10 mm/s"/></load>
      <move><verlet time-step="10 us" until="155 ms"/></move><watch><force-curve of="b" axis="x" every="10"/><energy-ledger every="10"/></watch></scene>)");
    EXPECT_EQ(run.failure, "");
    EXPECT_EQ(run.summary.at("breaks").at("axial"), 1);
    const Real last = run.curves.at("force").back().at("displacement");
    ASSERT_LT(last, 0.15e-3);
    ASSERT_GT(last, 0.01e-3);
    EXPECT_NEAR(run.curves.at("force").back().at("force"), 0, 1e-3) << skin;
  }
}

TEST(Contact, of_a_pair_that_two_laws_act_on_is_warned_of) {
  const DeckRun run = run_deck(deck(sphere("a", 0, 0, 0) + sphere("b", 2.1e-3, 0, 0),
                                    penalty(20) + R"(<penalty name="d" between="b a" stiffness="1 MN/m"/>)", "", "5"));
  EXPECT_THAT(run.warned, ::testing::Contains(::testing::HasSubstr("contacts 'd' and 'c' both act on 1 pairs")));
}

TEST(Contact, leaves_pairs_alone_that_a_bond_holds) {
  const DeckRun run = run_deck(deck(sphere("a", 0, 0, 0) + sphere("b", 1.8e-3, 0, 0), penalty(20), "", "10",
                                    R"(<spring name="s" between="a b" young="1 GPa"/>)"));
  EXPECT_EQ(run.summary.at("contacts").at("c"), 0);
  EXPECT_EQ(run.velocity[1][0], 0);
}

// ---- what is warned of

// Three steps, of which 'safety' makes 3.3, resolve a collision badly, and are stable all the same.
TEST(Contact, with_too_few_steps_is_named_where_the_balance_has_an_excess) {
  const auto run = [](int steps) {
    return run_deck(deck(sphere("a", -1.01e-3, 0, 0) + sphere("b", 1.01e-3, 0, 0), penalty(steps),
                         velocity("a", {1, 0, 0}) + velocity("b", {-1, 0, 0}), "300"));
  };
  const DeckRun coarse = run(3), fine = run(20);
  ASSERT_EQ(coarse.warned.size(), 1u);
  EXPECT_THAT(coarse.warned[0], ::testing::HasSubstr("that no work accounts for"));
  EXPECT_THAT(coarse.warned[0],
              ::testing::HasSubstr("; contacts 'c' have 3.3 time steps in their shortest collision, which is few"));
  EXPECT_THAT(fine.warned, ::testing::IsEmpty());
}

TEST(Contact, names_the_element_that_outruns_the_skin_and_its_speed) {
  const DeckRun run = run_deck(deck(sphere("a", 0, 0, 0) + sphere("b", 5e-3, 0, 0), penalty(20),
                                    velocity("b", {-500, 0, 0}), "300", "", "", R"(time-step="1 us")"));
  EXPECT_THAT(run.failure,
              ::testing::HasSubstr("element 1, at 500 m/s, moves by more than 0.00015 m, half of the skin"));
}

/// Two pairs that overlap by 0.15 and 0.05 of a radius, bonded in the first stage or not at all.
std::string two_pairs(const std::string& bond) {
  return R"(<scene><fill>)" + sphere("all", 0, 0, 0) + sphere("all", 1.85e-3, 0, 0) + sphere("all", 0, 9e-3, 0) +
         sphere("all", 1.95e-3, 9e-3, 0) + R"(</fill>
    <contact><penalty name="c" between="all all" stiffness="1 kN/m"/></contact><move><verlet time-step="1 us"/></move>
    <stage name="bonded" until="5">)" +
         bond + R"(</stage><stage name="loose" until="5"/></scene>)";
}

TEST(Contact, warns_of_pairs_that_overlap_deeply_where_it_begins_and_once) {
  const DeckRun run = run_deck(two_pairs(""));
  ASSERT_EQ(run.warned.size(), 1u);
  EXPECT_THAT(run.warned[0],
              ::testing::HasSubstr("stage 'bonded' begins with 1 pairs that overlap by more than 10 % of "
                                   "the smaller radius, and contacts 'c' push them apart at once: the "
                                   "deepest by 0.00015 m, elements 0 and 1; this energy is brought by no"));
}

TEST(Contact, warns_of_pairs_whose_bonds_ended_with_their_stage_and_that_overlap) {
  const DeckRun run = run_deck(two_pairs(R"(<bond><spring name="s" between="all all" young="1 MPa"/></bond>)"));
  ASSERT_EQ(run.warned.size(), 1u);
  EXPECT_THAT(run.warned[0],
              ::testing::HasSubstr("stage 'loose' begins with 2 pairs that overlap and whose bonds ended "
                                   "with the stage before, and contacts 'c' push them apart at once: the "
                                   "deepest by 0.00015 m, elements 0 and 1;"));
}

// ---- how pairs are found

std::string gas(const std::string& skin) {
  return deck(
      R"(<free-filling set="all" box="8 8 8 mm" count="120" density="1200 kg/m^3"/><region set="low" where="z &lt; 4 mm"/>)",
      R"(<hertz name="c" between="all all" young="1 GPa" friction="0.3" restitution="0.8" overlap="0.05" skin=")" +
          skin + R"("/>)",
      R"(<initial-velocity set="all" gradient="-100 0 0 s^-1" along="x" centre="4 4 4 mm"/>
                 <initial-velocity set="all" gradient="0 -200 0 s^-1" along="y" centre="4 4 4 mm"/>
                 <initial-velocity set="low" velocity="0 0 0.5 m/s"/>)",
      "3000", "", "", R"(time-step="0.5 us")");
}

TEST(Contact, has_the_same_bits_whatever_the_skin_for_pairs_that_do_not_touch_add_nothing) {
  const DeckRun narrow = run_deck(gas("0.02")), wide = run_deck(gas("0.9"));
  Real fastest = 0, changed = 0;
  for (std::size_t i = 0; i < narrow.position.size(); ++i) {
    EXPECT_EQ(narrow.position[i], wide.position[i]);
    EXPECT_EQ(narrow.velocity[i], wide.velocity[i]);
    fastest = std::max(fastest, narrow.velocity[i].norm());
    changed = std::max(changed, std::abs(narrow.velocity[i][2]));
  }
  EXPECT_GT(narrow.energy("dissipated"), 0) << "some collided";
  EXPECT_NEAR(narrow.energy("dissipated"), wide.energy("dissipated"), 1e-9 * wide.energy("dissipated"));
  EXPECT_LT(narrow.summary.at("contacts").at("c").get<int>(), wide.summary.at("contacts").at("c").get<int>());
}

TEST(Contact, makes_no_energy_however_often_pairs_are_found_anew) {
  const DeckRun run = run_deck(gas("0.02"));
  const Real kinetic = run.curves.at("energy").front().at("kinetic");
  EXPECT_LT(std::abs(run.energy("residual")), 2e-3 * kinetic);
}

TEST(Contact, is_nothing_in_a_scene_without_it) {
  testing::Parts parts(
      R"(<scene><fill>)" + sphere("a", 0, 0, 0) + sphere("b", 2e-3, 0, 0) +
      R"(</fill><bond><spring name="s" between="a b" young="1 GPa"/></bond><move><verlet until="1"/></move></scene>)");
  parts.begin();
  EXPECT_FALSE(parts.state.domain().elements().find("searched-at"));
  EXPECT_FALSE(parts.state.domain().scene().find("breaks-searched"));
}

}  // namespace
}  // namespace beadwork
