// Sets that are turned about an axis: where they stand, what torque it takes, and its work.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/loop/run.hpp"
#include "core/mechanics/beam.hpp"
#include "core/mechanics/ramp.hpp"
#include "core/mechanics/rigid_turn.hpp"
#include "tests/support/deck_run.hpp"
#include "tests/support/parts.hpp"

namespace beadwork {
namespace {

using std::numbers::pi;
using ::testing::HasSubstr;
using testing::Parts;

Vec3 of(const Parts& parts, const char* field, Index row) {
  return parts.state.domain().elements().column(field).view<Vec3>()[row];
}
Quat orientation(const Parts& parts, Index row) {
  return parts.state.domain().elements().column("orientation").view<Quat>()[row];
}
void go(Parts& parts, int steps) {
  for (int k = 0; k < steps; ++k) parts.step();
  parts.fresh.complete();
}

// Runs the deck in this folder, or goes on with what was run there.
std::unique_ptr<Scene> run_in(const std::filesystem::path& out, const std::string& text, const RunOptions& options) {
  const std::string file = out.string() + ".xml";
  testing::write_text(file, text);
  Complaints complaints;
  const auto deck = read_deck(file, {}, complaints);
  const Catalogue catalogue = Catalogue::open({});
  complaints.throw_if_any();
  auto scene = Scene::assemble(*deck, catalogue, complaints);
  complaints.throw_if_any();
  RunFolder folder = options.resume ? RunFolder::resume(out) : RunFolder::fresh(out, false);
  Run(*scene, catalogue, folder, options).all();
  return scene;
}

TEST(Turning, knows_sine_and_cosine_of_any_angle_to_round_off) {
  for (const Real angle :
       {0.0, 1e-9, -1e-9, 0.5, -0.7, pi / 4, pi / 2, -pi / 2, 2.0, pi, 4.0, 6.0, -5.0, 1e3, -54321.9, 7e5}) {
    const Turned by = turned(angle);
    EXPECT_NEAR(by.sine, std::sin(angle), 3e-16) << angle;
    EXPECT_NEAR(by.less, std::cos(angle) - 1, 5e-16) << angle;
  }
  EXPECT_NEAR(turned(1e-9).less / -0.5e-18, 1, 1e-15);
  EXPECT_NEAR(turned(-1e-9).sine / -1e-9, 1, 1e-15);
}

// ---- where it stands

// A heavy ball on an arm of 1 m about an axis along z, and beside it one that turns about its own centre.
constexpr const char* on_an_arm = R"(<scene>
  <fill>
    <element set="ball" at="1 0 0.25 m" radius="0.2 m" density="2000 kg/m^3"/>
    <element set="top" at="9 0 0 m" radius="0.2 m" density="2000 kg/m^3"/>
  </fill>
  <load><turn set="ball" about="0 0 0 m" axis="z" velocity="1000 rad/s"{0}/><turn set="top" axis="y" velocity="-70 rad/s"/></load>
  <move><verlet time-step="0.1 ms" until="1"/></move>
</scene>)";

TEST(Turning, an_arm_of_a_metre_stands_on_its_circle_after_fifteen_hundred_turns) {
  Parts parts(fmt::format(on_an_arm, ""));
  parts.begin();
  go(parts, 100'000);
  const Real angle = 1000 * parts.state.moment.time;
  ASSERT_GT(angle, 3000 * pi);
  const Vec3 place(std::cos(angle), std::sin(angle), 0.25);
  EXPECT_LT((of(parts, "position", 0) - place).norm(), 1e-12);
  EXPECT_LT((of(parts, "velocity", 0) - 1000 * Vec3(-place.y(), place.x(), 0)).norm(), 1e-9);
  EXPECT_EQ(of(parts, "spin", 0), Vec3(0, 0, 1000));
  const Quat q = orientation(parts, 0);
  EXPECT_LT((rotate(q, Vec3::UnitX()) - Vec3(place.x(), place.y(), 0)).norm(), 1e-11);
  EXPECT_LT((rotate(q, Vec3::UnitZ()) - Vec3::UnitZ()).norm(), 1e-12);
  // the other one has turned where it was
  EXPECT_EQ(of(parts, "position", 1), Vec3(9, 0, 0));
  EXPECT_EQ(of(parts, "spin", 1), Vec3(0, -70, 0));
  const Real other = 70 * parts.state.moment.time;
  EXPECT_LT((rotate(orientation(parts, 1), Vec3::UnitX()) - Vec3(std::cos(other), 0, std::sin(other))).norm(), 1e-11);
}

TEST(Turning, is_kept_on_its_circle_by_the_centripetal_force) {
  Parts parts(fmt::format(on_an_arm, ""));
  parts.begin();
  go(parts, 12);
  const Real mass = 2000 * 4.0 / 3 * pi * 0.008;
  const Vec3 place = of(parts, "position", 0);
  const Vec3 inward = -mass * 1e6 * Vec3(place.x(), place.y(), 0);
  EXPECT_LT((parts.state.held()[0].force() - inward).norm(), 1e-9 * inward.norm());
  EXPECT_NEAR(parts.state.held()[0].reaction, 0, 1e-9 * inward.norm());
}

// Whatever the step: places and orientations follow from the time, also while the velocity changes.
TEST(Turning, follows_its_course_exactly_however_long_the_steps_are) {
  const char* table = R"(<scene>
    <fill><element set="a" at="2 3 4 m" radius="1 m" density="2000 kg/m^3"/><element set="b" at="9 9 9 m" radius="1 m" density="1 kg/m^3"/></fill>
    <load><turn set="a" about="1 1 1 m" axis="x" table="0 s 0 rad/s, 1 s 3 rad/s, 3 s -1 rad/s"/><turn set="b" axis="z" velocity="1 rad/s"/></load>
    <move><verlet time-step="{} s" beta="{}" until="1"/></move></scene>)";
  for (const Real beta : {1.0, 0.5})
    for (const int steps : {4, 37}) {
      Parts parts(fmt::format(fmt::runtime(table), 2.0 / steps, beta));
      parts.begin();
      go(parts, steps);
      const Real angle = VelocityTable({{0, 0}, {1, 3}, {3, -1}}).at(parts.state.moment.time).displacement;
      ASSERT_NEAR(angle, 3.5, 1e-9);
      const Real c = std::cos(angle), s = std::sin(angle);
      EXPECT_LT((of(parts, "position", 0) - Vec3(2, 1 + 2 * c - 3 * s, 1 + 3 * c + 2 * s)).norm(), 1e-14);
      EXPECT_LT((rotate(orientation(parts, 0), Vec3::UnitY()) - Vec3(0, c, s)).norm(), 1e-14);
      EXPECT_NEAR(of(parts, "spin", 0).x(), 1, 1e-14);
    }
}

TEST(Turning, screws_with_a_pull_along_its_axis) {
  Parts parts(R"(<scene>
    <fill><element set="bit" at="1 0 0 m" radius="1 m" density="2000 kg/m^3"/><element set="wall" at="9 0 0 m" radius="1 m" density="2000 kg/m^3"/></fill>
    <load>
      <turn set="bit" about="0 0 0 m" axis="z" velocity="1 rad/s" along="free"/><pull set="bit" axis="z" velocity="0.5 m/s"/>
      <turn set="wall" axis="x" velocity="2 rad/s"/><hold set="wall" axes="ry rz y z"/><pull set="wall" axis="x" velocity="-1 m/s"/>
      <gravity acceleration="1 1 1 m/s^2"/>
    </load>
    <move><verlet time-step="0.1 s" until="1"/></move></scene>)");
  parts.begin();
  go(parts, 20);
  EXPECT_LT((of(parts, "position", 0) - Vec3(std::cos(2.0), std::sin(2.0), 1)).norm(), 1e-14);
  EXPECT_LT((of(parts, "velocity", 0) - Vec3(-std::sin(2.0), std::cos(2.0), 0.5)).norm(), 1e-14);
  EXPECT_LT((of(parts, "position", 1) - Vec3(7, 0, 0)).norm(), 1e-14);
  EXPECT_EQ(of(parts, "spin", 1), Vec3(2, 0, 0));
  EXPECT_LT((rotate(orientation(parts, 1), Vec3::UnitY()) - Vec3(0, std::cos(4.0), std::sin(4.0))).norm(), 1e-14);
}

TEST(Turning, goes_on_from_one_stage_to_the_next) {
  const auto run = testing::run_deck(R"(<scene>
    <fill><element set="a" at="1 0 0 m" radius="1 m" density="2000 kg/m^3"/></fill>
    <load><turn set="a" about="0 0 0 m" axis="z" velocity="1 rad/s"/></load>
    <move><verlet time-step="0.1 s"/></move>
    <stage name="one" until="10"/><stage name="two" until="10"/></scene>)");
  ASSERT_EQ(run.failure, "");
  EXPECT_LT((run.position[0] - Vec3(std::cos(2.0), std::sin(2.0), 0)).norm(), 1e-14);
}

// ---- torque and work

constexpr const char* balls = R"(
  <element set="set" at="0 0 0 m" radius="0.1 m" density="2000 kg/m^3"/>
  <element set="set" at="0.2 0 0 m" radius="0.1 m" density="2000 kg/m^3"/>
  <element set="set" at="0.2 0.3 0 m" radius="0.2 m" density="1000 kg/m^3"/>)";

