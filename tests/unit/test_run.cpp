// The loop as a library: what no deck can say.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>

#include "core/base/text.hpp"
#include "core/deck/read.hpp"
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
  <watch><tripwire look="1000" every="1"/></watch>
</scene>)";

// The last to look: kills the process at one of its looks.
class Tripwire final : public Watcher {
 public:
  static constexpr const char* about = "Kills the process";
  Param<std::int64_t> look_number{this, {.name = "look", .doc = "At which look, counted from 1"}};
  static inline bool is_armed = false;

  void look(Sight&) override {
    if (is_armed && ++looks_ == *look_number) ::kill(::getpid(), SIGKILL);
  }

 private:
  std::int64_t looks_ = 0;
};

// Moves nothing. Its velocities are asked for where a checkpoint is written, and it takes its time to give them.
class Dawdler final : public Mover {
 public:
  static constexpr const char* about = "Makes checkpoints slow";
  static constexpr std::chrono::milliseconds pause{20};

  void choose_rotations(bool) override {}
  void prepare(Workings& workings, bool) override { workings.moment().time_step = 1e-6; }
  void step(Workings& workings) override { ++workings.moment().step; }
  void complete(Workings&) override { std::this_thread::sleep_for(pause); }
};

RunFigures run_deck(const std::filesystem::path& deck, const std::filesystem::path& out, const RunOptions& options,
                    const std::vector<Override>& overrides = {}) {
  Complaints complaints;
  const auto read = read_deck(deck.string(), overrides, complaints);
  Catalogue catalogue = Catalogue::open({});
  catalogue.add({"no library", "", {entry<Tripwire>("tripwire"), entry<Dawdler>("dawdler")}});
  const auto scene = Scene::assemble(*read, catalogue, complaints);
  complaints.throw_if_any();
  RunFolder folder = options.resume ? RunFolder::resume(out) : RunFolder::fresh(out, false);
  Run run(*scene, catalogue, folder, options);
  run.all();
  return run.figures();
}

// Whether the endless deck, in a process of its own, is killed at its thousandth look.
bool is_killed_on_its_way(const Scratch& scratch, const std::string& out, const RunOptions& options) {
  testing::write_text(scratch / "deck.xml", endless);
  return testing::is_killed([&] {
    Tripwire::is_armed = true;
    run_deck(scratch / "deck.xml", scratch / out, options);
  });
}

TEST(Run, has_a_first_checkpoint_long_before_the_second) {
  const Scratch scratch;
  RunOptions options;
  EXPECT_EQ(options.first_checkpoint_seconds, 60);
  EXPECT_EQ(options.checkpoint_seconds, 600);
  constexpr Real never = 1e9;
  options.checkpoint_seconds = never;
  options.first_checkpoint_seconds = 0;
  ASSERT_TRUE(is_killed_on_its_way(scratch, "early", options));
  EXPECT_EQ(read_checkpoint_meta(scratch / "early/checkpoint.h5").moment.step, 1);
  options.first_checkpoint_seconds = never;
  ASSERT_TRUE(is_killed_on_its_way(scratch, "late", options));
  EXPECT_TRUE(std::filesystem::exists(scratch / "late/summary.json"));
  EXPECT_FALSE(std::filesystem::exists(scratch / "late/checkpoint.h5"));
}

// However fast the machine is: what the checkpoints have slept is missing in the loop.
TEST(Run, does_not_count_checkpoints_among_the_seconds_of_its_loop) {
  const Scratch scratch;
  testing::write_text(scratch / "deck.xml", R"(<scene>
  <fill><element set="ball" at="0 0 0 mm" radius="1 mm" density="2000 kg/m^3"/></fill>
  <move><dawdler until="50"/></move>
</scene>)");
  RunOptions options;
  options.first_checkpoint_seconds = options.checkpoint_seconds = 0;  // one after each step
  const RunFigures figures = run_deck(scratch / "deck.xml", scratch / "out", options);
  EXPECT_GE(figures.wall_seconds - figures.loop_seconds, 50 * std::chrono::duration<Real>(Dawdler::pause).count());
}

// Both watchers look at the last step of the first stage and at the same step where the second begins; a kill then
// comes behind the checkpoint of that step.
constexpr const char* two_stages = R"(<scene>
  <parameter name="look" value="1000"/>
  <fill>
    <element set="left" at="0 0 0 mm" radius="1 mm" density="2000 kg/m^3"/>
    <element set="right" at="2 0 0 mm" radius="1 mm" density="2000 kg/m^3"/>
  </fill>
  <load><hold set="left"/><pull set="right" axis="x" velocity="1 m/s"/></load>
  <move><verlet time-step="1 us"/></move>
  <watch>
    <force-curve of="right" axis="x" every="5"/>
    <snapshot fields="axial-force position velocity" every="10"/>
  </watch>
  <stage name="one" until="30">
    <bond><spring name="soft" between="left right" young="1 MPa"/></bond>
    <watch><snapshot fields="force" every="10"/><tripwire look="1000" every="10"/></watch>
  </stage>
  <stage name="two" until="30">
    <bond><spring name="hard" between="left right" young="10 MPa" gap="0.1"/></bond>
    <watch><snapshot fields="all" every="15"/><force-curve name="late" of="right" axis="x" every="10"/><tripwire look="${look}" every="10"/></watch>
  </stage>
</scene>)";

TEST(Run, that_was_killed_where_a_stage_begins_has_no_row_twice_and_frames_as_without_the_kill) {
  const Scratch scratch;
  testing::write_text(scratch / "deck.xml", two_stages);
  for (const char* look : {"1", "2", "4"}) {  // at the start of the second stage, within it, and at its end
    const auto whole = scratch / (std::string("whole") + look), killed = scratch / (std::string("killed") + look);
    RunOptions options;
    run_deck(scratch / "deck.xml", whole, options, {{"look", look}});
    const auto rows = split(testing::text_of(whole / "curves/force.csv"), '\n');
    EXPECT_EQ(std::count_if(rows.begin(), rows.end(), [](const std::string& row) { return row.starts_with("30,"); }),
              2);
    ASSERT_TRUE(testing::is_killed([&] {
      Tripwire::is_armed = true;
      run_deck(scratch / "deck.xml", killed, options, {{"look", look}});
    }));
    options.resume = true;
    run_deck(scratch / "deck.xml", killed, options, {{"look", look}});
    const std::string compare = std::string("cd ") +
                                BEADWORK_SOURCE_DIR
                                "/tests/support && /usr/bin/python3 -c 'import pathlib, sys, same_run; " +
                                "odd = same_run.differences(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])); "
                                "sys.exit(str(odd) if odd else 0)' ";
    EXPECT_EQ(std::system((compare + whole.string() + " " + killed.string()).c_str()), 0) << "look " << look;
  }
}

}  // namespace
}  // namespace beadwork
