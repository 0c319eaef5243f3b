// What stands in a deck's attributes: parameters, expressions, and values of every kind.
#include <gmock/gmock.h>

#include "tests/support/a_deck.hpp"

namespace beadwork {
namespace {

using testing::ADeck;
using ::testing::HasSubstr;

// ---- Parameters

TEST_F(ADeck, works_out_parameters_that_use_earlier_and_later_ones) {
  read(
      "<scene><parameter name=\"half\" value=\"${side/2}\"/><parameter name=\"side\" value=\"28 um\"/><a "
      "q=\"${half + 1 um}\"/></scene>");
  EXPECT_DOUBLE_EQ(*read_quantity(attribute("q"), "m", deck->scope, complaints), 15e-6);
  deck->scope.complain_about_unused(*deck->root, complaints);
  EXPECT_EQ(complaints.text(), "");
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

TEST_F(ADeck, cannot_be_blown_up_by_parameters) {
  std::string text = "<scene><parameter name=\"p0\" value=\"0123456789\"/>",
              chain = "<scene><parameter name=\"p0\" value=\"1\"/>";
  for (int i = 1; i <= 60; ++i) {
    const std::string name = "p" + std::to_string(i), before = "${p" + std::to_string(i - 1) + "}";
    text += "<parameter name=\"" + name + "\" value=\"" + before + " " + before + "\"/>";
  }
  read(text + "<a t=\"${p60}\" v=\"${p60}\"/></scene>");
  EXPECT_FALSE(read_text(attribute("t"), deck->scope, complaints));
  EXPECT_FALSE(read_vector(attribute("v"), "1", deck->scope, complaints));
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
  EXPECT_FALSE(read_vector(attribute("q"), "m", deck->scope, complaints));
  EXPECT_FALSE(read_words(attribute("w"), deck->scope, complaints));
  EXPECT_FALSE(read_vector(attribute("n"), "1", deck->scope, complaints));
  EXPECT_FALSE(read_words(attribute("n"), deck->scope, complaints));
  EXPECT_THAT(complaints.text(), HasSubstr("deck.xml:2:7: error: 'q' wants three values such as"));
  EXPECT_THAT(complaints.text(), HasSubstr("a value of more than 1000000 characters: data belong into a file"));
  EXPECT_THAT(complaints.text(), HasSubstr("these are more than 10000 values"));
  EXPECT_EQ(complaints.errors(), 4) << complaints.text();
  EXPECT_LT(complaints.text().size(), 20'000u);
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
  EXPECT_EQ(complaints.text(), "");
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
  EXPECT_EQ(complaints.text(), "");
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
  EXPECT_EQ(complaints.text(), "");
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

}  // namespace
}  // namespace beadwork
