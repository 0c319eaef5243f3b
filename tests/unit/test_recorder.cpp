// The record of a run: what a frame holds, and that run.h5 can be read at any moment, whatever stopped the run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <cmath>
#include <sstream>

#include "core/io/frame_reader.hpp"
#include "core/io/recorder.hpp"
#include "tests/support/bonded_bar.hpp"
#include "tests/support/dataset.hpp"
#include "tests/support/scratch.hpp"

using namespace beadwork;
using namespace beadwork::testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

namespace {

const RunMeta about_the_run = {.name = "bar",
                               .deck = "<scene/>",
                               .resolved = "<scene resolved=\"yes\"/>",
                               .deck_sha256 = "5e88",
                               .overrides = {},
                               .files = {},
                               .version = "0.1.0",
                               .plugins = {"bond/spring 0.1.0 lib.so"},
                               .threads = 2,
                               .seed = 7,
                               .packing = "{\"Z\": 6.2}"};

/// A run that records a bar, as the loop does.
struct Recording {
  RunFolder folder;
  Domain domain;
  Recorder recorder;

  explicit Recording(const fs::path& root, Index count = 200)
      : folder(RunFolder::fresh(root, true)),
        recorder((declare_bar(domain), fill_bar(domain, count), Recorder::fresh(folder, about_the_run, domain))) {}

  FrameRequest request() {
    const BondTable& resin = *domain.families()[0];
    return {{&domain.elements().column("velocity"), &domain.elements().column("orientation")},
            {{&resin, "cohesive-beam", {&resin.rows().column("damage"), &resin.rows().column("stretch")}}},
            false};
  }
  void frame(std::int64_t step) { recorder.write({step, 1e-7 * static_cast<Real>(step), 0}, request(), domain); }
  void go_on_from(std::int64_t step) {
    auto& breaks = domain.breaks().breaks;
    std::erase_if(breaks, [&](const Break& b) { return b.step > step; });
    recorder = Recorder::resume(folder, about_the_run, domain, step);
  }
};

std::vector<std::int64_t> steps_of(const fs::path& record) {
  std::vector<std::int64_t> steps;
  const record::FrameReader reader(record);
  EXPECT_EQ(reader.unreadable_frames(), 0);
  for (const record::FrameHead& head : reader.frames()) {
    EXPECT_NO_THROW(reader.read(head)) << head.name;
    steps.push_back(head.step);
  }
  return steps;
}

/// Name and extent of every dataset that a view for ParaView cites.
std::vector<std::pair<std::string, std::vector<std::size_t>>> items_of(const std::string& view) {
  const std::string dimensions = "<DataItem Dimensions=\"", file = ">run.h5:";
  std::vector<std::pair<std::string, std::vector<std::size_t>>> items;
  for (auto at = view.find(dimensions); at != std::string::npos; at = view.find(dimensions, at + 1)) {
    std::istringstream numbers(view.substr(at + dimensions.size(), 40));
    std::vector<std::size_t> extent;
    for (std::size_t number; numbers >> number;) extent.push_back(number);
    const auto name = view.find(file, at) + file.size();
    items.push_back({view.substr(name, view.find('<', name) - name), extent});
  }
  return items;
}

fs::path folder_of(const Recording& run, const std::string& name) { return run.folder.root() / name; }

}  // namespace

TEST(Recorder, a_record_says_what_was_run_before_it_has_a_frame) {
  const Scratch scratch;
  const Recording run(scratch / "out");
  EXPECT_EQ(read_dataset_text(run.folder.record(), "meta/deck"), "<scene/>");
  EXPECT_EQ(read_dataset_text(run.folder.record(), "meta/plugins"), "bond/spring 0.1.0 lib.so");
  EXPECT_EQ(read_dataset_text(run.folder.record(), "meta/packing"), "{\"Z\": 6.2}");
  EXPECT_TRUE(steps_of(run.folder.record()).empty());
  EXPECT_FALSE(fs::exists(run.folder.view()));  // ParaView cannot open a series of nothing
}

