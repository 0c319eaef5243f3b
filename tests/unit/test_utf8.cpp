#include <gtest/gtest.h>

#include "core/base/text.hpp"
#include "core/base/utf8.hpp"

namespace beadwork {
namespace {

TEST(Utf8, a_character_has_one_to_four_bytes_and_no_more_than_it_needs) {
  EXPECT_EQ(character_length("a"), 1u);
  EXPECT_EQ(character_length("\u00B5m"), 2u);
  EXPECT_EQ(character_length("\u2212"), 3u);
  EXPECT_EQ(character_length("\U0001F600"), 4u);
  for (const char* none : {"", "\xFF", "\x80", "\xC3", "\xC0\x80", "\xE0\x80\x80", "\xED\xA0\x80", "\xF0\x80\x80\x80",
                           "\xF4\x90\x80\x80", "\xE2\x88x"})
    EXPECT_EQ(character_length(none), 0u) << testing::PrintToString(none);
}

TEST(Utf8, a_blank_beyond_ascii_becomes_as_many_spaces_as_it_has_bytes) {
  EXPECT_EQ(with_plain_blanks("1\u00A0mm\u3000x\t\u2009."), "1  mm   x\t   .");
  EXPECT_EQ(with_plain_blanks("\u00B5m \u200B\xFF"), "\u00B5m \u200B\xFF");
  for (const char* blank :
       {"\u00A0", "\u0085", "\u1680", "\u2000", "\u200A", "\u2028", "\u2029", "\u202F", "\u205F", "\u3000"})
    EXPECT_EQ(trim(with_plain_blanks(blank)), "") << blank;
}

TEST(Utf8, what_nobody_sees_is_named) {
  EXPECT_FALSE(first_invisible("a\tb\r\n\u00B5 \u00A0\u2212\U0001F600"));
  EXPECT_EQ(first_invisible("ab\u200B")->at, 2u);
  EXPECT_EQ(first_invisible("ab\u200B")->words, "U+200B, a zero-width space");
  EXPECT_EQ(first_invisible("\u202E")->words, "U+202E, a mark that turns the direction of writing");
  EXPECT_EQ(first_invisible(std::string_view("\0", 1))->words, "U+0000, a control character");
  for (const char* hidden : {"\u3164", "\u115F", "\uFFA0", "\u2800", "\U000E0020", "\U000E0100"})
    EXPECT_TRUE(first_invisible(hidden)) << hidden;
  EXPECT_EQ(first_invisible("a\xFF")->words, "a byte that is no text in UTF-8");
}

TEST(Utf8, a_sign_that_looks_like_another_is_told_with_the_other) {
  EXPECT_EQ(named_character("\u2212 1"), "'\u2212' (U+2212; write -)");
  EXPECT_EQ(named_character("\u00E9"), "'\u00E9' (U+00E9)");
  EXPECT_EQ(named_character("x"), "'x'");
  EXPECT_EQ(first_lookalike("1 \u2013 2"), 2u);
  EXPECT_FALSE(first_lookalike("\u00B5m\u00B2"));
}

TEST(Utf8, safe_text_can_be_shown_anywhere) {
  EXPECT_EQ(safe_text("plain \u00B5\U0001F600\n\t"), "plain \u00B5\U0001F600\n\t");
  EXPECT_EQ(safe_text(std::string_view("a\0b", 3)), "a\uFFFDb");
  EXPECT_EQ(safe_text("\x1B[31m\x7F\r\u0085\u009B\u202E"), "\uFFFD[31m\uFFFD\uFFFD\uFFFD\uFFFD\uFFFD");
  EXPECT_EQ(safe_text("x\xFFy\xE2\x88"), "x\uFFFDy\uFFFD\uFFFD");
  EXPECT_EQ(safe_text("\uFFFE\uFFFF"), "\uFFFD\uFFFD");
  EXPECT_EQ(xml_escaped("<a&\"\x1B\xFF\r\n"), "&lt;a&amp;&quot;\uFFFD\uFFFD&#13;&#10;");
}

}  // namespace
}  // namespace beadwork