TEST(Turning, takes_the_torque_and_the_work_of_its_inertia_to_be_set_in_motion) {
  const auto run = testing::run_deck(fmt::format(R"(<scene>
    <fill>{}</fill>
    <bond><cohesive-beam name="beam" between="set set" gap="0.1" young="1 GPa" radius-ratio="0.5"/></bond>
    <load><turn set="set" about="-1 0 5 m" axis="z" velocity="30 rad/s" rise="20 ms"/></load>
    <move><verlet time-step="0.05 ms" until="30 ms"/></move>
    <watch><force-curve of="set" axis="rz" every="1"/><energy-ledger every="1"/></watch></scene>)",
                                                 balls));
  ASSERT_EQ(run.failure, "");
  const Real small = 2000 * 4.0 / 3 * pi * 1e-3, large = 1000 * 4.0 / 3 * pi * 8e-3;
  const Real inertia = small * (1 + 0.4 * 0.01) + small * (1.44 + 0.4 * 0.01) + large * (1.44 + 0.09 + 0.4 * 0.04);
  const Real energy = 0.5 * inertia * 900;
  EXPECT_NEAR(run.energy("work") / energy, 1, 1e-12);
  EXPECT_NEAR(run.energy("kinetic") / energy, 1, 1e-12);
  EXPECT_LT(std::abs(run.energy("residual")), 1e-12 * energy);
  const SmoothRamp ramp{30, 0.02};
  for (const auto& row : run.curves.at("force")) {
    const PrescribedMotion now = ramp.at(row.at("time"));
    EXPECT_NEAR(row.at("turn"), now.displacement, 1e-14);
    EXPECT_NEAR(row.at("torque"), inertia * now.acceleration, 1e-8 * inertia * 30 / 0.02) << row.at("time");
  }
}

