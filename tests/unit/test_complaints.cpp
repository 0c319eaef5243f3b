#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/complaints.hpp"
#include "core/base/failure.hpp"

namespace beadwork {
namespace {

std::shared_ptr<const Source> file(const std::string& path, const std::string& text) {
  return std::make_shared<const Source>(Source{path, text});
}

TEST(Complaints, are_shown_like_those_of_a_compiler) {
  Complaints complaints;
  const auto deck = file("deck.xml", "<scene>\n\t<a b=\"0,3\"/>\r\n</scene>\n");
  complaints.error({deck, 2, 8}, "'b' wants a plain number, got \"0,3\"");
  EXPECT_EQ(complaints.text(),
            "deck.xml:2:8: error: 'b' wants a plain number, got \"0,3\"\n"
            "\t<a b=\"0,3\"/>\n"
            "\t      ^\n"
            "1 error");
}

TEST(Complaints, stand_in_the_order_of_the_files_whatever_order_they_came_in) {
  Complaints complaints;
  const auto first = file("z.xml", ""), second = file("a.xml", "");
  complaints.error({first, 12, 1}, "one");
  complaints.error({}, "nowhere");
  complaints.error({second, 1, 1}, "two");
  complaints.warning({first, 2, 9}, "three");
  complaints.error({first, 2, 3}, "four");
  EXPECT_EQ(complaints.text(),
            "z.xml:2:3: error: four\n\n  ^\nz.xml:2:9: warning: three\n\n        ^\nz.xml:12:1: error: one\n\n^\n"
            "a.xml:1:1: error: two\n\n^\nerror: nowhere\n4 errors, 1 warning");
}

TEST(Complaints, are_handed_over_one_by_one_in_their_order_however_many) {
  Complaints complaints;
  const auto deck = file("deck.xml", "1 error: a\n1 error: b\n");
  complaints.warning({deck, 2, 1}, "two\nwarning: of two lines");
  complaints.error({deck, 1, 1}, "one");
  EXPECT_THAT(complaints.each(),
              testing::ElementsAre("deck.xml:1:1: error: one\n1 error: a\n^\n",
                                   "deck.xml:2:1: warning: two\nwarning: of two lines\n1 error: b\n^\n"));
  for (int k = 0; k < 100; ++k) complaints.error({}, std::to_string(k));
  EXPECT_EQ(complaints.each().size(), 102U);
}

TEST(Complaints, are_told_once_if_the_same_mistake_is_met_twice) {
  Complaints complaints;
  const auto deck = file("deck.xml", "x");
  complaints.error({deck, 1, 1}, "twice");
  complaints.error({deck, 1, 1}, "twice");
  EXPECT_EQ(complaints.errors(), 1);
  complaints.error({deck, 1, 2}, "twice");
  EXPECT_EQ(complaints.errors(), 2);
}

TEST(Complaints, place_the_caret_by_characters_not_bytes) {
  Complaints complaints;
  complaints.error({file("deck.xml", "\u00B5\u00B5x"), 1, 3}, "here");
  EXPECT_THAT(complaints.text(), testing::HasSubstr("\u00B5\u00B5x\n  ^\n"));
}

TEST(Complaints, spell_out_bytes_that_are_no_text) {
  Complaints complaints;
  complaints.error({file("deck.xml", "a\xE9z \x01\u00B5\xC3"), 1, 6}, "here");
  EXPECT_THAT(complaints.text(), testing::HasSubstr("a\\xE9z \\x01\u00B5\\xC3\n" + std::string(11, ' ') + "^\n"));
}

TEST(Complaints, show_only_a_part_of_an_endless_line) {
  Complaints complaints;
  const std::string line = std::string(100000, 'a') + "HERE" + std::string(100000, 'b');
  complaints.error({file("deck.xml", line), 1, 100001}, "long");
  EXPECT_LT(complaints.text().size(), 500u);
  EXPECT_THAT(complaints.text(), testing::HasSubstr("aHERE"));
}

TEST(Complaints, about_everything_are_cut_short_but_counted) {
  Complaints complaints;
  for (int line = 1; line <= 1000; ++line) complaints.error({file("deck.xml", ""), line, 1}, "no");
  EXPECT_THAT(complaints.text(), testing::EndsWith("... and 950 more\n1000 errors"));
}

TEST(Complaints, throw_a_failure_of_the_deck_only_for_errors) {
  Complaints complaints;
  complaints.warning({}, "careful");
  EXPECT_NO_THROW(complaints.throw_if_any());
  complaints.error({}, "wrong");
  try {
    complaints.throw_if_any();
    FAIL() << "nothing was thrown";
  } catch (const DeckFailure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::deck);
    EXPECT_EQ(std::string(failure.what()), complaints.text());
  }
}

}  // namespace
}  // namespace beadwork
