#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/base/failure.hpp"
#include "core/deck/deck.hpp"
#include "core/deck/read.hpp"
#include "core/deck/write.hpp"

namespace beadwork {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Decks in a folder of their own.
class ADeck : public testing::Test {
 protected:
  ADeck()
      : folder(std::filesystem::path(testing::TempDir()) /
               testing::UnitTest::GetInstance()->current_test_info()->name()) {
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    std::filesystem::current_path(folder);
  }
  ~ADeck() override { std::filesystem::current_path("/"), std::filesystem::remove_all(folder); }

  static void file(const std::string& name, const std::string& text) { std::ofstream(name, std::ios::binary) << text; }

  /// Reads a deck of this text.
  Deck& read(const std::string& text, const std::vector<Override>& overrides = {},
             const std::vector<std::pair<std::string, std::string>>& others = {}) {
    file("deck.xml", text);
    for (const auto& [name, other] : others) file(name, other);
    deck = read_deck("deck.xml", overrides, complaints);
    if (!deck) {
      ADD_FAILURE() << complaints.text();
      throw DeckFailure("");
    }
    return *deck;
  }

  /// The first line of what is said about a deck of this text.
  static std::string complaint(const std::string& text, const std::vector<Override>& overrides = {}) {
    file("deck.xml", text);
    Complaints fresh;
    read_deck("deck.xml", overrides, fresh);
    EXPECT_GE(fresh.errors(), 1) << text;
    return fresh.text().substr(0, fresh.text().find('\n'));
  }

  const Attribute& attribute(const std::string& name) { return *deck->root->child("a")->find(name); }