TEST(Recorder, a_frame_holds_the_columns_that_were_asked_for_with_their_units) {
  const Scratch scratch;
  Recording run(scratch / "out");
  run.frame(300);
  const auto velocity = read_dataset(run.folder.record(), "frames/000000000300/elements/velocity");
  EXPECT_THAT(velocity.extent, ElementsAre(200u, 3u));
  EXPECT_EQ(velocity.unit, "m/s");
  EXPECT_EQ(velocity.long_name, "Velocity of the centre");
  const auto stretched = read_dataset(run.folder.record(), "frames/000000000300/bonds/resin/stretch");
  EXPECT_THAT(stretched.extent, ElementsAre(199u, 3u));
  const auto expected_velocity = run.domain.elements().column("velocity").view<Vec3>();
  const auto expected_stretch = run.domain.families()[0]->rows().column("stretch").view<Vec3>();
  for (Index row = 0; row < 199; ++row)
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(velocity.numbers[static_cast<std::size_t>(3 * row + c)], expected_velocity.at(row, c));
      EXPECT_EQ(stretched.numbers[static_cast<std::size_t>(3 * row + c)], expected_stretch.at(row, c));
    }
  EXPECT_THROW(read_dataset(run.folder.record(), "frames/000000000300/elements/force"), std::runtime_error);
  EXPECT_THROW(read_dataset(run.folder.record(), "frames/000000000300/bonds/interface/id"), std::runtime_error);
}

TEST(Recorder, the_report_reads_what_was_recorded) {
  const Scratch scratch;
  Recording run(scratch / "out");
  break_some(run.domain, 0, 50, 90);
  FrameRequest request = run.request();
  request.picture = true;
  run.recorder.write({100, 2e-6, 1}, request, run.domain);
  const record::FrameReader reader(run.folder.record());
  ASSERT_EQ(reader.frames().size(), 1u);
  EXPECT_EQ(reader.frames()[0].time, 2e-6);
  EXPECT_TRUE(reader.frames()[0].picture);
  const record::Frame frame = reader.read(reader.frames()[0]);
  ASSERT_EQ(frame.bonds.size(), 1u);
  EXPECT_EQ(frame.bonds[0].law, "cohesive-beam");
  EXPECT_EQ(frame.bonds[0].state[0], State::broken);
  EXPECT_EQ(frame.bonds[0].state[3], State::softening);
  EXPECT_EQ(frame.bonds[0].ends[5][1], 6);
  EXPECT_EQ(frame.radius[9], 0.5e-3 + 9e-5);
  EXPECT_EQ(reader.sets().at("left").size(), 20u);
  EXPECT_EQ(reader.breaks().time.size(), 4u);
  EXPECT_EQ(reader.breaks().mode[0], "shear");
}

TEST(Recorder, two_requests_in_one_step_make_one_frame_with_the_columns_of_both) {
  const Scratch scratch;
  Recording run(scratch / "out");
  const BondTable& other = *run.domain.families()[1];
  run.recorder.write({100, 1e-6, 0}, {{&run.domain.elements().column("velocity")}, {}, true}, run.domain);
  run.recorder.write({100, 1e-6, 0}, {{&run.domain.elements().column("force")}, {{&other, "", {}}}, false}, run.domain);
  EXPECT_THAT(steps_of(run.folder.record()), ElementsAre(100));
  for (const char* name : {"elements/velocity", "elements/force", "bonds/interface/state"})
    EXPECT_NO_THROW(read_dataset(run.folder.record(), std::string("frames/000000000100/") + name)) << name;
  EXPECT_TRUE(record::FrameReader(run.folder.record()).frames()[0].picture);
}

TEST(Recorder, a_finished_record_is_one_file_that_needs_no_other) {
  const Scratch scratch;
  Recording run(scratch / "out");
  for (const int step : {0, 100, 200}) run.frame(step);
  std::string reason;
  ASSERT_TRUE(run.recorder.consolidate(run.domain, reason)) << reason;
  EXPECT_FALSE(fs::exists(run.folder.frames()));
  fs::rename(run.folder.record(), scratch / "elsewhere.h5");
  EXPECT_THAT(steps_of(scratch / "elsewhere.h5"), ElementsAre(0, 100, 200));
  EXPECT_EQ(read_dataset_text(scratch / "elsewhere.h5", "meta/name"), "bar");
  EXPECT_THROW(run.frame(300), std::logic_error);
}

TEST(Recorder, a_resumed_record_drops_the_frames_after_the_checkpoint) {
  const Scratch scratch;
  Recording run(scratch / "out");
  for (const int step : {0, 100, 200, 300}) run.frame(step);
  run.go_on_from(150);
  EXPECT_THAT(steps_of(run.folder.record()), ElementsAre(0, 100));
  EXPECT_FALSE(fs::exists(folder_of(run, "frames/000000000300.h5")));
  run.frame(200);
  EXPECT_THAT(steps_of(run.folder.record()), ElementsAre(0, 100, 200));
}