constexpr Real young = 100e9, radius = 0.5e-3, length = 2e-3;

testing::DeckRun twisted_beam(const std::string& loads, const std::string& step, const std::string& watch = "") {
  return testing::run_deck(fmt::format(R"(<scene>
    <fill>
      <element set="left" at="0 0 0 mm" radius="1 mm" density="2000 kg/m^3"/>
      <element set="right" at="2 0 0 mm" radius="1 mm" density="2000 kg/m^3"/>
    </fill>
    <bond><cohesive-beam name="beam" between="left right" young="100 GPa" poisson="0.25" radius-ratio="0.5"/></bond>
    <load><hold set="left" axes="x y z rx ry rz"/>{}</load>
    <move><verlet {} until="100 us"/></move>
    <watch>{}<energy-ledger every="1"/></watch></scene>)",
                                       loads, step, watch));
}

TEST(Turning, twists_a_beam_by_the_torque_of_its_section) {
  const Real turn = 1e-3;  // 10 rad/s over a rise of 50 us counts half
  const Real torque = young / 2.5 * pi * std::pow(radius, 4) / 2 * turn / length;
  const char* curves =
      R"(<force-curve of="right" axis="rx" every="1"/><force-curve name="clamp" of="left" axis="rx" every="1"/>)";
  for (
      const char* loads :
      {R"(<turn set="right" about="5 0 0 mm" axis="x" velocity="13.33333333333333333 rad/s" rise="50 us"/>)",
       R"(<turn set="right" axis="x" velocity="13.33333333333333333 rad/s" rise="50 us"/><hold set="right" axes="x y z ry rz"/>)"}) {
    const auto run = twisted_beam(loads, R"(time-step="0.05 us")", curves);
    ASSERT_EQ(run.failure, "");
    const auto& last = run.curves.at("force").back();
    ASSERT_NEAR(last.at("turn") / turn, 1, 2e-3);  // a step late
    const Real torque_now = torque * last.at("turn") / turn;
    EXPECT_NEAR(last.at("torque") / torque_now, 1, 1e-6);
    EXPECT_NEAR(run.curves.at("clamp").back().at("torque") / torque_now, -1, 1e-6);
    const Real inertia = 0.4 * 2000 * 4.0 / 3 * pi * 1e-9 * 1e-6;
    EXPECT_NEAR(run.energy("work"), 0.5 * torque_now * last.at("turn") + 0.5 * inertia * 13.3333333 * 13.3333333,
                1e-6 * torque * turn);
    EXPECT_NEAR(run.energy("stored") / (0.5 * torque_now * last.at("turn")), 1, 1e-6);
    EXPECT_LT(run.largest("energy", "residual"), 1e-6 * run.energy("work"));
    EXPECT_GT(run.smallest("energy", "residual"), -1e-6 * run.energy("work"));
    EXPECT_EQ(run.summary.at("quality").at("verdict"), "good") << run.summary.at("quality");
  }
}

