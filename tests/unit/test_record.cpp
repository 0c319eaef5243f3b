// What a run leaves, written as the loop asks for it, without a loop.
#include "core/loop/record.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>

#include "core/base/text.hpp"
#include "core/io/frame_reader.hpp"
#include "tests/support/parts.hpp"

namespace beadwork {
namespace {

using namespace std::chrono_literals;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using testing::message_of;
using testing::Parts;
using testing::Scratch;
using ::testing::StartsWith;
using testing::text_of;
namespace fs = std::filesystem;

constexpr const char* pulled_pair = R"(<scene name="pair">
  <fill>
    <element set="left" at="0 0 0 mm" radius="1 mm" density="2000 kg/m^3"/>
    <element set="right" at="2 0 0 mm" radius="1 mm" density="2000 kg/m^3"/>
  </fill>
  <bond><spring name="s" between="left right" young="1 MPa"/></bond>
  <load><hold set="left"/><pull set="right" axis="x" velocity="1 m/s"/></load>
  <move><verlet time-step="1 us" until="100"/></move>
</scene>)";

/// The record of a run, in a folder of its own, with the parts that it needs. Each session of a run has one; the one
/// before must be gone, as a folder is locked.
class Session {
 public:
  using Clock = Record::Clock;

  enum class How { fresh, resumed };
  explicit Session(const fs::path& root, How how = How::fresh, const std::string& deck = pulled_pair)
      : parts(deck),
        folder(how == How::fresh ? RunFolder::fresh(root, false) : RunFolder::resume(root)),
        not_before(Clock::now()),
        record(parts.state, parts.catalogue(), folder, parts.options, parts.fresh, parts.balance),
        not_after(Clock::now()) {
    parts.options.resume = how == How::resumed;
    parts.options.commands.go_on = "beadwork run pair.xml --resume";
  }

  /// What the loop does before the first step of the session.
  void begin() {
    if (parts.options.resume) record.load();
    if (!parts.options.resume) parts.begin();
    record.open();
    if (parts.options.resume) parts.resume_stage();
    parts.state.phase = RunState::Phase::between_steps;
  }
  void step() {
    parts.step();
    record.note_step();
  }
  /// A row of the curve, whose one value tells the step.
  void note(const std::string& curve) {
    record.row(curve, {.columns = {{"twice", "1"}}, .title = "Twice", .y = {"twice"}},
               std::array{2 * static_cast<Real>(parts.state.moment.step)});
  }
  void frame(const std::string& field) { record.frame({.fields = {field}}); }

  nlohmann::json summary() const { return nlohmann::json::parse(text_of(folder.summary())); }
  std::int64_t saved_step() const { return read_checkpoint_meta(folder.checkpoint()).moment.step; }
  std::vector<std::string> rows_of(const std::string& curve) const {
    std::vector<std::string> rows = split(text_of(folder.curve(curve)), '\n');
    rows.pop_back();  // behind the last line
    return rows;
  }

