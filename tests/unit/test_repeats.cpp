#include "core/base/repeats.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace beadwork {
namespace {

using ::testing::ElementsAre;

TEST(Repeats, the_first_line_on_a_subject_is_said_at_once_and_the_newest_at_the_end) {
  std::vector<std::string> log;
  Repeats repeats([&](const std::string& line) { log.push_back(line); });
  repeats.say("top", "1 of top");
  repeats.say("left", "1 of left");
  repeats.say("top", "2 of top");
  repeats.say("top", "2 of top");  // the same again says nothing new
  repeats.say("top", "3 of top");
  repeats.say("top", "4 of top");
  EXPECT_THAT(log, ElementsAre("1 of top", "1 of left"));
  repeats.conclude();
  EXPECT_THAT(log, ElementsAre("1 of top", "1 of left", "in the end 4 of top (2 such lines before this one were left out)"));
}

TEST(Repeats, a_second_line_is_told_at_the_end_and_a_conclusion_comes_once) {
  std::vector<std::string> log;
  Repeats repeats([&](const std::string& line) { log.push_back(line); });
  repeats.say("top", "1 of top");
  repeats.say("top", "2 of top");
  repeats.conclude();
  repeats.conclude();
  EXPECT_THAT(log, ElementsAre("1 of top", "in the end 2 of top"));
}

}  // namespace
}  // namespace beadwork