// The far end goes round the held one: the torque is that of its force on the arm and of its couple. The chord leaves
// the held section by the angle and goes with the other: U = B sin^2.
TEST(Turning, bends_a_beam_by_force_and_couple_and_books_their_work_to_second_order) {
  const Real bending = round_beam(Vec3(length, 0, 0), young, 0.25, radius).bending;
  Real before = 0;
  for (const char* step : {"1 us", "0.5 us", "0.25 us"}) {
    const auto run =
        twisted_beam(R"(<turn set="right" about="0 0 0 mm" axis="z" velocity="4000 rad/s" rise="20 us"/>)",
                     fmt::format("time-step=\"{}\"", step), R"(<force-curve of="right" axis="rz" every="1"/>)");
    ASSERT_EQ(run.failure, "");
    for (const auto& row : run.curves.at("force")) {
      if (row.at("time") < 20.5e-6) continue;  // no angular acceleration any more
      EXPECT_NEAR(row.at("torque"), bending * std::sin(2 * row.at("turn")), 1e-9 * bending);
    }
    const Real turn = run.curves.at("force").back().at("turn");
    EXPECT_NEAR(run.energy("stored"), bending * std::sin(turn) * std::sin(turn), 1e-9 * bending);
    const Real error = std::abs(run.energy("residual")) / bending;
    EXPECT_LT(error, 1e-5);
    if (before > 0) {
      EXPECT_NEAR(before / error, 4, 0.2) << step;
    }
    before = error;
  }
}

// A held turn stays what it is also where the bond that turned against it breaks.
TEST(Turning, of_a_clamp_does_not_come_with_the_break_of_its_beam) {
  const testing::Scratch scratch;
  const auto scene = run_in(scratch / "out", R"(<scene>
    <fill>
      <element set="left" at="0 0 0 mm" radius="1 mm" density="2000 kg/m^3"/>
      <element set="right" at="2 0 0 mm" radius="1 mm" density="2000 kg/m^3"/>
    </fill>
    <bond><cohesive-beam name="beam" between="left right" young="100 GPa" radius-ratio="0.5"/></bond>
    <fail><bond-stress of="beam" strength="20 MPa"/></fail>
    <load><hold set="left" axes="x y z rx ry rz"/><turn set="right" about="0 0 0 mm" axis="z" velocity="100 rad/s"/></load>
    <move><verlet time-step="0.1 us" until="50 us"/></move></scene>)",
                            {});
  ASSERT_EQ(scene->domain->breaks().breaks.size(), 1u);
  const Quat q = scene->domain->elements().column("orientation").view<Quat>()[0];
  EXPECT_EQ(q.w, 1);
  EXPECT_EQ(q.v, Vec3::Zero());
}

