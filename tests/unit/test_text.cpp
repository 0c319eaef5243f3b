#include <gtest/gtest.h>

#include <cmath>

#include "core/base/sha256.hpp"
#include "core/base/text.hpp"

namespace beadwork {
namespace {

TEST(Text, a_misspelt_word_finds_the_one_that_was_meant) {
  const std::vector<std::string> tags{"cohesive-contact", "cohesive-beam", "spring"};
  EXPECT_EQ(closest("cohesive-bean", tags), "cohesive-beam");
  EXPECT_EQ(closest("sprnig", tags), "spring");
  EXPECT_EQ(closest("SPRING", tags), "spring");
  EXPECT_EQ(closest("gravity", tags), "");
  EXPECT_EQ(closest("x", {"y"}), "");
}

TEST(Text, a_part_of_a_name_stands_for_the_shortest_name_that_has_it) {
  const std::vector<std::string> tags{"bond/cohesive-beam", "cohesive-beam", "cohesive-contact"};
  EXPECT_EQ(closest("beam", tags), "cohesive-beam");
  EXPECT_EQ(closest("co", tags), "");
}

TEST(Text, two_swapped_letters_are_one_edit) { EXPECT_EQ(closest("abdc", {"wxyz", "abcd"}), "abcd"); }

TEST(Text, case_decides_between_equals) { EXPECT_EQ(closest("Mpa", {"mpa", "MPa"}), "mpa"); }

TEST(Text, a_suggestion_or_the_short_list_of_what_is_known_follows_a_complaint) {
  EXPECT_EQ(did_you_mean("bean", {"beam", "spring"}, "<", ">"), ". Did you mean <beam>?");
  EXPECT_EQ(did_you_mean("gravity", {"beam", "spring"}), "; known: beam, spring");
  EXPECT_EQ(did_you_mean("gravity", {}), "");
  EXPECT_EQ(did_you_mean("gravity", std::vector<std::string>(50, "beam")), "");
}

TEST(Text, a_number_is_read_whole_or_not_at_all) {
  EXPECT_EQ(parse_number("3.9"), 3.9);
  EXPECT_EQ(parse_number("-1e-7"), -1e-7);
  EXPECT_EQ(parse_number("+.5"), 0.5);
  for (const char* bad :
       {"0,3", "3.9GPa", "1 ", " 1", "nan", "inf", "-inf", "1e999", "0x1", "", "+", "+-1", "1e", "--1"})
    EXPECT_FALSE(parse_number(bad)) << bad;
}

TEST(Text, a_number_is_written_so_that_it_reads_back_the_same) {
  EXPECT_EQ(format_number(0.1), "0.1");
  for (const double x : {1.0 / 3, 1e-300, 123456789.123, -0.0, 5e-324}) EXPECT_EQ(parse_number(format_number(x)), x);
}

TEST(Text, words_are_split_trimmed_and_joined) {
  EXPECT_EQ(split_words("  a\tb\n c "), (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_TRUE(split_words(" ").empty());
  EXPECT_EQ(split("a,,b", ','), (std::vector<std::string>{"a", "", "b"}));
  EXPECT_EQ(trim(" a b "), "a b");
  EXPECT_EQ(join({"a", "b"}), "a, b");
}

std::string marked(const std::vector<std::string>& first, const std::vector<std::string>& second) {
  std::string all;
  for (const OddLine& line : odd_lines(first, second))
    all += (line.in_second ? "+" + second[line.number] : "-" + first[line.number]);
  return all;
}

TEST(Text, two_texts_differ_by_as_few_lines_as_can_be) {
  EXPECT_EQ(marked({"a", "b", "c"}, {"a", "b", "c"}), "");
  EXPECT_EQ(marked({"a", "b", "c"}, {"a", "x", "b", "c"}), "+x");
  EXPECT_EQ(marked({"a", "b", "c"}, {"a", "c"}), "-b");
  EXPECT_EQ(marked({"a", "b", "c"}, {"a", "x", "c"}), "-b+x");
  EXPECT_EQ(marked({"a", "b", "c", "d", "e"}, {"b", "c", "x", "e", "f"}), "-a-d+x+f");
  EXPECT_EQ(marked({}, {"a", "a"}), "+a+a");
  EXPECT_EQ(marked({"a", "a", "a"}, {"a"}), "-a-a");
}

TEST(Text, texts_too_long_to_compare_differ_in_all_lines_between_their_common_ends) {
  std::vector<std::string> first(20000, "a"), second(20000, "b");
  for (auto* text : {&first, &second}) text->front() = text->back() = "same";
  EXPECT_EQ(odd_lines(first, second).size(), 2 * 19998u);
}

// Derived: the test vectors of FIPS 180-2.
TEST(Text, the_hash_is_sha_256) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Text, is_quoted_for_a_shell_where_it_has_to_be) {
  EXPECT_EQ(shell_quoted("a/b-c_1.xml"), "a/b-c_1.xml");
  EXPECT_EQ(shell_quoted("notch=0.8 mm"), "'notch=0.8 mm'");
  EXPECT_EQ(shell_quoted("it's $HOME;"), "'it'\\''s $HOME;'");
  EXPECT_EQ(shell_quoted("it's\n\\\x7f"), "$'it\\'s\\012\\\\\\177'") << "on one line";
  EXPECT_EQ(shell_quoted(""), "''");
  EXPECT_EQ(shell_quoted("~"), "'~'");
}

}  // namespace
}  // namespace beadwork