TEST(Recorder, a_resumed_record_drops_the_breaks_after_the_checkpoint) {
  const Scratch scratch;
  Recording run(scratch / "out");
  break_some(run.domain, 0, 50, 90);
  break_some(run.domain, 0, 30, 190);
  run.frame(200);
  ASSERT_GT(record::FrameReader(run.folder.record()).breaks().time.size(), 4u);
  run.go_on_from(100);
  EXPECT_EQ(record::FrameReader(run.folder.record()).breaks().time.size(), 4u);
}

TEST(Recorder, a_finished_record_can_be_continued_without_copying_it) {
  const Scratch scratch;
  Recording run(scratch / "out");
  for (const int step : {0, 100, 200}) run.frame(step);
  std::string reason;
  ASSERT_TRUE(run.recorder.consolidate(run.domain, reason));
  const auto size = fs::file_size(run.folder.record());
  run.go_on_from(100);
  EXPECT_THAT(steps_of(run.folder.record()), ElementsAre(0, 100));
  EXPECT_EQ(fs::file_size(folder_of(run, "frames/consolidated-0.h5")), size);
  EXPECT_LT(fs::file_size(run.folder.record()), size / 2);
  run.frame(200);
  run.frame(300);
  EXPECT_THAT(steps_of(run.folder.record()), ElementsAre(0, 100, 200, 300));
  ASSERT_TRUE(run.recorder.consolidate(run.domain, reason)) << reason;
  EXPECT_FALSE(fs::exists(run.folder.frames()));
  EXPECT_THAT(steps_of(run.folder.record()), ElementsAre(0, 100, 200, 300));
}

TEST(Recorder, a_record_can_be_finished_and_continued_again_and_again) {
  const Scratch scratch;
  Recording run(scratch / "out");
  std::vector<std::int64_t> expected;
  for (std::int64_t step = 0; step < 500; step += 100) {
    run.frame(step);
    expected.push_back(step);
    if (step % 200 == 0) {
      std::string reason;
      ASSERT_TRUE(run.recorder.consolidate(run.domain, reason)) << reason;
    }
    run.go_on_from(step);
    EXPECT_EQ(steps_of(run.folder.record()), expected);
  }
}

TEST(Recorder, the_log_of_breaks_is_up_to_date_without_a_frame) {
  const Scratch scratch;
  Recording run(scratch / "out");
  run.frame(0);
  break_some(run.domain, 1, 40, 90);
  run.recorder.write_breaks(run.domain);
  EXPECT_EQ(record::FrameReader(run.folder.record()).breaks().time.size(), 3u);
  EXPECT_THAT(read_dataset(run.folder.record(), "breaks/family").numbers, ElementsAre(1, 1, 1));  // the interface
  EXPECT_EQ(read_dataset(run.folder.record(), "breaks/energy").unit, "J");
  EXPECT_THAT(read_dataset(run.folder.record(), "breaks/place").extent, ElementsAre(3u, 3u));
}

TEST(Recorder, the_view_for_paraview_names_datasets_that_are_there_with_their_extents) {
  const Scratch scratch;
  Recording run(scratch / "out");
  run.frame(0);
  run.frame(100);
  std::string reason;
  for (const bool finished : {false, true}) {
    if (finished) {
      ASSERT_TRUE(run.recorder.consolidate(run.domain, reason)) << reason;
    }
    int count = 0;
    for (const auto& [name, extent] : items_of(text_of(run.folder.view()))) {
      EXPECT_EQ(read_dataset(run.folder.record(), name).extent, extent) << name;
      ++count;
    }
    EXPECT_EQ(count, 2 * (5 + 6));  // two frames: five columns on elements; five on bonds and their centres
  }
}

TEST(Recorder, a_symmetric_tensor_has_six_numbers_in_the_file_and_is_a_tensor_in_the_view) {
  const Scratch scratch;
  Recording run(scratch / "out");
  Column& stress = run.domain.elements().add({"stress", On::elements, Type::sym3, "Pa", "Stress", ""});
  stress.view<Sym3>().set(7, {1, 2, 3, 4, 5, 6});
  run.recorder.write({0, 0, 0}, {{&stress}, {}, false}, run.domain);
  const auto written = read_dataset(run.folder.record(), "frames/000000000000/elements/stress");
  EXPECT_THAT(written.extent, ElementsAre(200u, 6u));
  EXPECT_EQ(written.unit, "Pa");
  for (std::size_t c = 0; c < 6; ++c) EXPECT_EQ(written.numbers[6 * 7 + c], static_cast<Real>(c + 1));
  EXPECT_THAT(text_of(run.folder.view()),
              HasSubstr("<Attribute Name=\"stress\" AttributeType=\"Tensor6\" Center=\"Node\">"
                        "<DataItem Dimensions=\"200 6\""));
}

