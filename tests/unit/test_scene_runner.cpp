// Scenes of a study: what comes of them, that nothing is run twice, and that failing is an outcome.

#include "core/loop/scene_runner.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/scratch.hpp"

namespace beadwork {
namespace {

using ::testing::HasSubstr;

const char* const pair = R"(<scene name="pair">
  <parameter name="young" value="10 GPa"/>
  <parameter name="v" value="1e-3 m/s"/>
  <fill><lattice set="pair" count="2 1 1" radius="1 mm" density="1000 kg/m^3"/>
    <region set="left" where="x &lt; 1 mm"/><region set="right" where="x > 1 mm"/></fill>
  <bond><cohesive-beam name="beam" between="pair pair" young="${young}" radius-ratio="0.5"/></bond>
  <load><hold set="left"/><pull set="right" axis="x" velocity="${v}"/></load>
  <move><verlet until="50"/></move>
  <watch><force-curve of="right" axis="x" every="10"/></watch>
</scene>
)";

class SceneRunnerTest : public ::testing::Test {
 protected:
  SceneRunnerTest() : catalogue_(Catalogue::open({})) {
    std::ofstream(scratch_.path() / "pair.xml") << pair;
    options_.program = BEADWORK_EXECUTABLE;
    options_.folder = scratch_.path() / "runs";
    options_.command = "the command";
    options_.shares = {2, 1};
    options_.interrupt = &interrupt_;
  }
  Errand errand(const std::string& name, const std::vector<Override>& overrides = {}) const {
    return {name, scratch_.path() / "pair.xml", overrides};
  }
  testing::Scratch scratch_;
  Catalogue catalogue_;
  std::atomic<int> interrupt_{0};
  SceneRunnerOptions options_;
};

TEST_F(SceneRunnerTest, tells_what_came_of_each_scene_in_their_order) {
  SceneRunner runner(options_, catalogue_);
  const auto outcomes = runner.run({errand("soft"), errand("hard", {{"young", "20 GPa"}}), errand("soft again")});
  ASSERT_EQ(outcomes.size(), 3U);
  for (const Outcome& each : outcomes) EXPECT_TRUE(each.is_done()) << each.reason;
  EXPECT_EQ(outcomes[0].number("elements"), 2);
  ASSERT_EQ(outcomes[0].column("force", "force").size(), 6U);
  EXPECT_GT(outcomes[1].column("force", "force").back(), outcomes[0].column("force", "force").back());
  Real seconds = 0;
  for (const Outcome& each : outcomes) seconds += each.number("loop_seconds");
  runner.run({errand("soft")});
  EXPECT_DOUBLE_EQ(runner.loop_seconds(), seconds) << "what was known counts once";
  EXPECT_TRUE(std::isnan(outcomes[0].number("no/such/number")));
  EXPECT_TRUE(outcomes[0].column("force", "no such column").empty());
}

TEST_F(SceneRunnerTest, runs_nothing_twice_unless_what_goes_in_has_changed) {
  SceneRunner first(options_, catalogue_);
  first.run({errand("pair")});
  SceneRunner again(options_, catalogue_);
  EXPECT_TRUE(again.run({errand("pair")}).front().was_known);
  EXPECT_EQ(again.runs(), 0U);
  EXPECT_FALSE(again.run({errand("pair", {{"young", "11 GPa"}})}).front().was_known);
  std::ofstream(scratch_.path() / "pair.xml", std::ios::app) << "<!-- changed -->\n";
  EXPECT_FALSE(again.run({errand("pair")}).front().was_known);
}

TEST_F(SceneRunnerTest, takes_a_scene_that_fails_as_an_outcome) {
  SceneRunner runner(options_, catalogue_);
  const auto outcomes =
      runner.run({errand("misspelt", {{"yuong", "1 GPa"}}), errand("good"), errand("torn", {{"v", "1e200 m/s"}})});
  EXPECT_EQ(outcomes[0].code, ExitCode::deck);
  EXPECT_THAT(outcomes[0].reason, HasSubstr("yuong"));
  EXPECT_TRUE(outcomes[1].is_done());
  EXPECT_EQ(outcomes[2].code, ExitCode::physics) << outcomes[2].reason;
  EXPECT_FALSE(outcomes[2].reason.empty());
  EXPECT_TRUE(runner.run({errand("torn", {{"v", "1e200 m/s"}})}).front().was_known);
}

TEST_F(SceneRunnerTest, that_is_interrupted_says_how_to_go_on) {
  SceneRunner runner(options_, catalogue_);
  interrupt_ = 2;
  try {
    runner.run({errand("pair")});
    FAIL() << "it ran";
  } catch (const Interrupted& stop) {
    EXPECT_THAT(stop.what(), HasSubstr("go on with: the command"));
  }
}

}  // namespace
}  // namespace beadwork
