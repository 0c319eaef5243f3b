// Elements and rigid walls: what bounces off, slides, rolls and is pressed, whatever the wall is made of.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>
#include <numbers>

#include "tests/support/deck_run.hpp"
#include "tests/support/parts.hpp"

namespace beadwork {
namespace {

using std::numbers::pi;
using testing::DeckRun;
using testing::run_deck;
using testing::Scratch;

constexpr Real R = 1e-3, density = 2000, mass = 4 * pi / 3 * R * R * R * density, g = 9.80665;

std::string ball(Real x, Real y, Real z, const std::string& set = "ball") {
  return fmt::format(R"(<element set="{}" at="{:.17g} {:.17g} {:.17g} m" radius="1 mm" density="2000 kg/m^3"/>)", set,
                     x, y, z);
}
std::string wall(const std::string& what, const std::string& set = "wall") {
  return fmt::format(R"(<wall set="{}" {}/>)", set, what);
}
const std::string plane = wall(R"(shape="plane" at="0 0 0 m" normal="0 0 2")");
std::string deck(const std::string& fill, const std::string& contact, const std::string& load, const std::string& until,
                 const std::string& watch = "") {
  return "<scene><fill>" + fill + "</fill><contact>" + contact + "</contact>" +
         (load.empty() ? "" : "<load>" + load + "</load>") + "<move><verlet until=\"" + until +
         "\"/></move><watch><energy-ledger every=\"1\"/>" + watch + "</watch></scene>";
}
std::string penalty(const std::string& more = "", const std::string& stiffness = "1 MN/m") {
  return fmt::format(R"(<penalty name="c" between="ball wall" stiffness="{}" {}/>)", stiffness, more);
}
std::string velocity(Real x, Real y, Real z) {
  return fmt::format(R"(<initial-velocity set="ball" velocity="{} {} {} m/s"/>)", x, y, z);
}
Real time_in_touch(const DeckRun& run) {
  Real steps = 0;
  for (const auto& row : run.curves.at("energy")) steps += row.at("stored") > 0;
  return steps * run.summary.at("time_step").get<Real>();
}

/// An STL of these triangles.
std::string stl(const std::vector<std::array<Vec3, 3>>& triangles) {
  std::string text = "solid test\n";
  for (const auto& t : triangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const Vec3& c : t) text += fmt::format("vertex {:.9g} {:.9g} {:.9g}\n", c.x(), c.y(), c.z());
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid\n";
}
/// A flat ground of squares of 1, from -n to n, each of two triangles.
std::string ground(int n) {
  std::vector<std::array<Vec3, 3>> all;
  for (int i = -n; i < n; ++i)
    for (int j = -n; j < n; ++j) {
      all.push_back({Vec3(i, j, 0), Vec3(i + 1, j, 0), Vec3(i + 1, j + 1, 0)});
      all.push_back({Vec3(i, j, 0), Vec3(i + 1, j + 1, 0), Vec3(i, j + 1, 0)});
    }
  return stl(all);
}
std::string cube_stl() {
  std::vector<std::array<Vec3, 3>> all;
  for (int axis = 0; axis < 3; ++axis)
    for (const Real sign : {-1., 1.}) {
      const Vec3 n = sign * Vec3::Unit(axis), u = Vec3::Unit((axis + 1) % 3), v = sign * Vec3::Unit((axis + 2) % 3);
      all.push_back({Vec3(n - u - v), Vec3(n + u - v), Vec3(n + u + v)});
      all.push_back({Vec3(n - u - v), Vec3(n + u + v), Vec3(n - u + v)});
    }
  return stl(all);
}

// t = pi sqrt(m/k): the wall does not give way.
TEST(Wall, sends_a_ball_back_after_half_a_period_of_its_mass) {
  const DeckRun run =
      run_deck(deck(ball(0, 0, 1.01e-3) + plane, penalty(R"(steps="200")"), velocity(0, 0, -1), "0.4 ms"));
  EXPECT_NEAR(time_in_touch(run), pi * std::sqrt(mass / 1e6), 0.011 * time_in_touch(run));
  EXPECT_NEAR(run.velocity[0][2], 1, 1e-4);
  EXPECT_LT(std::abs(run.energy("residual")), 1e-4 * mass);
}

TEST(Wall, gives_back_the_share_of_speed_that_the_deck_says) {
  for (const char* e : {"0.2", "0.5", "0.9"}) {
    const DeckRun run =
        run_deck(deck(ball(0, 0, 1.01e-3) + plane, penalty(fmt::format(R"(steps="200" restitution="{}")", e)),
                      velocity(0, 0, -1), "0.4 ms"));
    EXPECT_NEAR(run.velocity[0][2], std::stod(e), 0.01);
    EXPECT_LT(std::abs(run.energy("residual")), 2e-3 * mass);
  }
}

// With the steps that a deck has by itself, wherever within a step the ball touches first (docs/theory/contact.md).
TEST(Wall, meets_the_restitution_within_some_hundredths_at_twenty_steps) {
  for (const auto& [law, band] :
       {std::pair(R"(<penalty name="c" between="ball wall" stiffness="1 MN/m" restitution="0.5"/>)", 0.022),
        {R"(<hertz name="c" between="ball wall" young="10 GPa" restitution="0.5"/>)", 0.008}}) {
    Real least = 1, most = 0;
    for (int phase = 0; phase < 12; ++phase) {
      const DeckRun run =
          run_deck(deck(ball(0, 0, 1.01e-3 + phase * 0.3e-6) + plane, law, velocity(0, 0, -1), "0.4 ms"));
      least = std::min(least, run.velocity[0][2]), most = std::max(most, run.velocity[0][2]);
    }
    EXPECT_NEAR(least, 0.5, band) << law;
    EXPECT_NEAR(most, 0.5, band) << law;
    EXPECT_GT(most - least, 1e-4) << "the first touch is not always at the same part of a step";
  }
}

// Hertz: t = 2.9432 (15 m/(16 E* sqrt(R)))^(2/5) v^(-1/5) with E* = E/(1 - nu^2) and R* = R at a rigid plane.
TEST(Wall, is_pressed_as_Hertz_says_of_a_rigid_plane) {
  const DeckRun run = run_deck(deck(
      ball(0, 0, 1.01e-3) + plane, R"(<hertz name="c" between="wall ball" young="10 GPa" poisson="0.25" steps="100"/>)",
      velocity(0, 0, -1), "0.4 ms"));
  const Real modulus = 10e9 / (1 - 0.25 * 0.25);
  const Real expected = 2.9432 * std::pow(15 * mass / (16 * modulus * std::sqrt(R)), 0.4);
  EXPECT_NEAR(time_in_touch(run), expected, 0.02 * expected);
  EXPECT_NEAR(run.velocity[0][2], 1, 1e-3);
}

// 4/3 E* sqrt(R*) delta^(3/2): R* of an indenter of 4 mm on a ball of 1 mm, of a hollow of 5 mm, and of rollers between.
TEST(Wall, that_is_curved_is_blunter_or_sharper_than_a_plane) {
  const auto force = [](const std::string& what) {
    const DeckRun run = run_deck(deck(ball(0, 0, 0.99e-3) + wall(what),
                                      R"(<hertz name="c" between="ball wall" young="1 MPa" poisson="0.25"/>)",
                                      R"(<hold set="ball"/>)", "1", R"(<force-curve of="ball" axis="z" every="1"/>)"));
    return -run.curves.at("force").front().at("force");
  };
  const Real flat = force(R"(shape="plane" at="0 0 0 m" normal="0 0 1")");
  EXPECT_NEAR(flat, 4. / 3 * 1e6 / (1 - 0.0625) * std::sqrt(R) * std::pow(1e-5, 1.5), 1e-9 * flat);
  EXPECT_NEAR(force(R"(shape="sphere" at="0 0 -4 mm" radius="4 mm")") / flat, std::sqrt(4. / 5), 1e-9);
  EXPECT_NEAR(force(R"(shape="sphere" at="0 0 5 mm" radius="5 mm" side="inside")") / flat, std::sqrt(5. / 4), 1e-9);
  EXPECT_NEAR(force(R"(shape="cylinder" at="-9 0 -4 mm" to="9 0 -4 mm" radius="4 mm")") / flat, std::pow(4. / 5, 0.25),
              1e-9);
  EXPECT_NEAR(force(R"(shape="cylinder" at="-9 0 5 mm" to="9 0 5 mm" radius="5 mm" side="inside")") / flat,
              std::pow(5. / 4, 0.25), 1e-9);
}

// A ball that flies at the top of a thing comes back as it came; one that flies past it does not feel it.
TEST(Wall, of_any_shape_sends_a_ball_back_where_it_is_and_nowhere_else) {
  const Scratch scratch;
  testing::write_text(scratch / "cube.stl", cube_stl());
  testing::write_text(scratch / "ground.stl", ground(2));
  for (const std::string& what :
       {std::string(R"(shape="disc" at="0 0 0 mm" normal="0 0 1" radius="2 mm")"),
        std::string(R"(shape="disc" at="0 0 0 mm" normal="0 0 -1" radius="2 mm")"),
        std::string(R"(shape="box" at="0 0 -2 mm" size="4 4 4 mm")"),
        std::string(R"(shape="cylinder" at="-2 0 -2 mm" to="2 0 -2 mm" radius="2 mm")"),
        std::string(R"(shape="cylinder" at="0 0 -9 mm" to="0 0 0 mm" radius="2 mm")"),
        std::string(R"(shape="sphere" at="0 0 -2 mm" radius="2 mm")"),
        fmt::format(R"(shape="surface" at="0 0 -2 mm" unit="2 mm" side="outside" file="{}")",
                    (scratch / "cube.stl").string()),
        fmt::format(R"(shape="surface" at="0 0 -2 mm" unit="2 mm" file="{}")", (scratch / "cube.stl").string()),
        fmt::format(R"(shape="surface" at="0 0 0 mm" unit="1 mm" file="{}")", (scratch / "ground.stl").string())}) {
    const DeckRun hits =
        run_deck(deck(ball(0, 0, 1.01e-3) + wall(what), penalty(R"(steps="100")"), velocity(0, 0, -1), "0.4 ms"));
    EXPECT_NEAR(hits.velocity[0][2], 1, 1e-3) << what;
    EXPECT_NEAR(hits.velocity[0].head<2>().norm(), 0, 1e-12) << what;
    const DeckRun misses =
        run_deck(deck(ball(0, 3.01e-3, 1.01e-3) + wall(what), penalty(), velocity(0, 0, -1), "4 ms"));
    EXPECT_EQ(misses.velocity[0][2], -1) << what;
    EXPECT_EQ(misses.failure, "");
  }
}

// Struck beside its middle, an edge turns the ball away as the rim of a rounded bar would: by the angle of reflection.
TEST(Wall, reflects_at_its_edges_along_the_line_to_the_edge) {
  const Scratch scratch;
  testing::write_text(scratch / "cube.stl", cube_stl());
  const Real s = std::sin(0.4), beside = 2e-3 + s * R;
  for (const std::string& what : {std::string(R"(shape="box" at="0 0 -2 mm" size="4 4 4 mm")"),
                                  std::string(R"(shape="disc" at="0 0 0 mm" normal="0 0 1" radius="2 mm")"),
                                  std::string(R"(shape="cylinder" at="0 0 -9 mm" to="0 0 0 mm" radius="2 mm")"),
                                  fmt::format(R"(shape="surface" at="0 0 -2 mm" unit="2 mm" side="outside" file="{}")",
                                              (scratch / "cube.stl").string())}) {
    const DeckRun run = run_deck(deck(ball(beside, 0, 1.01e-3) + wall(what), penalty(R"(steps="100")", "100 MN/m"),
                                      velocity(0, 0, -1), "0.4 ms"));
    EXPECT_NEAR(run.velocity[0][0], std::sin(0.8), 0.02) << what;
    EXPECT_NEAR(run.velocity[0][2], std::cos(0.8), 0.02) << what;
  }
}

// Two springs in a row: F = k u/2. The wall that nothing moves tells its reaction too, and the work is what is stored.
TEST(Wall, presses_with_a_force_that_both_platens_feel) {
  const DeckRun run = run_deck(deck(
      ball(0, 0, 1e-3) + wall(R"(shape="plane" at="0 0 0 m" normal="0 0 1")", "below") +
          wall(R"(shape="plane" at="0 0 2 mm" normal="0 0 -1")", "above"),
      R"(<penalty name="low" between="ball below" stiffness="1 kN/m"/><penalty name="high" between="above ball" stiffness="1 kN/m"/>)",
      R"(<pull set="above" axis="z" velocity="-1 mm/s" rise="20 ms"/>)", "100 ms",
      R"(<force-curve of="above" axis="z" every="10"/><force-curve name="below" of="below" axis="z" every="10"/>)"));
  const auto &above = run.curves.at("force").back(), &below = run.curves.at("below").back();
  const Real u = -above.at("displacement");
  EXPECT_NEAR(u, 90e-6, 1e-8);
  EXPECT_NEAR(above.at("force"), -500 * u, 1e-3 * 500 * u);
  EXPECT_NEAR(below.at("force"), 500 * u, 1e-3 * 500 * u);
  EXPECT_NEAR(run.energy("stored"), 250 * u * u, 2e-3 * 250 * u * u);
  EXPECT_LT(std::abs(run.energy("residual")), 1e-6 * run.energy("work"));
  EXPECT_NEAR(run.energy("work"), 250 * u * u, 2e-3 * 250 * u * u);
}

// v^2/(2 mu g) on a plane and on a ground of triangles, over whose edges it slides.
TEST(Wall, brings_to_rest_what_slides_on_it) {
  const Scratch scratch;
  testing::write_text(scratch / "ground.stl", ground(4));
  for (const std::string& floor : {plane, wall(fmt::format(R"(shape="surface" at="0 0 0 m" unit="0.31 mm" file="{}")",
                                                           (scratch / "ground.stl").string()))}) {
    const DeckRun run =
        run_deck(deck(ball(-0.9e-3, 0.1e-3, 1e-3) + floor, penalty(R"(friction="0.3" restitution="0.3")", "1 kN/m"),
                      R"(<gravity set="ball"/><hold set="ball" axes="rx ry rz"/>)" + velocity(0.1, 0, 0), "50 ms"));
    EXPECT_NEAR(run.position[0][0] + 0.9e-3, 0.01 / (2 * 0.3 * g), 0.02 * 1.7e-3) << floor;
    EXPECT_LT(std::abs(run.velocity[0][0]), 1e-3);
    EXPECT_NEAR(run.energy("dissipated"), 0.5 * mass * 0.01, 0.02 * mass * 0.01);
    EXPECT_LT(std::abs(run.energy("residual")), 2e-3 * mass * 0.01);
  }
}

TEST(Wall, lets_a_ball_roll_with_five_sevenths_of_its_speed) {
  const DeckRun run = run_deck(deck(ball(0, 0, 1e-3) + plane, penalty(R"(friction="0.3" restitution="0.3")", "1 kN/m"),
                                    R"(<gravity set="ball"/>)" + velocity(0.1, 0, 0), "40 ms"));
  EXPECT_NEAR(run.velocity[0][0], 0.1 * 5 / 7, 0.005 * 0.1);
}

// A pendulum of the length of the hollow less the ball: after half a period it stands on the other side.
TEST(Wall, that_is_hollow_lets_a_ball_swing_like_a_pendulum) {
  const Real length = 19e-3, angle = 0.05, half = pi * std::sqrt(length / g) * (1 + angle * angle / 16);
  for (const char* what :
       {R"(shape="sphere" at="0 0 20 mm" radius="20 mm" side="inside")",
        R"(shape="cylinder" at="0 -30 20 mm" to="0 30 20 mm" radius="20 mm" side="inside" ends="open")"}) {
    const DeckRun run =
        run_deck(deck(ball(length * std::sin(angle), 0, 20e-3 - length * std::cos(angle)) + wall(what),
                      penalty("", "10 kN/m"), R"(<gravity set="ball"/>)", fmt::format("{:.6f} ms", 1e3 * half)));
    EXPECT_NEAR(run.position[0][0], -length * std::sin(angle), 0.01 * length * angle) << what;
    EXPECT_NEAR(run.velocity[0][0], 0, 0.02 * angle * std::sqrt(g * length));
    EXPECT_LT(std::abs(run.energy("residual")), 1e-3 * mass * g * length * angle * angle);
  }
}

// Balls that fly about keep their energy and stay where they are locked in.
TEST(Wall, keeps_in_what_flies_about_in_a_hollow) {
  const Scratch scratch;
  testing::write_text(scratch / "cube.stl", cube_stl());
  for (const std::string& what :
       {std::string(R"(shape="box" at="0 0 0 mm" size="8 8 8 mm" side="inside")"),
        std::string(R"(shape="sphere" at="0 0 0 mm" radius="7 mm" side="inside")"),
        std::string(R"(shape="cylinder" at="0 0 -4 mm" to="0 0 4 mm" radius="6 mm" side="inside")"),
        fmt::format(R"(shape="surface" at="0 0 0 mm" unit="4 mm" side="inside" file="{}")",
                    (scratch / "cube.stl").string()),
        fmt::format(R"(shape="surface" at="0 0 0 mm" unit="4 mm" file="{}")", (scratch / "cube.stl").string())}) {
    const DeckRun run = run_deck(deck(
        R"(<lattice set="ball" from="-2.5 -2.5 -2.5 mm" count="3 3 3" radius="0.9 mm" density="2000 kg/m^3"/>)" +
            wall(what),
        penalty(R"(steps="60")") + R"(<penalty name="d" between="ball ball" stiffness="1 MN/m" steps="60"/>)",
        R"(<initial-velocity set="ball" velocity="1 0.7 -0.4 m/s"/><initial-velocity set="ball" gradient="-300 0 0 s^-1" along="x" centre="0 0 0 mm"/>)",
        "15 ms"));
    EXPECT_EQ(run.failure, "");
    for (std::size_t i = 0; i < 27; ++i) EXPECT_LT(run.position[i].cwiseAbs().maxCoeff(), 6.5e-3) << what;
    const Real kinetic = run.curves.at("energy").front().at("kinetic");
    EXPECT_LT(std::abs(run.energy("residual")), 2e-3 * kinetic) << what;
    EXPECT_GT(run.smallest("energy", "kinetic"), 0);
    EXPECT_GT(run.largest("energy", "stored"), 0.01 * kinetic) << "it struck the wall";
  }
}

// With a mass of its own a lid falls on the ball that lies on the floor, and comes to rest on it with its weight.
TEST(Wall, with_a_mass_is_moved_by_forces) {
  const DeckRun run = run_deck(deck(
      ball(0, 0, 1e-3) + wall(R"(shape="plane" at="0 0 0 m" normal="0 0 1")", "floor") +
          wall(R"(shape="disc" at="0 0 2.1 mm" normal="0 0 -1" radius="3 mm" mass="50 mg")", "lid"),
      R"(<penalty name="low" between="ball floor" stiffness="1 kN/m" restitution="0.3"/><penalty name="high" between="lid ball" stiffness="1 kN/m" restitution="0.3"/>)",
      R"(<gravity/>)", "100 ms", R"(<force-curve of="floor" axis="z" every="10"/>)"));
  EXPECT_NEAR(run.position[2][2], 2e-3, 2e-6);
  EXPECT_NEAR(run.velocity[2][2], 0, 1e-3);
  EXPECT_NEAR(run.curves.at("force").back().at("force"), (mass + 50e-6) * g, 0.05 * 50e-6 * g);
  EXPECT_LT(std::abs(run.energy("residual")), 2e-3 * run.energy("work"));
}

// The surfaces of rollers and triangles move with what turns and shifts them.
TEST(Wall, that_is_pulled_carries_along_what_it_holds_by_friction) {
  const DeckRun run = run_deck(deck(
      ball(0, 0, 0.999e-3) + plane, penalty(R"(friction="5" restitution="0.3")", "1 kN/m"),
      R"(<gravity set="ball"/><hold set="ball" axes="rx ry rz"/><pull set="wall" axis="x" velocity="20 mm/s" rise="5 ms"/>)",
      "50 ms"));
  EXPECT_NEAR(run.position[0][0], 20e-3 * 47.5e-3, 5e-6);  // and swings a little, as nothing damps the hold across
  EXPECT_NEAR(run.velocity[0][0], 20e-3, 3e-3);
}

// Cogs: the rim of the roller moves with w R_w, and so does that of the ball, which cannot go elsewhere; until then friction
// turns it with the torque mu N R, which the roller feels as mu N R_w.
TEST(Wall, that_turns_turns_what_lies_on_it) {
  const DeckRun run = run_deck(deck(
      ball(0, 0, 0.99e-3) + wall(R"(shape="cylinder" at="0 -3 -4 mm" to="0 3 -4 mm" radius="4 mm")"),
      penalty(R"(friction="0.3")", "1 kN/m"), R"(<hold set="ball"/><turn set="wall" axis="y" velocity="1000 rad/s"/>)",
      "7 ms",
      R"(<sensor field="spin" component="y" set="ball" name="spin" every="1"/><force-curve name="torque" of="wall" axis="ry" every="1"/>)"));
  const Real push = 1e3 * 1e-5, inertia = 0.4 * mass * R * R, spin_up = 4000 * inertia / (0.3 * push * R);
  ASSERT_NEAR(spin_up, 4.5e-3, 0.1e-3);
  const std::string column = "mean";
  EXPECT_NEAR(run.curves.at("spin").back().at(column), -4000, 40);
  for (std::size_t k = 0; k < run.curves.at("spin").size(); ++k) {
    const Real time = run.curves.at("spin")[k].at("time");
    if (time < 0.2 * spin_up || time > 0.8 * spin_up) continue;
    EXPECT_NEAR(run.curves.at("spin")[k].at(column), -4000 * time / spin_up, 0.02 * 4000);
    EXPECT_NEAR(run.curves.at("torque")[k].at("torque"), 0.3 * push * 4e-3, 0.02 * 0.3 * push * 4e-3);
  }
  EXPECT_NEAR(run.energy("work"), 0.3 * push * 4e-3 * 1000 * spin_up, 0.02 * 0.3 * push * 4e-3 * 1000 * spin_up);
  EXPECT_LT(std::abs(run.energy("residual")), 0.01 * run.energy("work"));
}

// Friction holds it where it is: the arm of the turntable is that of half a step ago, as the velocities are.
TEST(Wall, that_turns_carries_a_ball_around_without_drawing_it_in) {
  const DeckRun run = run_deck("<scene><fill>" + ball(10e-3, 0, 0.999e-3) +
                               wall(R"(shape="disc" at="0 0 0 m" normal="0 0 1" radius="20 mm")") + "</fill><contact>" +
                               penalty(R"(friction="5" restitution="0.3")", "1 kN/m") +
                               R"(</contact><load><gravity set="ball"/><hold set="ball" axes="rx ry rz"/>
    <turn set="wall" axis="z" velocity="30 rad/s" rise="100 ms"/></load><move><verlet time-step="10 us" until="0.6 s"/></move><watch><energy-ledger every="10"/></watch></scene>)");
  EXPECT_NEAR(run.position[0].head<2>().norm(), 10e-3, 10e-6);  // 24 um nearer with the arm of now
  EXPECT_LT(std::abs(run.energy("residual")), 1e-3 * run.energy("work"));
}

// Each of the balls that it touches has its share of a light lid, and the time step is made for that.
TEST(Wall, that_is_light_does_not_dance_on_many_balls) {
  const DeckRun run = run_deck(deck(
      R"(<lattice set="ball" from="0 0 1 mm" count="4 4 1" radius="1 mm" density="2000 kg/m^3"/>)" +
          wall(R"(shape="plane" at="0 0 0 m" normal="0 0 1")", "floor") +
          wall(R"(shape="disc" at="3 3 2.05 mm" normal="0 0 -1" radius="9 mm" mass="20 mg")", "lid"),
      R"(<penalty name="low" between="ball floor" stiffness="1 kN/m" restitution="0.3"/><penalty name="high" between="lid ball" stiffness="1 kN/m" restitution="0.3"/>)",
      R"(<gravity/>)", "30 ms"));
  EXPECT_EQ(run.failure, "");
  EXPECT_NEAR(run.position.back()[2], 2e-3, 2e-6);
  EXPECT_LT(std::abs(run.energy("residual")), 0.02 * run.energy("work"));
}

// Poured at the rim of a pipe, inside, on it and beside it: what flies in has the energy that it had.
TEST(Wall, of_an_open_pipe_has_rims_that_push_nobody_away_at_once) {
  for (const Real x : {2.9e-3, 3.2e-3, 3.8e-3, 4.5e-3, 4.99e-3}) {
    const DeckRun run = run_deck(
        deck(ball(x, 0, 1.05e-3) +
                 wall(R"(shape="cylinder" at="0 0 -20 mm" to="0 0 0 mm" radius="4 mm" side="inside" ends="open")"),
             penalty(R"(steps="60")", "10 kN/m"), velocity(0, 0, -0.1), "15 ms"));
    EXPECT_EQ(run.failure, "");
    EXPECT_NEAR(run.velocity[0].norm(), 0.1, 1e-3) << x;
    EXPECT_LT(std::abs(run.energy("residual")), 0.01 * mass * 0.01) << x;
  }
}

// A ball that runs round in a hollow of 90 facets keeps its energy, as in one that is round.
TEST(Wall, of_a_round_hollow_of_facets_is_as_smooth_as_a_round_one) {
  const Scratch scratch;
  std::vector<std::array<Vec3, 3>> all;
  for (int k = 0; k < 90; ++k) {
    const auto at = [&](int n, Real z) { return Vec3(4 * std::cos(pi * n / 45), 4 * std::sin(pi * n / 45), z); };
    all.push_back({at(k, -3), at((k + 1) % 90, -3), at((k + 1) % 90, 3)});
    all.push_back({at(k, -3), at((k + 1) % 90, 3), at(k, 3)});
  }
  testing::write_text(scratch / "tube.stl", stl(all));
  const std::string tube =
      wall(fmt::format(R"(shape="surface" at="0 0 0 mm" unit="1 mm" file="{}")", (scratch / "tube.stl").string()));
  const DeckRun run =
      run_deck(deck(ball(0, 2.99e-3, 0) + tube, penalty(R"(steps="60")", "1 kN/m"), velocity(0.3, 0, 0), "200 ms"));
  EXPECT_EQ(run.failure, "");
  EXPECT_NEAR(run.velocity[0].norm(), 0.3, 3e-3);
  EXPECT_LT(std::max(run.largest("energy", "residual"), -run.smallest("energy", "residual")), 0.01 * 0.5 * mass * 0.09);
}

// A wall is one body, and its mean itself.
TEST(Wall, is_pulled_by_its_mean_as_by_itself) {
  const DeckRun run = run_deck(deck(ball(0, 0, 1e-3) + plane, penalty("", "1 kN/m"),
                                    R"(<hold set="ball"/><pull set="wall" axis="z" grip="mean" velocity="1 mm/s"/>)",
                                    "10 ms", R"(<force-curve of="wall" axis="z" every="10"/>)"));
  EXPECT_NEAR(run.curves.at("force").back().at("force"), 1e3 * 10e-6, 1e-3 * 1e-2);
  EXPECT_GT(run.summary.at("time_step").get<Real>(), 1e-6);
}

TEST(Wall, without_a_mass_is_pushed_by_nothing_and_the_run_says_so) {
  const Scratch scratch;
  testing::write_text(scratch / "deck.xml",
                      deck(ball(0, 0, 2e-3) + plane, penalty(), R"(<push set="wall" force="0 0 1 N"/>)", "1"));
  Complaints complaints;
  const auto read = read_deck((scratch / "deck.xml").string(), {}, complaints);
  const auto scene = Scene::assemble(*read, Catalogue::open({}), complaints);
  ASSERT_TRUE(scene);
  EXPECT_EQ(complaints.warnings(), 1);
}

TEST(Wall, has_no_stress_and_is_left_out_where_nobody_names_it) {
  const DeckRun run = run_deck(
      "<scene><fill>" + ball(0, 0, 1e-3) + ball(1.9e-3, 0, 1e-3) + plane +
      R"(</fill><bond><spring name="s" between="ball ball" young="1 GPa"/></bond><contact>)" + penalty() +
      R"(</contact><move><verlet until="3"/></move><watch><sensor field="hydrostatic-stress" name="stress" every="1"/><sensor field="radius" reduce="min" name="radius" every="1"/><energy-ledger every="1"/></watch></scene>)");
  EXPECT_EQ(run.curves.at("radius").back().at("min"), R);
  EXPECT_TRUE(std::isfinite(run.curves.at("stress").back().at("mean")));
}

TEST(Wall, costs_nothing_where_there_is_none) {
  testing::Parts parts(
      deck(ball(0, 0, 0) + ball(3e-3, 0, 0), R"(<penalty name="c" between="ball ball" stiffness="1 MN/m"/>)", "", "1"));
  parts.begin();
  EXPECT_FALSE(parts.state.domain().find_family("c")->rows().find("facet"));
  EXPECT_FALSE(parts.state.domain().walls().any());
  EXPECT_FALSE(parts.state.domain().elements().find("orientation"));
}

}  // namespace
}  // namespace beadwork