TEST(Recorder, a_family_without_bonds_is_recorded_and_left_out_of_the_view) {
  const Scratch scratch;
  Recording run(scratch / "out");
  const BondTable& later = run.domain.add_family("later");
  run.recorder.write({0, 0, 0}, {{}, {{&later, "", {}}}, false}, run.domain);
  EXPECT_THAT(read_dataset(run.folder.record(), "frames/000000000000/bonds/later/ends").extent, ElementsAre(0u, 2u));
  EXPECT_THAT(text_of(run.folder.view()), ::testing::Not(HasSubstr("later")));
}

// A kill while the files of a former run.h5 are removed leaves some of them, whichever.
TEST(Recorder, goes_on_from_a_whole_record_beside_which_an_older_one_was_left) {
  const Scratch scratch;
  Recording run(scratch / "out");
  std::string reason;
  run.frame(0);
  ASSERT_TRUE(run.recorder.consolidate(run.domain, reason)) << reason;
  run.go_on_from(0);
  const fs::path older = scratch / "older.h5";
  fs::copy_file(folder_of(run, "frames/consolidated-0.h5"), older);
  run.frame(100);
  ASSERT_TRUE(run.recorder.consolidate(run.domain, reason)) << reason;
  fs::create_directory(run.folder.frames());
  run.folder.claim(folder_of(run, "frames/consolidated-1.h5"));
  fs::copy_file(older, folder_of(run, "frames/consolidated-1.h5"));
  run.go_on_from(100);
  EXPECT_THAT(steps_of(run.folder.record()), ElementsAre(0, 100));
}

TEST(Recorder, a_kill_at_any_moment_leaves_a_record_that_can_be_read_and_continued) {
  const Scratch scratch;
  Recording run(scratch / "out", 3000);
  std::int64_t newest = 0;
  run.frame(newest);
  // On a slow machine the first kills come before anything is written: go on until some have come in the midst of it.
  for (unsigned trial = 0; trial < 30 || newest < 6; ++trial) {
    kill_during(
        [&] {
          run.go_on_from(newest);
          std::string reason;
          for (std::int64_t step = newest + 1;; ++step) {
            run.frame(step);
            if (step % 3 != 0) continue;
            run.recorder.consolidate(run.domain, reason);
            run.go_on_from(step);
          }
        },
        5000 + 4000 * trial);
    const auto steps = steps_of(run.folder.record());
    ASSERT_GE(steps.size(), static_cast<std::size_t>(newest) + 1) << "trial " << trial;
    for (std::size_t i = 0; i < steps.size(); ++i)
      ASSERT_EQ(steps[i], static_cast<std::int64_t>(i)) << "trial " << trial;
    newest = steps.back();
  }
}

TEST(Recorder, a_full_disk_is_named_and_leaves_the_frames_before) {
  const SmallDisk disk(4 << 20);
  if (!disk.there()) GTEST_SKIP() << "only root may mount a small disk";
  Recording run(disk.path() / "out", 3000);
  run.frame(0);
  disk.fill_but(50000);
  const auto said = message_of<MachineFailure>([&] { run.frame(100); });
  EXPECT_THAT(said, HasSubstr("No space left on device"));
  EXPECT_THAT(said, HasSubstr("000000000100.h5"));
  EXPECT_THAT(steps_of(run.folder.record()), ElementsAre(0));
}

TEST(Recorder, a_disk_too_full_for_one_file_leaves_the_linked_frames) {
  int finished = 0, left = 0;
  for (std::size_t free = 100000; free < 4000000; free += 200000) {
    const SmallDisk disk(6 << 20);
    if (!disk.there()) GTEST_SKIP() << "only root may mount a small disk";
    Recording run(disk.path() / "out", 3000);
    for (const int step : {0, 100, 200}) run.frame(step);
    disk.fill_but(free);
    std::string reason;
    const bool done = run.recorder.consolidate(run.domain, reason);
    ++(done ? finished : left);
    if (!done) {
      EXPECT_THAT(reason, HasSubstr("No space left on device"));
    }
    EXPECT_EQ(fs::exists(run.folder.frames()), !done);
    EXPECT_THAT(steps_of(run.folder.record()), ElementsAre(0, 100, 200)) << free << " bytes free";
  }
  EXPECT_GT(finished, 3);
  EXPECT_GT(left, 3);
}

