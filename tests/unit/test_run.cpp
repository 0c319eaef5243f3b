// The loop as a library: what no deck can say.

#include <gtest/gtest.h>

#include "core/loop/run.hpp"
#include "tests/support/scratch.hpp"

namespace beadwork {
namespace {

using testing::Scratch;

constexpr const char* endless = R"(<scene>
  <fill>
    <element set="left" at="0 0 0 mm" radius="1 mm" density="2000 kg/m^3"/>
    <element set="right" at="2 0 0 mm" radius="1 mm" density="2000 kg/m^3"/>
  </fill>
  <bond><cohesive-beam name="beam" between="left right" young="1 GPa" radius-ratio="0.5"/></bond>
  <load><hold set="left"/></load>
  <move><verlet until="1000000000000"/></move>
</scene>)";

RunFigures run_deck(const std::filesystem::path& deck, const std::filesystem::path& out, const RunOptions& options) {
  Complaints complaints;
  const auto read = read_deck(deck.string(), {}, complaints);
  const Catalogue catalogue = Catalogue::open({});
  const auto scene = Scene::assemble(*read, catalogue, complaints);
  complaints.throw_if_any();
  RunFolder folder = RunFolder::fresh(out, false);
  Run run(*scene, catalogue, folder, options);
  run.all();
  return run.figures();
}

TEST(Run, has_a_first_checkpoint_long_before_the_second) {
  const Scratch scratch;
  testing::write_text(scratch / "deck.xml", endless);
  RunOptions options;
  EXPECT_EQ(options.first_checkpoint_seconds, 60);
  options.first_checkpoint_seconds = 0.1;
  testing::kill_during([&] { run_deck(scratch / "deck.xml", scratch / "early", options); }, 3'000'000);
  ASSERT_TRUE(std::filesystem::exists(scratch / "early/checkpoint.h5"));
  EXPECT_LT(read_checkpoint_meta(scratch / "early/checkpoint.h5").time, 10);  // some 60 s are reached in the three of the clock
  options.first_checkpoint_seconds = 600;
  testing::kill_during([&] { run_deck(scratch / "deck.xml", scratch / "late", options); }, 1'000'000);
  EXPECT_TRUE(std::filesystem::exists(scratch / "late/summary.json"));
  EXPECT_FALSE(std::filesystem::exists(scratch / "late/checkpoint.h5"));
}

TEST(Run, does_not_count_checkpoints_among_the_seconds_of_its_loop) {
  const Scratch scratch;
  std::string deck = endless;
  testing::write_text(scratch / "deck.xml", deck.replace(deck.find("1000000000000"), 13, "200"));
  RunOptions options;
  options.first_checkpoint_seconds = options.checkpoint_seconds = 0;  // one after each step: milliseconds beside microseconds
  const RunFigures figures = run_deck(scratch / "deck.xml", scratch / "out", options);
  EXPECT_GT(figures.loop_seconds, 0);
  EXPECT_LT(figures.loop_seconds, 0.2 * figures.wall_seconds);
}

}  // namespace
}  // namespace beadwork
