// The folder of a run: what is refused, what is removed, and what a full disk or a second run does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/run_folder.hpp"
#include "tests/support/scratch.hpp"

using namespace beadwork;
using namespace beadwork::testing;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

namespace {

/// Makes it look as if a run had been here.
void leave_a_run(const fs::path& root) {
  fs::create_directories(root / "curves");
  fs::create_directories(root / "frames");
  for (const char* name : {"summary.json", "resolved.xml", "run.h5", "run.xmf", "run.log", "checkpoint.h5",
                           "checkpoint.h5.part", "curves/force.csv", "curves/force.json", "frames/000000000100.h5"})
    write_text(root / name, "old");
}

}  // namespace

TEST(RunFolder, a_new_folder_is_made_with_those_above_it) {
  const Scratch scratch;
  const RunFolder folder = RunFolder::fresh(scratch / "a/b/out", false);
  EXPECT_TRUE(fs::is_directory(scratch / "a/b/out/curves"));
  write_atomically(folder.summary(), "{}");
  EXPECT_EQ(text_of(scratch / "a/b/out/summary.json"), "{}");
}

TEST(RunFolder, an_empty_folder_is_taken) {
  const Scratch scratch;
  fs::create_directory(scratch / "out");
  EXPECT_NO_THROW(RunFolder::fresh(scratch / "out", false));
}

TEST(RunFolder, a_folder_that_holds_a_run_is_refused_with_the_ways_out) {
  const Scratch scratch;
  leave_a_run(scratch / "out");
  const auto said = message_of<DeckFailure>([&] { RunFolder::fresh(scratch / "out", false); });
  EXPECT_THAT(said, HasSubstr((scratch / "out").string()));
  EXPECT_THAT(said, HasSubstr("--overwrite"));
  EXPECT_THAT(said, HasSubstr("--resume"));
  EXPECT_EQ(text_of(scratch / "out/run.h5"), "old");
}

TEST(RunFolder, a_run_that_was_killed_before_its_summary_counts_as_a_run) {
  const Scratch scratch;
  fs::create_directories(scratch / "out/curves");
  write_text(scratch / "out/resolved.xml", "old");
  EXPECT_THROW(RunFolder::fresh(scratch / "out", false), DeckFailure);
  EXPECT_NO_THROW(RunFolder::fresh(scratch / "out", true));
}

TEST(RunFolder, overwrite_removes_what_a_run_writes_and_nothing_else) {
  const Scratch scratch;
  leave_a_run(scratch / "out");
  for (const char* name : {"notes.txt", "curves/mine.py", "frames/movie.mp4"}) write_text(scratch / "out" / name, "mine");
  const RunFolder folder = RunFolder::fresh(scratch / "out", true);
  std::vector<std::string> left;
  for (const auto& entry : fs::recursive_directory_iterator(folder.root()))
    if (!entry.is_directory()) left.push_back(fs::relative(entry.path(), folder.root()).string());
  EXPECT_THAT(left, ::testing::UnorderedElementsAre("notes.txt", "curves/mine.py", "frames/movie.mp4"));
}

TEST(RunFolder, a_folder_with_other_files_is_never_wiped) {
  const Scratch scratch;
  fs::create_directory(scratch / "home");
  write_text(scratch / "home/thesis.tex", "years of work");
  for (const bool overwrite : {false, true}) {
    const auto said = message_of<DeckFailure>([&] { RunFolder::fresh(scratch / "home", overwrite); });
    EXPECT_THAT(said, HasSubstr("thesis.tex"));
  }
  EXPECT_EQ(text_of(scratch / "home/thesis.tex"), "years of work");
}

TEST(RunFolder, overwriting_follows_no_link_out_of_the_folder) {
  const Scratch scratch;
  fs::create_directories(scratch / "out");
  fs::create_directories(scratch / "elsewhere");
  write_text(scratch / "out/summary.json", "old");
  write_text(scratch / "elsewhere/precious.csv", "precious");
  fs::create_directory_symlink(scratch / "elsewhere", scratch / "out/curves");
  RunFolder::fresh(scratch / "out", true);
  EXPECT_EQ(text_of(scratch / "elsewhere/precious.csv"), "precious");
}

