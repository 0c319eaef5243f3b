// The folder of a run: what is refused, what is removed, and what a full disk or a second run does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/stat.h>

#include "core/io/run_folder.hpp"
#include "tests/support/scratch.hpp"

using namespace beadwork;
using namespace beadwork::testing;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

namespace {

/// What a run leaves: its files, each on its list.
void leave_a_run(const fs::path& root) {
  RunFolder folder = RunFolder::fresh(root, false);
  for (const char* name : {"curves/force.csv", "curves/force.json", "frames/000000000100.h5"})
    folder.claim(root / name);
  for (const char* name : {"summary.json", "resolved.xml", "run.h5", "run.xmf", "run.log", "checkpoint.h5",
                           "checkpoint.h5.part", "curves/force.csv", "curves/force.json", "frames/000000000100.h5"})
    write_text(root / name, "old");
}

std::vector<std::string> files_below(const fs::path& root) {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(root))
    if (!entry.is_directory()) files.push_back(fs::relative(entry.path(), root).string());
  return files;
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
  { RunFolder::fresh(scratch / "out", false); }
  EXPECT_THROW(RunFolder::fresh(scratch / "out", false), DeckFailure);
  EXPECT_NO_THROW(RunFolder::fresh(scratch / "out", true));
}

TEST(RunFolder, overwrite_removes_what_the_run_made_and_nothing_else) {
  const Scratch scratch;
  leave_a_run(scratch / "out");
  const std::vector<std::string> others = {"notes.txt",           "run.h5.bak",          "report.html",
                                           "curves/mine.py",      "curves/measured.csv", "curves/measured.json",
                                           "curves/old.csv.part", "frames/movie.mp4",    "frames/000000000200.h5"};
  for (const std::string& name : others) write_text(scratch / "out" / name, "mine");
  RunFolder folder = RunFolder::fresh(scratch / "out", true);
  write_text(folder.log(), "new");
  EXPECT_EQ(text_of(scratch / "out/run.h5"), "old") << "it stands until the new one takes over";
  EXPECT_EQ(text_of(scratch / "out/run.log"), "old");
  folder.take_over();
  EXPECT_EQ(text_of(folder.log()), "new");
  auto expected = others;
  expected.push_back("run.log");
  expected.push_back(Manifest::file_name);
  EXPECT_THAT(files_below(folder.root()), ::testing::UnorderedElementsAreArray(expected));
  for (const std::string& name : others) EXPECT_EQ(text_of(scratch / "out" / name), "mine") << name;
}

TEST(RunFolder, curves_of_somebody_else_are_no_run) {
  const Scratch scratch;
  fs::create_directories(scratch / "out/curves");
  write_text(scratch / "out/curves/measured.csv", "step [1],time [s]\n1,2\n");
  for (const bool overwrite : {false, true})
    EXPECT_THAT(message_of<DeckFailure>([&] { RunFolder::fresh(scratch / "out", overwrite); }),
                HasSubstr("holds no run"));
  EXPECT_EQ(text_of(scratch / "out/curves/measured.csv"), "step [1],time [s]\n1,2\n");
}

TEST(RunFolder, a_file_in_the_way_of_a_run_is_left_alone_and_named) {
  const Scratch scratch;
  leave_a_run(scratch / "out");
  write_text(scratch / "out/curves/measured.csv", "mine");
  RunFolder folder = RunFolder::fresh(scratch / "out", true);
  EXPECT_THROW(folder.claim(folder.curve("force")), std::logic_error) << "the former run still stands";
  folder.take_over();
  EXPECT_THAT(message_of<DeckFailure>([&] { folder.claim(folder.curve("measured")); }),
              HasSubstr("curves/measured.csv"));
  EXPECT_NO_THROW(folder.claim(folder.curve("force")));
  for (const std::string name : {"../summary", "../../elsewhere", "a/b", "line\nbreak", "/etc/passwd"})
    EXPECT_THROW(folder.claim(folder.curve(name)), DeckFailure) << name;
}

TEST(RunFolder, a_file_is_listed_before_it_can_be_made) {
  const Scratch scratch;
  leave_a_run(scratch / "out");
  {
    RunFolder folder = RunFolder::resume(scratch / "out");
    folder.claim(folder.curve("second"));  // and then the power is cut
  }
  EXPECT_TRUE(Manifest::read(scratch / "out")->lists("curves/second.csv"));
  write_text(scratch / "out/curves/second.csv", "old");
  RunFolder::fresh(scratch / "out", true).take_over();
  EXPECT_FALSE(fs::exists(scratch / "out/curves/second.csv"));
}

