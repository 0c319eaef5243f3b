#include "core/base/log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace beadwork {
namespace {

using ::testing::ElementsAre;

TEST(Log, the_first_line_on_a_subject_is_said_at_once_and_the_newest_at_the_end) {
  std::vector<std::string> said;
  Log log([&](const std::string& line) { said.push_back(line); }, {});
  log.say_once("top", "1 of top");
  log.say_once("left", "1 of left");
  log.say_once("top", "2 of top");
  log.say_once("top", "2 of top");  // the same again says nothing new
  log.say_once("top", "3 of top");
  log.say_once("top", "4 of top");
  EXPECT_THAT(said, ElementsAre("1 of top", "1 of left"));
  log.conclude();
  EXPECT_THAT(said,
              ElementsAre("1 of top", "1 of left", "in the end 4 of top (2 such lines before this one were left out)"));
}

TEST(Log, a_second_line_is_told_at_the_end_and_a_conclusion_comes_once) {
  std::vector<std::string> said;
  Log log([&](const std::string& line) { said.push_back(line); }, {});
  log.say_once("top", "1 of top");
  log.say_once("top", "2 of top");
  log.conclude();
  log.conclude();
  EXPECT_THAT(said, ElementsAre("1 of top", "in the end 2 of top"));
}

TEST(Log, what_is_said_and_what_is_warned_of_go_their_own_ways_and_nobody_has_to_listen) {
  std::vector<std::string> said, warned;
  const Log log([&](const std::string& line) { said.push_back(line); },
                [&](const std::string& line) { warned.push_back(line); });
  log.say("a");
  log.warn("b");
  EXPECT_THAT(said, ElementsAre("a"));
  EXPECT_THAT(warned, ElementsAre("b"));
  Log().say("c");
  Log().warn("d");
}

}  // namespace
}  // namespace beadwork