  std::filesystem::path folder;
  Complaints complaints;
  std::unique_ptr<Deck> deck;
};

// ---- Places

TEST_F(ADeck, knows_line_and_column_of_tags_names_and_values) {
  read(
      "<?xml version=\"1.0\"?>\n<!-- a > b <c d='e'> -->\n<scene name=\"s\">\n  <fill>\n    <a x='1'\n\ty = "
      "\"2\"/>\n  </fill>\n</scene>\n");
  EXPECT_EQ(deck->root->at.where(), "deck.xml:3:2");
  EXPECT_EQ(deck->root->find("name")->value_at.where(), "deck.xml:3:14");
  const Node& a = *deck->root->child("fill")->child("a");
  EXPECT_EQ(a.at.where(), "deck.xml:5:6");
  EXPECT_EQ(a.find("x")->name_at.where(), "deck.xml:5:8");
  EXPECT_EQ(a.find("x")->value_at.where(), "deck.xml:5:11");
  EXPECT_EQ(a.find("y")->name_at.where(), "deck.xml:6:2");
  EXPECT_EQ(a.find("y")->value_at.where(), "deck.xml:6:7");
  EXPECT_EQ(a.find("z"), nullptr);
}

TEST_F(ADeck, counts_columns_right_behind_marks_umlauts_and_line_ends_of_other_systems) {
  read("\xEF\xBB\xBF<scene><a x=\"\u00B5\u00B5\" y=\"1\"/>\r\n<b z=\"a>b&lt;'c\" w='\"'/></scene>");
  EXPECT_EQ(deck->root->child("a")->find("y")->name_at.where(), "deck.xml:1:18");
  EXPECT_EQ(deck->root->child("b")->find("w")->name_at.where(), "deck.xml:2:18");
  EXPECT_EQ(deck->root->child("b")->find("z")->value, "a>b<'c");
  EXPECT_EQ(deck->root->child("b")->find("w")->value, "\"");
}

TEST_F(ADeck, finds_the_character_of_a_value_behind_entities) {
  read("<scene><a x=\"1 &lt;\r\n &#xB5; 2\"/></scene>");
  const Attribute& x = *deck->root->child("a")->find("x");
  EXPECT_EQ(x.value, "1 <\n \u00B5 2");
  EXPECT_EQ(x.place(3).where(), "deck.xml:1:20");
  EXPECT_EQ(x.place(5).where(), "deck.xml:2:2");
  EXPECT_EQ(x.place(8).where(), "deck.xml:2:9");
}

TEST_F(ADeck, may_tell_an_editor_where_the_schema_is) {
  read(
      "<scene xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" "
      "xsi:noNamespaceSchemaLocation=\"b.xsd\" seed=\"1\"/>");
  ASSERT_EQ(deck->root->attributes.size(), 1u);
  EXPECT_EQ(deck->root->attributes[0].name, "seed");
  EXPECT_TRUE(complaints.empty());
}

// ---- What is no deck

TEST_F(ADeck, that_is_not_well_formed_is_refused_at_the_place) {
  EXPECT_EQ(complaint("<scene>\n <fill>\n </bond>\n</scene>"),
            "deck.xml:3:2: error: </bond> stands where <fill> of line 2 must be closed first");
  EXPECT_EQ(complaint("<scene>\n <fill>\n"), "deck.xml:2:3: error: <fill> is not closed");
  EXPECT_EQ(complaint("<scene a=\"1\" a=\"2\"/>"), "deck.xml:1:14: error: 'a' is given twice");
  EXPECT_EQ(complaint("<scene a=1/>"), "deck.xml:1:8: error: 'a' needs a value in quotes: a=\"...\"");
  EXPECT_EQ(complaint("<scene a/>"), "deck.xml:1:8: error: 'a' needs a value in quotes: a=\"...\"");
  EXPECT_EQ(complaint("<scene>\n<a x=\"1/>\n<b y=\"2\"/>\n</scene>"),
            "deck.xml:2:6: error: this value runs over several lines: is its quote closed?");
  EXPECT_EQ(complaint("<scene a=\"1/>"), "deck.xml:1:10: error: the quote that opens this value is not closed");
  EXPECT_THAT(complaint("<scene a=\"1 & 2\"/>"), HasSubstr("deck.xml:1:13: error: & begins an entity"));
  EXPECT_EQ(complaint("<scene><!-- </scene>"), "deck.xml:1:8: error: this comment is not closed by -->");
  EXPECT_THAT(complaint("<scene/><scene/>"), HasSubstr("deck.xml:1:10: error: a second root"));
  EXPECT_THAT(complaint("<!DOCTYPE scene [<!ENTITY x 'y'>]><scene/>"), HasSubstr("not supported"));
  EXPECT_THAT(complaint("<scene>\n 5 mm <a/></scene>"),
              HasSubstr("deck.xml:2:2: error: text between tags means nothing here"));
  EXPECT_THAT(complaint("<scene><![CDATA[x]]></scene>"), HasSubstr("CDATA"));
  EXPECT_THAT(complaint("< scene/>"), HasSubstr("a tag needs a name"));
  EXPECT_THAT(complaint("<scene"), HasSubstr("this tag is not closed"));
}

TEST_F(ADeck, that_is_no_xml_at_all_is_refused) {
  EXPECT_THAT(complaint("units lj\natom_style sphere\n"), HasSubstr("deck.xml:1:1: error: this is no XML"));
  EXPECT_THAT(complaint(""), HasSubstr("a deck begins with <scene>"));
  EXPECT_THAT(complaint("  \n"), HasSubstr("a deck begins with <scene>"));
  EXPECT_THAT(complaint(std::string("<scene\0/>", 9)), HasSubstr("deck.xml:1:7: error: this is no text in UTF-8"));
  EXPECT_THAT(complaint("<scene>\n\xB5</scene>"), HasSubstr("deck.xml:2:1: error: this is no text in UTF-8"));
  EXPECT_EQ(complaint("\n<html/>"), "deck.xml:2:2: error: the root must be <scene>, not <html>");
}

TEST_F(ADeck, nested_a_hundred_thousand_deep_is_refused_without_a_crash) {
  std::string deep = "<scene>";
  for (int i = 0; i < 100000; ++i) deep += "<a>";
  EXPECT_THAT(complaint(deep), HasSubstr("nested more than 90 deep"));
}

TEST_F(ADeck, that_holds_a_data_set_is_sent_to_a_packing_file) {
  file("deck.xml", "<scene>");
  std::filesystem::resize_file("deck.xml", 100 << 20);
  read_deck("deck.xml", {}, complaints);
  EXPECT_THAT(complaints.text(), testing::AllOf(HasSubstr("100 MiB"), HasSubstr("<read-packing>")));
  std::string many = "<scene>";
  for (int i = 0; i < 100001; ++i) many += "<a/>";
  EXPECT_THAT(complaint(many), HasSubstr("<read-packing>"));
}

TEST_F(ADeck, that_cannot_be_opened_says_why) {
  read_deck("nowhere.xml", {}, complaints);
  read_deck(".", {}, complaints);
  read_deck("/dev/zero", {}, complaints);
  EXPECT_THAT(complaints.text(), HasSubstr("cannot read \"nowhere.xml\": there is no such file"));
  EXPECT_THAT(complaints.text(), HasSubstr("cannot read \".\": it is a folder"));
  EXPECT_THAT(complaints.text(), HasSubstr("cannot read \"/dev/zero\": it is no ordinary file"));
}

// ---- Includes

TEST_F(ADeck, splices_included_files_in_their_place) {
  std::filesystem::create_directory("library");
  file("library/one.xml", "<scene><include file=\"two.xml\"/><b/></scene>");
  file("library/two.xml", "<scene>\n  <parameter name=\"p\" value=\"1\"/><a/></scene>");
  read("<scene><z/><include file=\"library/one.xml\"/><c/></scene>");
  std::vector<std::string> tags;
  for (const auto& child : deck->root->children) tags.push_back(child->tag);
  EXPECT_THAT(tags, ElementsAre("z", "a", "b", "c"));
  EXPECT_EQ(deck->root->child("a")->at.where(), "library/two.xml:2:35");
  EXPECT_EQ(deck->sources.size(), 3u);
  deck->scope.complain_about_unused(*deck->root, complaints);  // a library may define more than a deck needs
  EXPECT_TRUE(complaints.empty()) << complaints.text();
}

TEST_F(ADeck, that_includes_itself_is_refused_with_the_chain) {
  file("b.xml", "<scene><include file=\"./deck.xml\"/></scene>");
  EXPECT_EQ(complaint("<scene><include file=\"b.xml\"/></scene>"),
            "b.xml:1:23: error: this file includes itself: deck.xml -> b.xml -> deck.xml");
  EXPECT_THAT(complaint("<scene><include file=\"deck.xml\"/></scene>"), HasSubstr("deck.xml -> deck.xml"));
}

TEST_F(ADeck, whose_include_is_missing_or_meaningless_points_at_it) {
  EXPECT_EQ(complaint("<scene>\n<include file=\"no.xml\"/></scene>"),
            "deck.xml:2:16: error: cannot read \"no.xml\": there is no such file");
  EXPECT_EQ(complaint("<scene><include/></scene>"), "deck.xml:1:9: error: <include> needs 'file'");
  EXPECT_EQ(complaint("<scene><include fiel=\"x\" file=\"\"/></scene>"),
            "deck.xml:1:17: error: no attribute 'fiel' in <include>. Did you mean 'file'?");
  file("named.xml", "<scene name=\"other\"/>");
  EXPECT_THAT(complaint("<scene><include file=\"named.xml\"/></scene>"),
              HasSubstr("named.xml:1:8: error: the <scene> of an included file"));
}

TEST_F(ADeck, cannot_include_without_end) {
  for (int i = 0; i < 40; ++i) {
    const std::string next = "<include file=\"f" + std::to_string(i + 1) + ".xml\"/>";
    file("f" + std::to_string(i) + ".xml", "<scene>" + next + "</scene>");
  }
  EXPECT_THAT(complaint("<scene><include file=\"f0.xml\"/></scene>"), HasSubstr("nested more than 16 deep"));
  for (int i = 0; i < 15; ++i) {
    const std::string next = "<include file=\"g" + std::to_string(i + 1) + ".xml\"/>";
    file("g" + std::to_string(i) + ".xml", "<scene>" + next + next + "</scene>");
  }
  file("g15.xml", "<scene/>");
  EXPECT_THAT(complaint("<scene><include file=\"g1.xml\"/></scene>"), HasSubstr("more than 256 files"));
}

// ---- Parameters

TEST_F(ADeck, works_out_parameters_that_use_earlier_and_later_ones) {
  read(
      "<scene><parameter name=\"half\" value=\"${side/2}\"/><parameter name=\"side\" value=\"28 um\"/><a "
      "q=\"${half + 1 um}\"/></scene>");
  EXPECT_DOUBLE_EQ(*read_quantity(attribute("q"), "m", deck->scope, complaints), 15e-6);
  deck->scope.complain_about_unused(*deck->root, complaints);
  EXPECT_TRUE(complaints.empty()) << complaints.text();
  EXPECT_EQ(deck->root->children.size(), 1u);
}

TEST_F(ADeck, with_a_parameter_that_depends_on_itself_is_refused_once) {
  read(
      "<scene>\n<parameter name=\"p\" value=\"${q}\"/>\n<parameter name=\"q\" value=\"${2*p}\"/><a "
      "x=\"${p}\" y=\"${p}\" t=\"${r}\"/>\n<parameter name=\"r\" value=\"x${r}\"/></scene>");
  EXPECT_FALSE(read_quantity(attribute("x"), "1", deck->scope, complaints));
  EXPECT_FALSE(read_quantity(attribute("y"), "1", deck->scope, complaints));
  EXPECT_FALSE(read_text(attribute("t"), deck->scope, complaints));
  EXPECT_THAT(complaints.text(), HasSubstr("deck.xml:2:28: error: parameter 'p' depends on itself: p -> q -> p\n"));
  EXPECT_THAT(complaints.text(), HasSubstr("deck.xml:4:28: error: parameter 'r' depends on itself: r -> r\n"));
  EXPECT_EQ(complaints.errors(), 2) << complaints.text();
}

TEST_F(ADeck, with_an_unused_parameter_is_refused) {
  read("<scene>\n  <parameter name=\"side\" value=\"28 um\"/></scene>");
  deck->scope.complain_about_unused(*deck->root, complaints);
  EXPECT_THAT(complaints.text(), HasSubstr("deck.xml:2:20: error: parameter 'side' is used nowhere"));
}

TEST_F(ADeck, is_not_told_of_a_parameter_whose_user_could_not_be_read) {
  read(
      "<scene><parameter name=\"E\" value=\"7 Gpa\"/><parameter name=\"I-x\" value=\"1 m^4\"/><parameter name=\"L\" "
      "value=\"${2*k}\"/>"
      "<parameter name=\"k\" value=\"3 mm\"/>\n<parameter name=\"other\" value=\"1\"/><a q=\"${E*(I-x-1 "
      "m^4)/L}\"/></scene>");
  EXPECT_FALSE(read_quantity(attribute("q"), "N.m", deck->scope, complaints));
  EXPECT_EQ(complaints.errors(), 1) << complaints.text();
  deck->scope.complain_about_unused(*deck->root, complaints);
  EXPECT_THAT(complaints.text(), HasSubstr("deck.xml:2:18: error: parameter 'other' is used nowhere"));
  EXPECT_EQ(complaints.errors(), 2) << complaints.text();
}

TEST_F(ADeck, with_two_parameters_of_one_name_is_refused) {
  EXPECT_EQ(complaint("<scene>\n<parameter name=\"p\" value=\"1\"/>\n<parameter name=\"p\" value=\"2\"/></scene>"),
            "deck.xml:3:18: error: parameter 'p' is already defined at deck.xml:2:18");
}

TEST_F(ADeck, with_a_malformed_parameter_is_refused) {
  EXPECT_EQ(complaint("<scene><parameter name=\"p\"/></scene>"), "deck.xml:1:9: error: <parameter> needs 'value'");
  EXPECT_EQ(complaint("<scene><parameter name=\"p\" value=\"\"/></scene>"), "deck.xml:1:35: error: 'value' is empty");
  EXPECT_EQ(complaint("<scene><parameter name=\"p\" valeu=\"2\" value=\"1\"/></scene>"),
            "deck.xml:1:28: error: no attribute 'valeu' in <parameter>. Did you mean 'value'?");
  EXPECT_THAT(complaint("<scene><parameter name=\"2p\" value=\"1\"/></scene>"), HasSubstr("must begin with a letter"));
  EXPECT_THAT(complaint("<scene><parameter name=\"and\" value=\"1\"/></scene>"), HasSubstr("meaning of its own"));
  EXPECT_THAT(complaint("<scene><parameter name=\"p\" value=\"1\"><a/></parameter></scene>"),
              HasSubstr("nothing may stand inside"));
  EXPECT_THAT(complaint("<scene><fill><parameter name=\"p\" value=\"1\"/></fill></scene>"),
              HasSubstr("directly in <scene>"));
}

TEST_F(ADeck, takes_values_from_the_command_line) {
  read("<scene><parameter name=\"side\" value=\"28 um\"/><a q=\"${side}\"/></scene>", {{"side", "29 um"}});
  EXPECT_EQ(read_quantity(attribute("q"), "m", deck->scope, complaints), 29e-6);
  EXPECT_EQ(complaint("<scene><parameter name=\"side\" value=\"28 um\"/></scene>", {{"sied", "1"}}),
            "--set:1:1: error: the deck has no parameter 'sied'. Did you mean 'side'?");
  EXPECT_THAT(complaint("<scene><parameter name=\"p\" value=\"1\"/></scene>", {{"p", "1"}, {"p", "2"}}),
              HasSubstr("given twice"));
}

TEST_F(ADeck, points_into_the_command_line_where_the_mistake_is_there) {
  read("<scene><parameter name=\"side\" value=\"28 um\"/><a q=\"${2*side}\"/></scene>", {{"side", "29 umm"}});
  EXPECT_FALSE(read_quantity(attribute("q"), "m", deck->scope, complaints));
  EXPECT_THAT(complaints.text(),
              HasSubstr("--set:1:9: error: parameter 'side' is used as a quantity at deck.xml:1:56"));
  EXPECT_THAT(complaints.text(), HasSubstr("side=29 umm\n        ^\n"));
}

TEST_F(ADeck, has_a_hash_that_changes_with_every_text_it_is_made_of) {
  const std::string text = "<scene><include file=\"b.xml\"/><parameter name=\"p\" value=\"1\"/></scene>";
  file("b.xml", "<scene/>");
  const std::string first = read(text).sha256, again = read(text).sha256;
  EXPECT_EQ(first, again);
  EXPECT_EQ(first.size(), 64u);
  EXPECT_NE(first, read(text, {{"p", "2"}}).sha256);
  file("b.xml", "<scene />");
  EXPECT_NE(first, read(text).sha256);
}

TEST_F(ADeck, cannot_be_blown_up_by_parameters) {
  std::string text = "<scene><parameter name=\"p0\" value=\"0123456789\"/>",
              chain = "<scene><parameter name=\"p0\" value=\"1\"/>";
  for (int i = 1; i <= 60; ++i) {
    const std::string name = "p" + std::to_string(i), before = "${p" + std::to_string(i - 1) + "}";
    text += "<parameter name=\"" + name + "\" value=\"" + before + " " + before + "\"/>";
  }
  read(text + "<a t=\"${p60}\" v=\"${p60}\"/></scene>");
  EXPECT_FALSE(read_text(attribute("t"), deck->scope, complaints));
  EXPECT_FALSE(read_quantities(attribute("v"), "1", deck->scope, complaints));
  for (int i = 1; i <= 5000; ++i)
    chain += "<parameter name=\"p" + std::to_string(i) + "\" value=\"${1+p" + std::to_string(i - 1) + "}\"/>";
  read(chain + "<a q=\"${p5000}\"/></scene>");
  EXPECT_FALSE(read_quantity(attribute("q"), "1", deck->scope, complaints));
  EXPECT_THAT(complaints.text(), HasSubstr("more than 100 deep"));
}

TEST_F(ADeck, cannot_be_held_up_by_parameters_that_grow) {
  std::string text = "<scene><parameter name=\"p0\" value=\"x\"/>";
  for (int i = 1; i <= 80; ++i) {
    const std::string before = "${p" + std::to_string(i - 1) + "}";
    text += "<parameter name=\"p" + std::to_string(i) + "\" value=\"" + before + before + "\"/>";
  }
  read(text + "<a t=\"${p80}\"/></scene>", {{"p0", ""}});  // nothing, 2^80 times
  EXPECT_EQ(deck->scope.text("p80", {}, complaints), "");
  EXPECT_EQ(complaints.errors(), 0) << complaints.text();
  read(text + "<a t=\"${p80}\"/></scene>");
  EXPECT_FALSE(read_text(attribute("t"), deck->scope, complaints));
  EXPECT_EQ(complaints.errors(), 1) << complaints.text();
  EXPECT_THAT(complaints.text(), HasSubstr("this text becomes longer than 100000 characters"));
}

TEST_F(ADeck, with_a_value_of_megabytes_is_refused_in_few_words) {
  std::string numbers;
  while (numbers.size() < 5'000'000) numbers += "1 ";
  read("<scene>\n<a q=\"" + numbers + "mm\" w=\"" + numbers + "\" n=\"" + numbers.substr(0, 900'000) + "\"/></scene>");
  EXPECT_FALSE(read_quantities(attribute("q"), "m", deck->scope, complaints));
  EXPECT_FALSE(read_words(attribute("w"), deck->scope, complaints));
  EXPECT_FALSE(read_quantities(attribute("n"), "1", deck->scope, complaints));
  EXPECT_FALSE(read_words(attribute("n"), deck->scope, complaints));
  EXPECT_THAT(complaints.text(), HasSubstr("deck.xml:2:7: error: 'q' wants values, each a length"));
  EXPECT_THAT(complaints.text(), HasSubstr("a value of more than 1000000 characters: data belong into a file"));
  EXPECT_THAT(complaints.text(), HasSubstr("these are more than 10000 values"));
  EXPECT_EQ(complaints.errors(), 4) << complaints.text();
  EXPECT_LT(complaints.text().size(), 20'000u);
}

// ---- What other tools write

TEST_F(ADeck, may_hold_what_is_meant_for_other_tools) {
  read(
      "<?xml version=\"1.0\"?>\n<!-- a remark -->\n<?xml-model href=\"a.xsd\"?>\n<?xml-stylesheet href=\"a.css\"?>\n"
      "<scene xml:lang=\"en\" xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" "
      "xsi:noNamespaceSchemaLocation=\"a.xsd\">"
      "<parameter name=\"p\" value=\"1\" xml:id=\"here\"/><include file=\"part.xml\" xml:base=\"x\"/><?other tool?>"
      "<a xmlns:xi=\"x\" xml:space=\"preserve\" q=\"${p}\"/></scene>\n<?end?>\n",
      {}, {{"part.xml", "<scene xmlns=\"x\" xsi:type=\"y\"/>"}});
  EXPECT_TRUE(complaints.empty()) << complaints.text();
  ASSERT_EQ(deck->root->child("a")->attributes.size(), 1u);
  EXPECT_EQ(attribute("q").value_at.where(), "deck.xml:5:252");
  EXPECT_THAT(complaint("<scene xmlnsx=\"a\"/>\n<?not closed"),
              HasSubstr("deck.xml:2:1: error: this is not closed by ?>"));
}

TEST_F(ADeck, takes_every_kind_of_blank_for_one) {
  read(
      "<scene>\n\u00A0\u3000<a\u00A0q=\"1\u00A02\u20093&#xA0;mm\"\u2003t=\"\u00A0one\u2009two\u00A0\"/>\u2028</scene>");
  EXPECT_EQ(read_vector(attribute("q"), "m", deck->scope, complaints), Vec3(1e-3, 2e-3, 3e-3));
  EXPECT_EQ(attribute("t").value_at.where(), "deck.xml:2:27") << "a column is a character, however many bytes it has";
  EXPECT_EQ(read_words(attribute("t"), deck->scope, complaints), (std::vector<std::string>{"one", "two"}));
  read("<scene><parameter name=\"p\" value=\"1 mm\"/><a q=\"${p\u00A0*\u00A02}\"/></scene>", {{"p", "2\u00A0mm"}});
  EXPECT_EQ(read_quantity(attribute("q"), "m", deck->scope, complaints), 4e-3);
  EXPECT_TRUE(complaints.empty()) << complaints.text();
}

TEST_F(ADeck, with_a_character_that_nobody_sees_is_refused_at_its_place) {
  EXPECT_EQ(complaint("<scene>\n<a q=\"1\u200B mm\"/></scene>"),
            "deck.xml:2:8: error: U+200B, a zero-width space, stands here in 'q': delete it");
  EXPECT_EQ(complaint("<scene>\n<a q=\"so\u00ADft\"/></scene>"),
            "deck.xml:2:9: error: U+00AD, a soft hyphen, stands here in 'q': delete it");
  EXPECT_EQ(complaint("<scene>\n<a q=\"1&#x1B;\"/></scene>"),
            "deck.xml:2:8: error: U+001B, a control character, stands here in 'q': delete it");
  EXPECT_EQ(
      complaint("<scene>\n\uFEFF<a/></scene>"),
      "deck.xml:2:1: error: U+FEFF, a byte order mark, which may stand only at the beginning, stands here: delete it");
  EXPECT_EQ(complaint("<scene>\n<a\u2060 q=\"1\"/></scene>"),
            "deck.xml:2:3: error: U+2060, a word joiner, stands here: delete it");
  EXPECT_EQ(complaint("\u200B<scene/>"), "deck.xml:1:1: error: U+200B, a zero-width space, stands here: delete it");
  EXPECT_EQ(complaint("<scene><parameter name=\"p\" value=\"1\"/></scene>", {{"p", "1\u200B"}}),
            "--set:1:4: error: U+200B, a zero-width space, stands here: leave it out");
  EXPECT_EQ(complaint("<scene><parameter name=\"p\" value=\"1\"/></scene>", {{"p", "1\xFF"}}),
            "--set:1:4: error: a byte that is no text in UTF-8, stands here: leave it out");
  EXPECT_EQ(complaint("<scene>\xED\xA0\x80</scene>"), "deck.xml:1:8: error: this is no text in UTF-8")
      << "half of a pair of UTF-16";
}

TEST_F(ADeck, with_a_curly_quote_is_told_so) {
  EXPECT_EQ(complaint("<scene>\n<a q=\u201C1\u201D/></scene>"),
            "deck.xml:2:4: error: 'q' needs a value in quotes: q=\"...\"; here stands '\u201C' (U+201C; write \")");
}

// ---- Values

/// A deck with one tag <a value="..."> and the parameters side, n, point and name.
class AValue : public ADeck {
 protected:
  const Attribute& value(const std::string& text) {
    read(
        "<scene>\n<parameter name=\"side\" value=\"28 um\"/><parameter name=\"n\" value=\"3\"/>"
        "<parameter name=\"point\" value=\"1 2 3 mm\"/><parameter name=\"name\" value=\"resin\"/>\n<a "
        "value=\"" +
        text + "\"/></scene>");
    return attribute("value");
  }
  std::optional<double> quantity(const std::string& text, const std::string& unit) {
    const Attribute& given = value(text);
    return read_quantity(given, unit, deck->scope, complaints);
  }
  std::optional<Vec3> vector(const std::string& text, const std::string& unit) {
    const Attribute& given = value(text);
    return read_vector(given, unit, deck->scope, complaints);
  }

  /// The first line of the complaints since the last call, as "column: message".
  std::string said() {
    const std::string text = complaints.text(),
                      start = "deck.xml:3:", infix = ": error: ", first = text.substr(0, text.find('\n'));
    EXPECT_EQ(complaints.errors(), 1) << text;
    EXPECT_TRUE(first.starts_with(start)) << text;
    complaints = {};
    return first.substr(start.size(), first.find(infix) - start.size()) + ": " +
           first.substr(first.find(infix) + infix.size());
  }
};

TEST_F(AValue, is_a_number_with_its_unit) {
  EXPECT_EQ(quantity("13.5 mm", "m"), 13.5e-3);
  EXPECT_EQ(quantity("13.5mm", "m"), 13.5e-3);
  EXPECT_EQ(quantity(" -0.05  m/s ", "m/s"), -0.05);
  EXPECT_EQ(quantity("0.3", "1"), 0.3);
  EXPECT_EQ(quantity("2 percent", "1"), 0.02);
  EXPECT_EQ(quantity("0.5 N/mm", "J/m2"), 500);
  EXPECT_EQ(quantity("2 1/s", "Hz"), 2);
  EXPECT_EQ(quantity("3 t/mm^3", "kg/m^3"), 3e12);
  EXPECT_TRUE(complaints.empty()) << complaints.text();
  EXPECT_TRUE(attribute("value").used);
}

TEST_F(AValue, may_be_an_expression) {
  EXPECT_DOUBLE_EQ(*quantity("${0.5*side}", "m"), 14e-6);
  EXPECT_DOUBLE_EQ(*quantity("${2*n} mm", "m"), 6e-3);
  EXPECT_EQ(quantity("${side}", "m"), 28e-6);
}

TEST_F(AValue, that_is_not_what_is_wanted_is_refused_in_words) {
  EXPECT_FALSE(quantity("0,3", "1"));
  EXPECT_EQ(said(), "11: 'value' wants a plain number, got \"0,3\": decimals have a point, not a comma");
  EXPECT_FALSE(quantity("25 MPa", "J/m2"));
  EXPECT_EQ(said(), "11: 'value' wants J/m2, got \"25 MPa\" which is Pa");
  EXPECT_FALSE(quantity("5", "m"));
  EXPECT_EQ(said(), "11: 'value' wants a length such as \"1 mm\", got \"5\"");
  EXPECT_FALSE(quantity("5", "J/m2"));
  EXPECT_EQ(said(), "11: 'value' wants J/m2, got \"5\" without a unit");
  EXPECT_FALSE(quantity("7.85 ton/m^3", "kg/m^3"));
  EXPECT_EQ(said(),
            "16: 'value' wants a density such as \"1200 kg/m^3\", got \"7.85 ton/m^3\": unit \"ton\" is refused: there "
            "are several tons; write t "
            "(1000 kg), short_ton (907.18 kg) or long_ton (1016.05 kg)");
  EXPECT_FALSE(quantity("3 GPA", "Pa"));
  EXPECT_EQ(said(), "13: 'value' wants Pa, got \"3 GPA\": unknown unit \"GPA\". Did you mean \"GPa\"?");
  EXPECT_FALSE(quantity("${n}", "m"));
  EXPECT_EQ(said(), "11: 'value' wants a length such as \"1 mm\", got \"3\" which is a plain number");
  EXPECT_FALSE(quantity("1 2 mm", "m"));
  EXPECT_EQ(said(), "11: 'value' wants a length such as \"1 mm\", got \"1 2 mm\" which are 2 values");
  EXPECT_FALSE(quantity("${side} mm", "m"));
  EXPECT_EQ(said(),
            "19: 'value' wants a length such as \"1 mm\", got \"${side} mm\": what stands before \"mm\" has "
            "a unit already");
  EXPECT_FALSE(quantity("", "1"));
  EXPECT_EQ(said(), "11: 'value' wants a plain number, got nothing");
  for (const char* bad : {"nan", "inf", "-inf", "1e999", "0x10", "abc", "mm", "--1", "5 mm mm", "${1/0}", "${side} mm",
                          "${n > 2}", "1 ${n", "1.2.3", "1e308 km"}) {
    EXPECT_FALSE(quantity(bad, "m")) << bad;
    said();
  }
}

TEST_F(AValue, points_into_its_expression) {
  EXPECT_FALSE(quantity("${2*sied}", "m"));
  EXPECT_EQ(said(), "15: no parameter 'sied'. Did you mean 'side'?");
  EXPECT_FALSE(quantity("${side + 2}", "m"));
  EXPECT_THAT(said(), HasSubstr("18: the two sides of '+' differ"));
  EXPECT_FALSE(quantity("2*${side}", "m"));
  EXPECT_THAT(
      said(),
      HasSubstr("12: 'value' wants a length such as \"1 mm\", got \"2*${side}\": arithmetic stands inside ${ }"));
}

TEST_F(AValue, of_an_angle_needs_its_unit) {
  EXPECT_DOUBLE_EQ(*quantity("180 degree", "degree"), 3.141592653589793);
  EXPECT_TRUE(quantity("${pi/2}", "rad"));
  EXPECT_FALSE(quantity("30", "degree"));
  EXPECT_EQ(said(), "11: 'value' wants an angle such as \"30 degree\", got \"30\"");
}

TEST_F(AValue, that_is_zero_needs_no_unit) {
  EXPECT_EQ(quantity("0", "m"), 0);
  EXPECT_EQ(quantity("${0*n}", "Pa"), 0);
  EXPECT_EQ(quantity("0", "degree"), 0);
  EXPECT_TRUE(complaints.empty()) << complaints.text();
  EXPECT_FALSE(quantity("0 s", "m"));
  EXPECT_EQ(said(), "11: 'value' wants a length such as \"1 mm\", got \"0 s\" which is s");
}

TEST_F(AValue, with_a_sign_that_only_looks_like_the_one_that_is_meant_is_refused) {
  EXPECT_FALSE(quantity("\u22121 mm", "m"));
  EXPECT_EQ(
      said(),
      "11: 'value' wants a length such as \"1 mm\", got \"\u22121 mm\": '\u2212' (U+2212; write -) means nothing here");
  EXPECT_FALSE(quantity("1\u20132 mm", "m"));
  EXPECT_EQ(said(),
            "12: 'value' wants a length such as \"1 mm\", got \"1\u20132 mm\": '\u2013' (U+2013; write -) means "
            "nothing here");
  EXPECT_FALSE(quantity("2 kg\u2044m", "kg/m"));
  EXPECT_THAT(said(), HasSubstr("15: 'value' wants")) << "at the sign itself";
}

TEST_F(AValue, may_be_a_vector_whose_unit_stands_once) {
  EXPECT_EQ(vector("14 14 28 um", "m"), Vec3(14e-6, 14e-6, 28e-6));
  EXPECT_EQ(vector("${side} ${side} 2 mm", "m"), Vec3(28e-6, 28e-6, 2e-3));
  EXPECT_EQ(vector("1 cm 2 3 mm", "m"), Vec3(1e-2, 2e-3, 3e-3));
  EXPECT_EQ(vector("1 0 -1", "1"), Vec3(1, 0, -1));
  EXPECT_EQ(vector("0 0 ${side}", "m"), Vec3(0, 0, 28e-6)) << "zero needs no unit";
  EXPECT_EQ(vector("0 0 0", "m"), Vec3(0, 0, 0));
  EXPECT_FALSE(vector("0 1 ${side}", "m"));
  EXPECT_THAT(said(), HasSubstr(": 1 has no unit"));
  EXPECT_EQ(vector("${point}", "m"), Vec3(1e-3, 2e-3, 3e-3));
  EXPECT_TRUE(complaints.empty()) << complaints.text();
  EXPECT_FALSE(vector("1 2 mm", "m"));
  EXPECT_EQ(said(), "11: 'value' wants three values such as \"1 0 0 m\", got \"1 2 mm\" which are 2 values");
  EXPECT_FALSE(vector("1 mm 2 3", "m"));
  EXPECT_THAT(said(), HasSubstr("got \"1 mm 2 3\": 2 has no unit"));
  EXPECT_FALSE(quantity("${2*point}", "m"));
  EXPECT_THAT(said(), HasSubstr("parameter 'point' holds 3"));
}

TEST_F(AValue, may_be_a_whole_number) {
  const auto integer = [&](const std::string& text) {
    const Attribute& given = value(text);
    return read_integer(given, deck->scope, complaints);
  };
  EXPECT_EQ(integer("18810"), 18810);
  EXPECT_EQ(integer("1e6"), 1000000);
  EXPECT_EQ(integer("${2*n}"), 6);
  EXPECT_FALSE(integer("2.5"));
  EXPECT_EQ(said(), "11: 'value' wants a whole number, got \"2.5\"");
  EXPECT_FALSE(integer("1e30"));
  said();
  EXPECT_FALSE(integer("3 mm"));
  EXPECT_EQ(said(), "11: 'value' wants a whole number, got \"3 mm\" which is m");
}

TEST_F(AValue, may_be_text_with_parameters_in_it) {
  const auto text = [&](const std::string& source) {
    const Attribute& given = value(source);
    return read_text(given, deck->scope, complaints);
  };
  const auto words = [&](const std::string& source) {
    const Attribute& given = value(source);
    return read_words(given, deck->scope, complaints);
  };
  EXPECT_EQ(text("${name}"), "resin");
  EXPECT_EQ(text("the ${name} of ${side}, ${n + 1} times"), "the resin of 28 um, 4 times");
  EXPECT_EQ(text("plain $ { }"), "plain $ { }");
  EXPECT_EQ(words(" ${name}  fibre "), (std::vector<std::string>{"resin", "fibre"}));
  EXPECT_FALSE(text("  "));
  EXPECT_EQ(said(), "11: 'value' is empty");
  EXPECT_FALSE(text("${nmae}"));
  EXPECT_EQ(said(), "13: no parameter 'nmae'. Did you mean 'name'?");
}

TEST_F(AValue, may_be_yes_or_no_or_one_of_a_list) {
  const auto boolean = [&](const std::string& text) {
    const Attribute& given = value(text);
    return read_boolean(given, deck->scope, complaints);
  };
  EXPECT_EQ(boolean("yes"), true);
  EXPECT_EQ(boolean("false"), false);
  EXPECT_FALSE(boolean("on"));
  EXPECT_EQ(said(), "11: 'value' wants yes or no, got \"on\"");
  const auto choice = [&](const std::string& text) {
    const Attribute& given = value(text);
    return read_choice(given, {"each", "mean"}, deck->scope, complaints);
  };
  EXPECT_EQ(choice("mean"), "mean");
  EXPECT_FALSE(choice("maen"));
  EXPECT_EQ(said(), "11: 'value' wants each or mean, got \"maen\". Did you mean 'mean'?");
}

TEST_F(AValue, that_is_a_word_cannot_be_calculated_with) {
  EXPECT_FALSE(quantity("${2*name}", "m"));
  EXPECT_THAT(complaints.text(), HasSubstr("deck.xml:2:142: error: parameter 'name' is used as a quantity at "
                                           "deck.xml:3:15, but holds \"resin\""));
}

// ---- Writing

TEST(ResolvedDeck, is_canonical_xml_that_reads_back) {
  const PlainNode scene{"scene", {{"name", "a \"b\" <c> & d\n\te"}}, {{"fill", {}, {{"a", {{"x", "1 m"}}, {}}}}}};
  const std::string xml = resolved_xml(scene);
  EXPECT_EQ(xml,
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<scene name=\"a &quot;b&quot; &lt;c&gt; &amp; "
            "d&#10;&#9;e\">\n"
            "  <fill>\n    <a x=\"1 m\"/>\n  </fill>\n</scene>\n");
  const std::string path = testing::TempDir() + "resolved.xml";
  std::ofstream(path) << xml;
  Complaints complaints;
  const auto deck = read_deck(path, {}, complaints);
  ASSERT_TRUE(deck) << complaints.text();
  EXPECT_EQ(deck->root->find("name")->value, "a \"b\" <c> & d\n\te");
  const auto tree = read_resolved_xml(xml);
  ASSERT_TRUE(tree);
  EXPECT_EQ(resolved_xml(*tree), xml);
  EXPECT_EQ(tree->children[0].children[0].find("x")->at.where(), "resolved.xml:4:11");
  EXPECT_FALSE(read_resolved_xml("<scene"));
}

}  // namespace
}  // namespace beadwork
