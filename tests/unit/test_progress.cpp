#include "workbench/progress.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace beadwork {
namespace {

const Headway half{"stage 'pull'", "step 500, 3 breaks", 0.5, false};

TEST(Progress, a_steady_pace_gives_the_exact_time_to_go) {
  TimeToGo to_go;
  for (int second = 0; second <= 40; ++second)
    to_go.note(second, 0.5 + 0.005 * second);  // a resumed run begins in the middle
  EXPECT_NEAR(to_go.seconds().value(), (1 - 0.7) / 0.005, 1e-6);
}

TEST(Progress, there_is_no_estimate_in_the_first_seconds_nor_where_the_work_stands_still) {
  TimeToGo fresh, still;
  for (int second = 0; second <= 2; ++second) fresh.note(second, 0.1 * second);
  for (int second = 0; second <= 100; ++second) still.note(second, 0.3);
  EXPECT_FALSE(fresh.seconds());
  EXPECT_FALSE(still.seconds());
}

TEST(Progress, an_estimate_does_not_jump_and_follows_a_change_of_pace) {
  TimeToGo to_go;
  double before = 0, share = 0;
  for (int second = 0; second <= 120; ++second) {
    to_go.note(second, share);
    const double pace = second < 40 ? 0.004 : 0.002;
    share += pace * (second % 2 == 0 ? 1.6 : 0.4);  // noisy
    if (second > 12) {
      EXPECT_LT(std::abs(to_go.seconds().value() - before), 0.2 * before) << second;
    }
    before = to_go.seconds().value_or(0);
  }
  EXPECT_NEAR(before, (1 - share) / 0.002, 0.15 * (1 - share) / 0.002);
}

TEST(Progress, a_share_that_falls_begins_anew) {
  TimeToGo to_go;
  for (int second = 0; second <= 10; ++second) to_go.note(second, 0.09 * second);
  to_go.note(11, 0.1);
  EXPECT_FALSE(to_go.seconds());
}

TEST(Progress, a_line_has_a_bar_and_fits_the_terminal_whatever_its_width) {
  EXPECT_EQ(progress_line(half, 30, 79), " 50 % [########.......] 30 s to go  stage 'pull', step 500, 3 breaks");
  for (std::size_t width = 0; width < 100; ++width) EXPECT_LE(progress_line(half, 30, width).size(), width);
  EXPECT_EQ(progress_line(half, 30, 40), " 50 % 30 s to go  stage 'pull', step 500");
}

TEST(Progress, without_a_share_there_is_neither_bar_nor_time) {
  EXPECT_EQ(progress_line({"relaxation 'all'", "largest overlap 0.01", {}, false}, {}, 79),
            "relaxation 'all', largest overlap 0.01");
  Headway perhaps = half;
  perhaps.at_most = true;
  EXPECT_EQ(progress_line(perhaps, 7200, 79),
            " 50 % [########.......] at most 2.0 h to go  stage 'pull', step 500, 3 breaks");
}

TEST(Progress, letters_of_several_bytes_are_not_cut_and_wide_ones_count_twice) {
  const Headway wide{"\xE6\x8B\x89\xE4\xBC\xB8", "", {}, false};  // two Chinese signs
  EXPECT_EQ(progress_line(wide, {}, 3), "\xE6\x8B\x89");
  EXPECT_EQ(progress_line(wide, {}, 4), wide.work);
  EXPECT_EQ(progress_line({"\xC3\xA9\xC3\xA9", "", {}, false}, {}, 1), "\xC3\xA9");
  EXPECT_EQ(progress_line({"a\rb\n", "", {}, false}, {}, 9), "a?b?");
}

}  // namespace
}  // namespace beadwork
