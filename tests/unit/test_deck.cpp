// Decks are read: places in them, what is no deck, includes, what other tools write; and resolved decks are written.
#include <gmock/gmock.h>

#include "core/deck/write.hpp"
#include "tests/support/a_deck.hpp"

namespace beadwork {
namespace {

using testing::ADeck;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// ---- Places

TEST_F(ADeck, knows_line_and_column_of_tags_names_and_values) {
  read(
      "<?xml version=\"1.0\"?>\n<!-- a > b <c d='e'> -->\n<scene name=\"s\">\n  <fill>\n    <a x='1'\n\ty = "
      "\"2\"/>\n  </fill>\n</scene>\n");
  EXPECT_EQ(deck->root->at.where(), "deck.xml:3:2");
  EXPECT_EQ(deck->root->find("name")->value_at.where(), "deck.xml:3:14");
  const Node& a = child(child(*deck->root, "fill"), "a");
  EXPECT_EQ(a.at.where(), "deck.xml:5:6");
  EXPECT_EQ(a.find("x")->name_at.where(), "deck.xml:5:8");
  EXPECT_EQ(a.find("x")->value_at.where(), "deck.xml:5:11");
  EXPECT_EQ(a.find("y")->name_at.where(), "deck.xml:6:2");
  EXPECT_EQ(a.find("y")->value_at.where(), "deck.xml:6:7");
  EXPECT_EQ(a.find("z"), nullptr);
}

TEST_F(ADeck, counts_columns_right_behind_marks_umlauts_and_line_ends_of_other_systems) {
  read("\xEF\xBB\xBF<scene><a x=\"\u00B5\u00B5\" y=\"1\"/>\r\n<b z=\"a>b&lt;'c\" w='\"'/></scene>");
  EXPECT_EQ(child(*deck->root, "a").find("y")->name_at.where(), "deck.xml:1:18");
  EXPECT_EQ(child(*deck->root, "b").find("w")->name_at.where(), "deck.xml:2:18");
  EXPECT_EQ(child(*deck->root, "b").find("z")->value, "a>b<'c");
  EXPECT_EQ(child(*deck->root, "b").find("w")->value, "\"");
}

TEST_F(ADeck, finds_the_character_of_a_value_behind_entities) {
  read("<scene><a x=\"1 &lt;\r\n &#xB5; 2\"/></scene>");
  const Attribute& x = *child(*deck->root, "a").find("x");
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
  EXPECT_EQ(complaints.text(), "");
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
  EXPECT_THAT(complaints.text(), ::testing::AllOf(HasSubstr("100 MiB"), HasSubstr("<read-packing>")));
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
  EXPECT_EQ(child(*deck->root, "a").at.where(), "library/two.xml:2:35");
  EXPECT_EQ(deck->sources.size(), 3u);
  deck->scope.complain_about_unused(*deck->root, complaints);  // a library may define more than a deck needs
  EXPECT_EQ(complaints.text(), "");
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

// ---- What other tools write

TEST_F(ADeck, may_hold_what_is_meant_for_other_tools) {
  read(
      "<?xml version=\"1.0\"?>\n<!-- a remark -->\n<?xml-model href=\"a.xsd\"?>\n<?xml-stylesheet href=\"a.css\"?>\n"
      "<scene xml:lang=\"en\" xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" "
      "xsi:noNamespaceSchemaLocation=\"a.xsd\">"
      "<parameter name=\"p\" value=\"1\" xml:id=\"here\"/><include file=\"part.xml\" xml:base=\"x\"/><?other tool?>"
      "<a xmlns:xi=\"x\" xml:space=\"preserve\" q=\"${p}\"/></scene>\n<?end?>\n",
      {}, {{"part.xml", "<scene xmlns=\"x\" xsi:type=\"y\"/>"}});
  EXPECT_EQ(complaints.text(), "");
  ASSERT_EQ(child(*deck->root, "a").attributes.size(), 1u);
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
  EXPECT_EQ(complaints.text(), "");
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

// ---- Writing

TEST(ResolvedDeck, is_canonical_xml_that_reads_back) {
  const PlainNode scene{"scene", {{"name", "a \"b\" <c> & d\n\te"}}, {{"fill", {}, {{"a", {{"x", "1 m"}}, {}}}}}};
  const std::string xml = resolved_xml(scene);
  EXPECT_EQ(xml,
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<scene name=\"a &quot;b&quot; &lt;c&gt; &amp; "
            "d&#10;&#9;e\">\n"
            "  <fill>\n    <a x=\"1 m\"/>\n  </fill>\n</scene>\n");
  const std::string path = ::testing::TempDir() + "resolved.xml";
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