TEST(RunFolder, a_torn_line_of_the_list_names_nothing) {
  const Scratch scratch;
  leave_a_run(scratch / "out");
  write_text(scratch / "out/curves/f", "mine");
  const std::string list = text_of(scratch / "out" / Manifest::file_name);
  write_text(scratch / "out" / Manifest::file_name, list + "curves/f");
  {
    RunFolder folder = RunFolder::resume(scratch / "out");
    folder.claim(folder.curve("second"));
  }
  EXPECT_EQ(text_of(scratch / "out" / Manifest::file_name), list + "curves/second.csv\n");
}

TEST(RunFolder, a_damaged_list_leads_to_no_file_outside) {
  const Scratch scratch;
  leave_a_run(scratch / "out");
  write_text(scratch / "precious", "precious");
  const std::string list = text_of(scratch / "out" / Manifest::file_name);
  write_text(scratch / "out" / Manifest::file_name,
             list + "../precious\ncurves/../../precious\n" + (scratch / "precious").string() + "\nframes/..\n");
  RunFolder::fresh(scratch / "out", true);
  EXPECT_EQ(text_of(scratch / "precious"), "precious");
}

TEST(RunFolder, a_run_that_kept_no_list_is_refused_with_the_reason) {
  const Scratch scratch;
  leave_a_run(scratch / "out");
  fs::remove(scratch / "out" / Manifest::file_name);
  const auto expect_refusal = [](const std::string& said) {
    EXPECT_THAT(said, HasSubstr("kept no list of its files"));
  };
  expect_refusal(message_of<DeckFailure>([&] { RunFolder::fresh(scratch / "out", true); }));
  expect_refusal(message_of<DeckFailure>([&] { RunFolder::resume(scratch / "out"); }));
  EXPECT_EQ(text_of(scratch / "out/curves/force.csv"), "old");
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
  leave_a_run(scratch / "out");
  fs::create_directories(scratch / "elsewhere");
  write_text(scratch / "elsewhere/force.csv", "precious");
  fs::remove_all(scratch / "out/curves");
  fs::create_directory_symlink(scratch / "elsewhere", scratch / "out/curves");
  EXPECT_THAT(message_of<DeckFailure>([&] { RunFolder::fresh(scratch / "out", true).take_over(); }),
              HasSubstr("out/curves"));
  EXPECT_EQ(text_of(scratch / "elsewhere/force.csv"), "precious");
  EXPECT_EQ(text_of(scratch / "out/checkpoint.h5"), "old");
}

TEST(RunFolder, writing_follows_no_link_and_waits_for_no_pipe) {
  const Scratch scratch;
  write_text(scratch / "precious", "precious");
  fs::create_symlink(scratch / "precious", scratch / "report.html");
  write_atomically(scratch / "report.html", "new");  // takes the link's place
  EXPECT_EQ(text_of(scratch / "report.html"), "new");
  fs::create_symlink(scratch / "precious", scratch / "summary.json.part");
  EXPECT_THAT(message_of<MachineFailure>([&] { write_atomically(scratch / "summary.json", "new"); }),
              HasSubstr("it is a link"));
  ASSERT_EQ(::mkfifo((scratch / "run.log").c_str(), 0600), 0);
  EXPECT_THAT(message_of<MachineFailure>([&] { read_text(scratch / "run.log", 100); }), HasSubstr("it is a pipe"));
  EXPECT_THAT(message_of<MachineFailure>([&] { overwrite(scratch / "run.log", "x"); }), HasSubstr("it is a pipe"));
  fs::create_symlink(scratch / "precious", scratch / "deck.xml");
  EXPECT_THAT(message_of<MachineFailure>([&] { read_text(scratch / "deck.xml", 100); }), HasSubstr("it is a link"));
  EXPECT_THAT(message_of<MachineFailure>([&] { read_text(scratch.path(), 100); }), HasSubstr("it is a folder"));
  EXPECT_EQ(text_of(scratch / "precious"), "precious");
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
  ASSERT_TRUE(is_killed([&] {
    const RunFolder folder = RunFolder::fresh(scratch / "out", false);
    write_text(folder.checkpoint(), "saved");
    ::kill(::getpid(), SIGKILL);
  }));
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
  write_text(scratch / "out/curves/mine.csv.part", "mine");
  const RunFolder folder = RunFolder::resume(scratch / "out");
  EXPECT_TRUE(fs::exists(scratch / "out/checkpoint.h5.part")) << "nothing is changed before all is known to be right";
  folder.clear_leftovers();
  EXPECT_FALSE(fs::exists(scratch / "out/checkpoint.h5.part"));
  EXPECT_EQ(text_of(scratch / "out/curves/mine.csv.part"), "mine");
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