  Parts parts;
  RunFolder folder;
  Clock::time_point not_before;  ///< its clock started here or later ...
  Record record;
  Clock::time_point not_after;  ///< ... and here or before
};

/// By frame: its step, and the fields of elements besides those that all have.
std::vector<std::pair<std::int64_t, std::vector<std::string>>> frames_in(const fs::path& file) {
  const record::FrameReader reader(file);
  EXPECT_EQ(reader.unreadable_frames(), 0);
  std::vector<std::pair<std::int64_t, std::vector<std::string>>> frames;
  for (const record::FrameHead& head : reader.frames()) {
    frames.push_back({head.step, {}});
    for (const record::FieldValues& field : reader.read(head).fields) frames.back().second.push_back(field.name);
  }
  return frames;
}

/// A session that ends without a word: two steps, a checkpoint, and a third step that it does not know of.
void be_killed_behind_the_checkpoint(const fs::path& root) {
  Session run(root);
  run.begin();
  for (int k = 0; k < 3; ++k) {
    run.step();
    run.note("twice");
    run.frame("velocity");
    if (k == 1) run.record.save();
  }
}

// ---- curves

TEST(Record, takes_up_a_curve_where_the_checkpoint_left_it) {
  const Scratch scratch;
  be_killed_behind_the_checkpoint(scratch / "out");
  Session again(scratch / "out", Session::How::resumed);
  EXPECT_EQ(again.rows_of("twice").size(), 1u + 3u);
  again.begin();
  EXPECT_EQ(again.parts.state.moment.step, 2);
  EXPECT_THAT(again.rows_of("twice"), ElementsAre("step [1],time [s],twice [1]", StartsWith("1,"), StartsWith("2,")))
      << "the third row is of a step that has not been";
  again.step();
  again.note("twice");
  EXPECT_THAT(again.rows_of("twice").back(), AllOf(StartsWith("3,"), EndsWith(",6")));
  Session whole(scratch / "whole");
  whole.begin();
  for (int k = 0; k < 3; ++k) whole.step(), whole.note("twice");
  EXPECT_EQ(text_of(again.folder.curve("twice")), text_of(whole.folder.curve("twice")));
}

TEST(Record, begins_a_curve_once_and_tells_beside_it_how_it_is_drawn) {
  const Scratch scratch;
  Session run(scratch / "out");
  run.begin();
  run.note("twice");
  run.note("twice");
  EXPECT_EQ(run.rows_of("twice").size(), 3u);
  EXPECT_EQ(nlohmann::json::parse(text_of(run.folder.curves() / "twice.json")),
            (nlohmann::json{{"title", "Twice"}, {"y", {"twice"}}}));
  EXPECT_THROW(run.note("../twice"), std::invalid_argument);
}

TEST(Record, says_of_a_curve_that_is_gone_that_its_rows_are_lost) {
  const Scratch scratch;
  be_killed_behind_the_checkpoint(scratch / "out");
  fs::remove(scratch / "out/curves/twice.csv");
  Session again(scratch / "out", Session::How::resumed);
  again.begin();
  EXPECT_THAT(again.parts.warned, ElementsAre(HasSubstr("curve 'twice' is gone")));
  EXPECT_THAT(again.summary().at("notes").at(0).get<std::string>(), HasSubstr("curve 'twice' is gone"));
}

// ---- frames

using Frames = std::vector<std::pair<std::int64_t, std::vector<std::string>>>;

TEST(Record, makes_one_frame_of_what_several_ask_for_at_one_step) {
  const Scratch scratch;
  Session run(scratch / "out");
  run.begin();
  run.step();
  run.frame("velocity");
  run.record.frame({.fields = {"force", "velocity"}, .picture = true});
  EXPECT_EQ(frames_in(run.folder.record()), (Frames{{1, {"force", "velocity"}}}));
  EXPECT_EQ(run.folder.made_in(run.folder.frames()).size(), 1u);
  const record::FrameReader reader(run.folder.record());
  EXPECT_TRUE(reader.frames()[0].picture);
  EXPECT_EQ(reader.read(reader.frames()[0]).bonds.at(0).family, "s");
}

TEST(Record, makes_the_frame_of_the_checkpoint_what_it_was_then_and_drops_later_ones) {
  const Scratch scratch;
  {
    Session run(scratch / "out");
    run.begin();
    run.step();
    run.frame("velocity");
    run.record.save();
    run.frame("force");  // somebody looks at the same step, behind the checkpoint
    run.step();
    run.frame("velocity");
    EXPECT_EQ(frames_in(run.folder.record()), (Frames{{1, {"force", "velocity"}}, {2, {"velocity"}}}));
  }
  Session again(scratch / "out", Session::How::resumed);
  again.begin();
  again.record.frame_anew();
  EXPECT_EQ(frames_in(again.folder.record()), (Frames{{1, {"velocity"}}}));
}

TEST(Record, drops_a_frame_of_the_very_step_of_the_checkpoint_that_came_behind_it) {
  const Scratch scratch;
  {
    Session run(scratch / "out");
    run.begin();
    run.step();
    run.record.save();
    run.frame("velocity");
  }
  Session again(scratch / "out", Session::How::resumed);
  again.begin();
  again.record.frame_anew();
  EXPECT_TRUE(frames_in(again.folder.record()).empty());
}

// ---- how it ends

TEST(Record, says_of_a_run_how_and_why_it_ended_and_is_then_one_file) {
  const Scratch scratch;
  Session run(scratch / "out");
  run.begin();
  EXPECT_EQ(run.summary().at("status"), "running");
  EXPECT_FALSE(run.summary().contains("exit_code"));
  run.step();
  run.frame("velocity");
  run.record.close("failed", ExitCode::physics, "the spring flew away");
  EXPECT_EQ(run.summary().at("status"), "failed");
  EXPECT_EQ(run.summary().at("exit_code"), 3);
  EXPECT_EQ(run.summary().at("exit_reason"), "the spring flew away");
  EXPECT_EQ(run.summary().at("steps"), 1);
  EXPECT_FALSE(fs::exists(run.folder.frames()));
  EXPECT_EQ(frames_in(run.folder.record()), (Frames{{1, {"velocity"}}}));
}

TEST(Record, keeps_the_last_step_where_the_machine_gives_out_between_two) {
  const Scratch scratch;
  Session run(scratch / "out");
  run.begin();
  run.step();
  run.record.rescue("no space left");
  EXPECT_EQ(run.saved_step(), 1);
  EXPECT_EQ(run.summary().at("status"), "failed");
  EXPECT_EQ(run.summary().at("exit_code"), 1);
  EXPECT_EQ(run.summary().at("exit_reason"),
            "no space left; the newest checkpoint is of step 1, go on with: beadwork run pair.xml --resume");
}

TEST(Record, saves_no_step_that_is_half_done) {
  const Scratch scratch;
  Session run(scratch / "out");
  run.begin();
  run.record.reserve_room();
  run.parts.state.phase = RunState::Phase::within_step;
  run.record.rescue("no space left");
  EXPECT_FALSE(fs::exists(run.folder.checkpoint()));
  EXPECT_FALSE(fs::exists(part_of(run.folder.checkpoint()))) << "the room that was held for it is free again";
  EXPECT_EQ(run.summary().at("exit_reason"), "no space left");
}

TEST(Record, leaves_what_a_run_said_of_its_end_where_a_resume_comes_to_nothing) {
  const Scratch scratch;
  {
    Session run(scratch / "out");
    run.begin();
    run.step();
    run.record.save();
    run.record.close("interrupted", ExitCode::interrupted, "interrupted at step 1");
  }
  const std::string said = text_of(scratch / "out/summary.json");
  {
    Session again(scratch / "out", Session::How::resumed);
    again.begin();
    EXPECT_EQ(again.summary().at("status"), "running");
    again.record.close("failed", ExitCode::deck, "this stage cannot begin");
    EXPECT_EQ(text_of(again.folder.summary()), said);
  }
  Session again(scratch / "out", Session::How::resumed);
  again.begin();
  again.step();
  again.record.close("failed", ExitCode::physics, "the spring flew away");
  EXPECT_EQ(again.summary().at("exit_reason"), "the spring flew away") << "it is this session that has ended";
}

TEST(Record, goes_on_with_the_deck_that_began_it_alone_and_changes_nothing_otherwise) {
  const Scratch scratch;
  be_killed_behind_the_checkpoint(scratch / "out");
  std::string stiffer = pulled_pair;
  stiffer.replace(stiffer.find("1 MPa"), 5, "2 MPa");
  Session again(scratch / "out", Session::How::resumed, stiffer);
  EXPECT_THAT(message_of<DeckFailure>([&] { again.record.load(); }), HasSubstr("young"));
  EXPECT_EQ(again.rows_of("twice").size(), 1u + 3u);
  EXPECT_EQ(frames_in(again.folder.record()).size(), 3u);
}

// ---- when it saves: by the clock that it is given

TEST(Record, saves_when_patience_ends_and_not_before) {
  const Scratch scratch;
  Session run(scratch / "out");
  run.begin();
  run.step();
  EXPECT_FALSE(run.record.save_now_and_then(run.not_before + 60s - 1ns));
  EXPECT_FALSE(fs::exists(run.folder.checkpoint()));
  EXPECT_TRUE(run.record.save_now_and_then(run.not_after + 60s)) << "the first one comes early";
  EXPECT_EQ(run.saved_step(), 1);
  run.step();
  const auto before = Session::Clock::now();
  run.record.save();
  const auto after = Session::Clock::now();
  run.step();
  EXPECT_FALSE(run.record.save_now_and_then(before + 600s - 1ns));
  EXPECT_EQ(run.saved_step(), 2);
  EXPECT_TRUE(run.record.save_now_and_then(after + 600s));
  EXPECT_EQ(run.saved_step(), 3);
}

TEST(Record, has_no_more_patience_for_the_first_checkpoint_than_for_the_others) {
  const Scratch scratch;
  Session run(scratch / "out");
  run.parts.options.checkpoint_seconds = 5;
  run.begin();
  EXPECT_FALSE(run.record.save_now_and_then(run.not_before + 5s - 1ns));
  EXPECT_TRUE(run.record.save_now_and_then(run.not_after + 5s));
}

TEST(Record, holds_the_room_of_the_next_checkpoint_until_it_ends) {
  const Scratch scratch;
  Session run(scratch / "out");
  run.begin();
  EXPECT_TRUE(run.record.save_now_and_then(run.not_after + 60s));
  EXPECT_GE(fs::file_size(part_of(run.folder.checkpoint())), fs::file_size(run.folder.checkpoint()));
  run.record.close("done", ExitCode::done, "");
  EXPECT_FALSE(fs::exists(part_of(run.folder.checkpoint())));
}

TEST(Record, tells_once_a_second_how_far_the_run_has_come) {
  const Scratch scratch;
  Session run(scratch / "out");
  std::vector<std::string> told;
  run.parts.options.progress = [&](const Headway& headway) { told.push_back(headway.detail); };
  run.begin();
  told.clear();  // what filling has told
  run.record.save_now_and_then(run.not_before + 1s - 1ns);
  EXPECT_TRUE(told.empty());
  run.step();
  const auto now = run.not_after + 1s;
  run.record.save_now_and_then(now);
  run.record.save_now_and_then(now + 1s - 1ns);
  EXPECT_THAT(told, ElementsAre(HasSubstr("step 1,")));
  run.record.save_now_and_then(now + 1s);
  EXPECT_EQ(told.size(), 2u);
}

}  // namespace
}  // namespace beadwork