TEST(Recorder, what_could_not_be_made_one_file_can_be_once_there_is_room) {
  const SmallDisk disk(6 << 20);
  if (!disk.there()) GTEST_SKIP() << "only root may mount a small disk";
  Recording run(disk.path() / "out", 3000);
  for (const int step : {0, 100, 200}) run.frame(step);
  disk.fill_but(300000);
  std::string reason;
  EXPECT_FALSE(run.recorder.consolidate(run.domain, reason));
  fs::remove(disk.path() / "filler");
  EXPECT_TRUE(run.recorder.consolidate(run.domain, reason)) << reason;
  EXPECT_THAT(steps_of(run.folder.record()), ElementsAre(0, 100, 200));
}

TEST(Recorder, a_damaged_frame_is_kept_aside_and_the_run_goes_on) {
  const Scratch scratch;
  Recording run(scratch / "out");
  for (const int step : {0, 100}) run.frame(step);
  write_text(folder_of(run, "frames/000000000000.h5"), "not a frame");
  run.go_on_from(100);
  EXPECT_THAT(run.recorder.notes(), ElementsAre(HasSubstr("frames/000000000000.h5 is damaged")));
  EXPECT_EQ(text_of(folder_of(run, "frames/000000000000.h5.damaged")), "not a frame");
  EXPECT_THAT(steps_of(run.folder.record()), ElementsAre(100));
}

TEST(Recorder, a_damaged_record_is_kept_aside_and_a_new_one_begun) {
  for (const bool finished : {false, true}) {
    const Scratch scratch;
    Recording run(scratch / "out");
    for (const int step : {0, 100}) run.frame(step);
    std::string reason;
    if (finished) {
      ASSERT_TRUE(run.recorder.consolidate(run.domain, reason));
    }
    fs::resize_file(run.folder.record(), 1500);
    const std::string damaged = text_of(run.folder.record());
    run.go_on_from(100);
    EXPECT_THAT(run.recorder.notes(), ElementsAre(HasSubstr("run.h5 is damaged")));
    EXPECT_EQ(text_of(folder_of(run, "run.h5.damaged")), damaged);
    if (finished)
      EXPECT_THAT(steps_of(run.folder.record()), ElementsAre());
    else
      EXPECT_THAT(steps_of(run.folder.record()), ElementsAre(0, 100));
    run.frame(200);
    ASSERT_TRUE(run.recorder.consolidate(run.domain, reason)) << reason;
    EXPECT_EQ(steps_of(run.folder.record()).back(), 200);
  }
}

TEST(Recorder, files_of_others_among_the_frames_are_neither_taken_nor_removed) {
  const Scratch scratch;
  Recording run(scratch / "out");
  for (const int step : {0, 100}) run.frame(step);
  for (const char* name : {"frames/000000000050.h5", "frames/000000000300.h5", "frames/consolidated-7.h5"})
    write_text(folder_of(run, name), "mine");
  run.go_on_from(100);
  EXPECT_TRUE(run.recorder.notes().empty());
  std::string reason;
  ASSERT_TRUE(run.recorder.consolidate(run.domain, reason)) << reason;
  EXPECT_THAT(steps_of(run.folder.record()), ElementsAre(0, 100));
  for (const char* name : {"frames/000000000050.h5", "frames/000000000300.h5", "frames/consolidated-7.h5"})
    EXPECT_EQ(text_of(folder_of(run, name)), "mine");
}

TEST(Recorder, a_record_leads_to_no_file_but_its_own_frames) {
  const Scratch scratch;
  Recording other(scratch / "other"), run(scratch / "out");
  for (const int step : {0, 100}) run.frame(step), other.frame(step);
  fs::remove(folder_of(run, "frames/000000000000.h5"));
  fs::create_symlink(folder_of(other, "frames/000000000000.h5"), folder_of(run, "frames/000000000000.h5"));
  fs::remove(folder_of(run, "frames/000000000100.h5"));
  ASSERT_EQ(::mkfifo(folder_of(run, "frames/000000000100.h5").c_str(), 0600), 0);
  const record::FrameReader reader(run.folder.record());
  EXPECT_TRUE(reader.frames().empty());
  EXPECT_EQ(reader.unreadable_frames(), 2);
}
