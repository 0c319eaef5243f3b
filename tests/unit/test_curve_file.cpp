// A curve of a run: numbers that read back to the bit, and what a kill, a restart and a full disk leave of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "core/io/curve_file.hpp"
#include "tests/support/scratch.hpp"

using namespace beadwork;
using namespace beadwork::testing;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

namespace {

const std::vector<CurveColumn> time_and_force = {{"time", "s"}, {"force", "N"}};
const std::string time_and_force_line = "step [1],time [s],force [N]";

CurveFile fresh_curve(const fs::path& file) { return CurveFile::fresh(file, time_and_force); }

void add(CurveFile& curve, std::int64_t step, Real time, Real force) {
  const Real values[] = {time, force};
  curve.add(step, values);
}

}  // namespace

TEST(CurveFile, the_first_line_names_each_column_with_its_unit) {
  const Scratch scratch;
  CurveFile curve = fresh_curve(scratch / "force.csv");
  add(curve, 0, 0, 1.5);
  EXPECT_EQ(text_of(scratch / "force.csv"), "step [1],time [s],force [N]\n0,0,1.5\n");
}

TEST(CurveFile, each_row_is_in_the_file_as_soon_as_it_is_added) {
  const Scratch scratch;
  CurveFile curve = fresh_curve(scratch / "force.csv");
  add(curve, 100, 0.1, -2);
  EXPECT_THAT(text_of(scratch / "force.csv"), HasSubstr("\n100,0.1,-2\n"));
  add(curve, 200, 0.2, 1e-300);
  EXPECT_THAT(text_of(scratch / "force.csv"), HasSubstr("\n200,0.2,1e-300\n"));
}

TEST(CurveFile, numbers_read_back_to_the_same_bits) {
  const Scratch scratch;
  std::mt19937_64 random(1);
  std::vector<Real> numbers = {0.1, -0.0, 1 / 3.0, std::numeric_limits<Real>::denorm_min(),
                               std::numeric_limits<Real>::max()};
  for (int i = 0; i < 500; ++i)
    numbers.push_back(std::ldexp(static_cast<Real>(random()), static_cast<int>(random() % 1000) - 500));
  CurveFile curve = CurveFile::fresh(scratch / "numbers.csv", {{"number", "1"}});
  for (const Real number : numbers) curve.add(0, {&number, 1});
  std::ifstream in(scratch / "numbers.csv");
  std::string row;
  std::getline(in, row);
  for (const Real number : numbers) {
    std::getline(in, row);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(std::strtod(row.c_str() + 2, nullptr)), std::bit_cast<std::uint64_t>(number))
        << row;
  }
}

TEST(CurveFile, a_resumed_curve_loses_the_rows_after_the_checkpoint_and_goes_on) {
  const Scratch scratch;
  CurveEnd end;
  {
    CurveFile curve = fresh_curve(scratch / "force.csv");
    for (int step = 0; step <= 500; step += 100) {
      add(curve, step, step, 1);
      if (step == 200) end = curve.end();
    }
  }
  cut(cuts_to({{"force", end}}, {scratch / "force.csv"}));
  CurveFile curve = CurveFile::resume(scratch / "force.csv", time_and_force);
  add(curve, 300, 300, 2);
  EXPECT_EQ(text_of(scratch / "force.csv"), "step [1],time [s],force [N]\n0,0,1\n100,100,1\n200,200,1\n300,300,2\n");
}

TEST(CurveFile, of_several_rows_of_one_step_those_before_the_checkpoint_stay) {
  const Scratch scratch;
  CurveEnd end;
  {
    CurveFile curve = fresh_curve(scratch / "force.csv");
    for (int row = 0; row < 3; ++row) {
      add(curve, 100, 0, row);
      if (row == 1) end = curve.end();
    }
  }
  cut(cuts_to({{"force", end}}, {scratch / "force.csv"}));
  EXPECT_EQ(text_of(scratch / "force.csv"), "step [1],time [s],force [N]\n100,0,0\n100,0,1\n");
}

TEST(CurveFile, that_is_shorter_than_the_checkpoint_knows_or_gone_is_told) {
  const Scratch scratch;
  write_text(scratch / "short.csv", "step [1],time [s]\n1,2\n");
  write_text(scratch / "whole.csv", "step [1],time [s]\n1,2\n3,4\n");
  const std::map<std::string, CurveEnd> ends = {
      {"short", {26, "step [1],time [s]"}}, {"whole", {26, "step [1],time [s]"}}, {"gone", {26, "step [1],time [s]"}}};
  const auto cuts = cuts_to(ends, {scratch / "short.csv", scratch / "whole.csv"});
  const auto lost = lost_rows(ends, cuts);
  ASSERT_EQ(lost.size(), 2u);
  EXPECT_NE(lost[0].find("'gone' is gone"), std::string::npos) << lost[0];
  EXPECT_NE(lost[1].find("'short' has lost rows: it goes on behind the first 22 of the 26 bytes"), std::string::npos)
      << lost[1];
}

