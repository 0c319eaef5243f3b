// Whether a deck is the one that began a run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/failure.hpp"
#include "core/loop/same_deck.hpp"

namespace beadwork {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* begun = R"(<scene name="a" seed="1" plugins="/one/laws.so">
  <fill><read-packing set="all" file="/one/balls.txt"/><region set="left" where="x &lt; 1 m"/><region set="right" where="x > 1 m"/></fill>
  <fail><bond-stress of="beam" every="1"/></fail>
  <move><verlet until="100"/></move>
  <watch><force-curve name="f" every="10" at="5"/></watch>
</scene>)";
const FileSums files{{"/one/balls.txt", "abc"}};

std::string changed(const std::string& from, const std::string& to) {
  std::string text = begun;
  return text.replace(text.find(from), from.size(), to);
}

/// What is said of a run by `begun` that is to go on with another deck; "" if it may.
std::string said(const std::string& now, const FileSums& now_files = files) {
  try {
    refuse_other_deck({begun, files}, *read_resolved_xml(now), now_files);
    return "";
  } catch (const DeckFailure& failure) {
    return failure.what();
  }
}

TEST(SameDeck, may_end_and_look_when_it_likes) {
  EXPECT_EQ(said(begun), "");
  EXPECT_EQ(said(changed("until=\"100\"", "until=\"5 mm\"")), "");
  EXPECT_EQ(said(changed(" until=\"100\"", "")), "");
  EXPECT_EQ(said(changed("every=\"10\"", "every=\"7\"")), "");
  EXPECT_EQ(said(changed("name=\"a\"", "name=\"b\"")), "");
  EXPECT_EQ(said(changed(" plugins=\"/one/laws.so\"", "")), "");
}

TEST(SameDeck, says_of_each_attribute_that_differs_where_it_stands) {
  const std::string text = said(changed("x &lt; 1 m", "x &lt; 2 m"));
  EXPECT_THAT(
      text,
      HasSubstr("resolved.xml:2:82: error: 'where' is \"x < 2 m\" here, but \"x < 1 m\" in the run that is to go on"));
  EXPECT_THAT(text, HasSubstr("1 error"));
  EXPECT_THAT(said(changed("every=\"1\"", "every=\"2\"")),
              HasSubstr("'every' is \"2\" here, but \"1\""));  // of a criterion: physics
  EXPECT_THAT(said(changed("at=\"5\"", "at=\"6\"")), HasSubstr("'at' is"));
  EXPECT_THAT(said(changed(" at=\"5\"", "")),
              HasSubstr("<force-curve> has at=\"5\" in the run that is to go on, and no 'at' here"));
  EXPECT_THAT(said(changed("seed=\"1\"", "seed=\"2\"")), HasSubstr("'seed' is"));
  EXPECT_THAT(said(changed("file=\"/one/balls.txt\"", "file=\"/one/balls.txt\" unit=\"mm\"")),
              HasSubstr("'unit' is \"mm\" here, but not given in"));
}

TEST(SameDeck, says_what_came_and_what_went) {
  const std::string less = said(changed("<region set=\"left\" where=\"x &lt; 1 m\"/>", ""));
  EXPECT_THAT(less, HasSubstr("<fill> has <region set=\"left\"> in the run that is to go on, and not here"));
  EXPECT_THAT(less, HasSubstr("1 error"));
  EXPECT_THAT(said(changed("<fail>", "<fail><bond-stress of=\"glue\"/>")),
              HasSubstr("<bond-stress of=\"glue\"> is not in the run that is to go on"));
}

TEST(SameDeck, may_lie_elsewhere_but_its_files_are_those_of_the_run) {
  const std::string moved = changed("/one/balls.txt", "/two/balls.txt");
  EXPECT_EQ(said(moved, {{"/two/balls.txt", "abc"}}), "");
  EXPECT_THAT(said(moved, {{"/two/balls.txt", "other"}}), HasSubstr("'file' is \"/two/balls.txt\""));
  EXPECT_THAT(said(begun, {{"/one/balls.txt", "other"}}), HasSubstr("/one/balls.txt has changed"));
}

TEST(SameDeck, bears_long_names) {
  const std::string longer = "name=\"" + std::string(1000000, 'a') + "\"";
  EXPECT_EQ(said(changed("name=\"a\"", longer)), "");
  EXPECT_THAT(said(changed("x > 1 m", std::string(1000000, 'x'))), HasSubstr("'where' is"));
}

}  // namespace
}  // namespace beadwork