// ---- the same bits

struct EndState {
  std::vector<Real> numbers;
  std::string curve;
  bool operator==(const EndState&) const = default;
};

// A bar of beams, one end held, the other turned and pulled; run so many steps, with so many threads.
EndState run_bar(const testing::Scratch& scratch, const char* out, int steps, const RunOptions& options) {
  const auto scene = run_in(scratch / out,
                            fmt::format(R"(<scene>
    <fill>
      <lattice set="bar" count="12 4 4" radius="1 mm" density="2000 kg/m^3"/>
      <region set="left" where="x &lt; 2 mm"/><region set="right" where="x > 21 mm"/>
    </fill>
    <bond><cohesive-beam name="beam" between="bar bar" young="10 GPa" radius-ratio="0.5"/></bond>
    <load><hold set="left"/><turn set="right" about="0 4 4 mm" axis="x" velocity="1000 rad/s" rise="10 us" along="free"/><pull set="right" axis="x" velocity="1 m/s"/></load>
    <move><verlet until="{}"/></move>
    <watch><force-curve of="right" axis="rx" every="10"/></watch></scene>)",
                                        steps),
                            options);
  EndState end;
  const Table& elements = scene->domain->elements();
  for (const char* name : {"position", "velocity", "spin", "force", "torque"})
    for (Index row = 0; row < elements.size(); ++row)
      for (int k = 0; k < 3; ++k) end.numbers.push_back(elements.column(name).view<Vec3>()[row][k]);
  for (Index row = 0; row < elements.size(); ++row) {
    const Quat q = elements.column("orientation").view<Quat>()[row];
    end.numbers.insert(end.numbers.end(), {q.w, q.v[0], q.v[1], q.v[2]});
  }
  for (const char* name : {"reaction", "work", "force-x", "force-y", "force-z"}) {
    const auto column = std::as_const(scene->domain->list("constraints")).column(name).view<Real>();
    for (Index k = 0; k < scene->domain->list("constraints").size(); ++k) end.numbers.push_back(column[k]);
  }
  std::ifstream file(scratch / out / "curves/force.csv");
  end.curve.assign(std::istreambuf_iterator<char>(file), {});
  return end;
}

TEST(Turning, gives_the_same_bits_with_any_number_of_threads_and_with_a_restart) {
  const testing::Scratch scratch;
  const EndState whole = run_bar(scratch, "whole", 200, {});
  ASSERT_THAT(whole.curve, HasSubstr("torque"));
  RunOptions two;
  two.threads = 2;
  EXPECT_EQ(run_bar(scratch, "threads", 200, two), whole);
  run_bar(scratch, "parts", 77, {});
  RunOptions on;
  on.resume = true;
  EXPECT_EQ(run_bar(scratch, "parts", 200, on), whole);
  EXPECT_NE(run_bar(scratch, "other", 201, {}), whole);
}

// ---- what it is for the rest of the house

TEST(Turning, is_no_displacement_that_a_stage_could_wait_for) {
  const char* deck = R"(<scene>
    <fill><element set="a" at="1 0 0 m" radius="1 m" density="2000 kg/m^3"/></fill>
    <load><turn set="a" about="0 0 0 m" axis="z" velocity="1 rad/s"/></load>
    <move><verlet time-step="1 ms" until="1 mm"/></move></scene>)";
  try {
    testing::run_deck(deck);
    FAIL() << "it waits for ever";
  } catch (const std::exception& refused) {
    EXPECT_THAT(refused.what(), HasSubstr("nothing in <load> is pulled"));
  }
}

}  // namespace
}  // namespace beadwork