TEST(RunFolder, a_file_in_its_place_is_refused) {
  const Scratch scratch;
  write_text(scratch / "out", "a file");
  EXPECT_THAT(message_of<DeckFailure>([&] { RunFolder::fresh(scratch / "out", true); }), HasSubstr("is a file"));
}

TEST(RunFolder, two_runs_cannot_write_one_folder) {
  const Scratch scratch;
  const auto first = std::make_unique<RunFolder>(RunFolder::fresh(scratch / "out", false));
  const auto said = message_of<DeckFailure>([&] { RunFolder::fresh(scratch / "out", true); });
  EXPECT_THAT(said, HasSubstr("another run"));
}

TEST(RunFolder, a_run_that_ended_lets_go_of_its_folder) {
  const Scratch scratch;
  { RunFolder::fresh(scratch / "out", false); }
  write_text(scratch / "out/checkpoint.h5", "saved");
  EXPECT_NO_THROW(RunFolder::resume(scratch / "out"));
}

TEST(RunFolder, a_killed_run_lets_go_of_its_folder) {
  const Scratch scratch;
  write_text(scratch / "unused", "");
  kill_during(
      [&] {
        const RunFolder folder = RunFolder::fresh(scratch / "out", false);
        write_text(folder.checkpoint(), "saved");
        ::sleep(10);
      },
      200000);
  EXPECT_NO_THROW(RunFolder::resume(scratch / "out"));
}

TEST(RunFolder, resuming_wants_a_checkpoint_and_says_so) {
  const Scratch scratch;
  EXPECT_THAT(message_of<DeckFailure>([&] { RunFolder::resume(scratch / "nowhere"); }), HasSubstr("no folder"));
  fs::create_directory(scratch / "out");
  EXPECT_THAT(message_of<DeckFailure>([&] { RunFolder::resume(scratch / "out"); }), HasSubstr("no checkpoint.h5"));
}

TEST(RunFolder, resuming_clears_what_a_kill_left_half_written) {
  const Scratch scratch;
  leave_a_run(scratch / "out");
  const RunFolder folder = RunFolder::resume(scratch / "out");
  EXPECT_FALSE(fs::exists(scratch / "out/checkpoint.h5.part"));
  EXPECT_EQ(text_of(folder.checkpoint()), "old");
}

TEST(RunFolder, a_folder_that_cannot_be_made_is_the_machines_fault_in_the_systems_words) {
  const Scratch scratch;
  write_text(scratch / "file", "");
  const auto said = message_of<MachineFailure>([&] { RunFolder::fresh(scratch / "file/out", false); });
  EXPECT_THAT(said, HasSubstr("Not a directory"));
  EXPECT_THAT(said, HasSubstr((scratch / "file/out").string()));
}

TEST(RunFolder, a_folder_that_may_not_be_written_is_named_with_the_remedy) {
  const Scratch scratch;
  const SmallDisk disk(1 << 20);
  if (!disk.there()) GTEST_SKIP() << "only root may mount a disk that is read-only";
  ASSERT_EQ(::mount("none", disk.path().c_str(), "tmpfs", MS_REMOUNT | MS_RDONLY, nullptr), 0);
  const auto said = message_of<MachineFailure>([&] { RunFolder::fresh(disk.path() / "out", false); });
  EXPECT_THAT(said, HasSubstr("Read-only file system"));
  EXPECT_THAT(said, HasSubstr("Choose a folder"));
}

TEST(RunFolder, a_full_disk_leaves_the_old_text_whole_and_is_named) {
  const SmallDisk disk(1 << 20);
  if (!disk.there()) GTEST_SKIP() << "only root may mount a small disk";
  const fs::path file = disk.path() / "summary.json";
  write_atomically(file, "old");
  const std::string large(2 << 20, 'x');
  const auto said = message_of<MachineFailure>([&] { write_atomically(file, large); });
  EXPECT_THAT(said, HasSubstr("No space left on device"));
  EXPECT_THAT(said, HasSubstr(file.string()));
  EXPECT_EQ(text_of(file), "old");
  EXPECT_FALSE(fs::exists(part_of(file)));
}