TEST(CurveFile, one_that_the_checkpoint_does_not_know_begins_anew) {
  const Scratch scratch;
  CurveFile late = fresh_curve(scratch / "late.csv");
  add(late, 100, 1, 2);
  cut(cuts_to({{"force", {1000, time_and_force_line}}}, {scratch / "late.csv"}));
  EXPECT_EQ(text_of(scratch / "late.csv"), "step [1],time [s],force [N]\n");
}

TEST(CurveFile, a_torn_last_row_is_dropped_wherever_it_was_torn) {
  const Scratch scratch;
  const std::string whole = "step [1],time [s],force [N]\n0,0,0\n100,0.25,-7.5\n";
  const std::string last = "200,0.5,-12.25\n";
  for (std::size_t cut = 0; cut < last.size(); ++cut) {
    for (const std::size_t known :
         {whole.size(), whole.size() + 100}) {  // rows that the checkpoint knew of may have been lost
      write_text(scratch / "force.csv", whole + last.substr(0, cut));
      beadwork::cut(cuts_to({{"force", {known, time_and_force_line}}}, {scratch / "force.csv"}));
      EXPECT_EQ(text_of(scratch / "force.csv"), whole) << "torn after " << cut;
    }
  }
}

TEST(CurveFile, one_whose_columns_the_checkpoint_knows_otherwise_is_refused_before_anything_is_cut) {
  const Scratch scratch;
  for (const char* name : {"force.csv", "other.csv"}) {
    CurveFile curve = fresh_curve(scratch / name);
    add(curve, 100, 1, 2);
  }
  const std::string before = text_of(scratch / "force.csv");
  const auto said = message_of<DeckFailure>([&] {
    cut(cuts_to({{"force", {28, time_and_force_line}}, {"other", {28, "step [1],time [s],force [kN]"}}},
                {scratch / "force.csv", scratch / "other.csv"}));
  });
  EXPECT_THAT(said, HasSubstr("other.csv"));
  EXPECT_THAT(said, HasSubstr("force [kN]"));
  EXPECT_EQ(text_of(scratch / "force.csv"), before);
}

TEST(CurveFile, a_curve_with_other_columns_is_refused_with_both_lines) {
  const Scratch scratch;
  fresh_curve(scratch / "force.csv");
  const auto said = message_of<DeckFailure>([&] { CurveFile::resume(scratch / "force.csv", {{"time", "s"}}); });
  EXPECT_THAT(said, HasSubstr("step [1],time [s],force [N]"));
  EXPECT_THAT(said, HasSubstr("\"step [1],time [s]\""));
}

TEST(CurveFile, a_curve_that_is_not_there_yet_is_begun) {
  const Scratch scratch;
  CurveFile::resume(scratch / "force.csv", time_and_force);
  EXPECT_EQ(text_of(scratch / "force.csv"), "step [1],time [s],force [N]\n");
}

TEST(CurveFile, a_name_that_would_break_the_table_is_refused) {
  const Scratch scratch;
  EXPECT_THROW(CurveFile::fresh(scratch / "c.csv", {{"a,b", "1"}}), std::logic_error);
}

TEST(CurveFile, a_row_of_another_length_is_refused) {
  const Scratch scratch;
  CurveFile curve = fresh_curve(scratch / "force.csv");
  const Real one = 1;
  EXPECT_THROW(curve.add(0, {&one, 1}), std::logic_error);
}

TEST(CurveFile, a_text_about_it_stands_beside_it) {
  const Scratch scratch;
  fresh_curve(scratch / "force.csv").write_sidecar("{\"title\": \"P\"}");
  EXPECT_EQ(text_of(scratch / "force.json"), "{\"title\": \"P\"}");
}

TEST(CurveFile, a_full_disk_is_said_at_once_and_no_half_row_stays) {
  const SmallDisk disk(1 << 20);
  if (!disk.there()) GTEST_SKIP() << "only root may mount a small disk";
  CurveFile curve = fresh_curve(disk.path() / "force.csv");
  disk.fill_but(16384);
  const auto said = message_of<MachineFailure>([&] {
    for (int step = 0; step < 200000; ++step) add(curve, step, step * 0.1, 1 / 3.0);
  });
  EXPECT_THAT(said, HasSubstr("No space left on device"));
  EXPECT_THAT(said, HasSubstr("force.csv"));
  const std::string text = text_of(disk.path() / "force.csv");
  EXPECT_GT(text.size(), 4000u);
  EXPECT_EQ(text.back(), '\n');
}

TEST(CurveFile, a_kill_loses_no_row_but_the_one_being_written) {
  const Scratch scratch;
  const fs::path file = scratch / "force.csv";
  for (unsigned trial = 0; trial < 30; ++trial) {
    fs::remove(file);
    kill_during(
        [&] {
          CurveFile curve = fresh_curve(file);
          for (int step = 0;; ++step) add(curve, step, step * 0.1, 1 / 3.0);
        },
        1000 + 700 * trial);
    if (!fs::exists(file)) continue;
    cut(cuts_to({{"force", {1 << 30, time_and_force_line}}}, {file}));
    std::ifstream in(file);
    std::string row;
    std::getline(in, row);
    for (int step = 0; std::getline(in, row); ++step)
      ASSERT_EQ(row.substr(0, row.find(',')), std::to_string(step)) << "trial " << trial;
  }
}
