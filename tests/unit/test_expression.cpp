#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/deck/expression.hpp"
#include "core/deck/scope.hpp"

namespace beadwork {
namespace {

using testing::HasSubstr;

/// An expression over x (a length), n (a number) and the parameters that a test adds.
class AnExpression : public testing::Test {
 protected:
  void parameter(const std::string& name, const std::string& text) {
    scope.add({name, text, place(name), place(text)}, complaints);
  }

  static Location place(const std::string& text) {
    return {std::make_shared<const Source>(Source{"deck.xml", text}), 1, 1};
  }

  std::optional<Expression> compile(const std::string& text) {
    return Expression::compile(text, place(text), scope, variables, complaints);
  }

  double value(const std::string& text, double x = 0.002, double n = 3) {
    const auto expression = compile(text);
    EXPECT_TRUE(expression) << text << "\n" << complaints.text();
    return expression ? expression->evaluate(std::vector<double>{x, n}) : 0;
  }

  std::string unit(const std::string& text) {
    const auto expression = compile(text);
    EXPECT_TRUE(expression) << text << "\n" << complaints.text();
    return expression ? expression->dimension().name() : "";
  }

  /// The only complaint about a text, as "column: message".
  std::string complaint(const std::string& text) {
    Complaints fresh;
    EXPECT_FALSE(Expression::compile(text, place(text), scope, variables, fresh)) << text;
    const std::string all = fresh.text(), start = "deck.xml:1:", infix = ": error: ";
    const std::string first = all.substr(0, all.find('\n'));
    EXPECT_EQ(fresh.errors(), 1) << all;
    EXPECT_TRUE(first.starts_with(start)) << first;
    const std::size_t colon = first.find(infix);
    return first.substr(start.size(), colon - start.size()) + ": " + first.substr(colon + infix.size());
  }

  Complaints complaints;
  Scope scope;
  std::vector<Variable> variables{{"x", find_unit("m")->dimension}, {"n", {}}};
};

TEST_F(AnExpression, calculates_with_the_precedence_of_mathematics) {
  EXPECT_EQ(value("1 + 2*3"), 7);
  EXPECT_EQ(value("(1 + 2)*3"), 9);
  EXPECT_EQ(value("8/4/2"), 1);
  EXPECT_EQ(value("5 - 3 - 1"), 1);
  EXPECT_EQ(value("2^3^2"), 512);
  EXPECT_EQ(value("-2^2"), -4);
  EXPECT_EQ(value("2^-1"), 0.5);
  EXPECT_EQ(value("2*-n + -n - -n"), -6);
  EXPECT_EQ(value("1e-3 + 1.5E+1"), 15.001);
}

TEST_F(AnExpression, calculates_with_quantities_and_knows_their_dimension) {
  EXPECT_EQ(value("x + 13.5 mm"), 0.002 + 13.5e-3);
  EXPECT_EQ(value("2*x"), 0.004);
  EXPECT_EQ(unit("25 MPa * (2 mm)^2"), "N");
  EXPECT_EQ(unit("0.5 N/mm / x"), "Pa");
  EXPECT_EQ(unit("x/(1 mm)"), "1");
  EXPECT_EQ(unit("3mm"), "m");
  EXPECT_EQ(value("10 mm-2 mm"), 0.008);
  EXPECT_EQ(value("3 mm^2"), 3e-6);
  EXPECT_DOUBLE_EQ(value("(3 mm)^2"), 9e-6);
  EXPECT_EQ(value("50 percent * 4"), 2);
}

TEST_F(AnExpression, has_functions_that_follow_the_dimension) {
  EXPECT_EQ(value("sqrt(x*x)"), 0.002);
  EXPECT_EQ(unit("sqrt(x)"), "m^0.5");
  EXPECT_EQ(unit("abs(-x)"), "m");
  EXPECT_EQ(value("min(x, 1 mm, 3 mm)"), 0.001);
  EXPECT_EQ(value("max(x, 1 mm)"), 0.002);
  EXPECT_EQ(value("if(x < 3 mm, x, 0 m)"), 0.002);
  EXPECT_EQ(value("if(x > 3 mm, x, 0 m)"), 0);
  EXPECT_DOUBLE_EQ(value("sin(pi/6) + cos(60 degree)"), 1);
  EXPECT_DOUBLE_EQ(value("log(exp(n)) + ln(exp(1)) + log10(100)"), 6);
  EXPECT_EQ(value("floor(2.5) + ceil(2.5) + round(2.6) + sign(-x)"), 7);
  EXPECT_DOUBLE_EQ(value("atan2(x, x) + atan(1) + asin(0) + acos(1) + tan(0)"), std::numbers::pi / 2);
}

TEST_F(AnExpression, may_be_a_condition) {
  ASSERT_TRUE(compile("x < 13.5 mm"));
  EXPECT_TRUE(compile("x < 13.5 mm")->is_condition());
  EXPECT_FALSE(compile("x")->is_condition());
  for (const char* is_true : {"x < 3 mm and n == 3", "x >= 2 mm && n != 2", "not x > 3 mm", "n <= 3 or n > 10",
                              "not (n < 1 || n > 5)", "n < 1 or n > 2 and x > 1 mm", "if(n > 1, x < 1 m, n > 5)"})
    EXPECT_EQ(value(is_true), 1) << is_true;
  for (const char* is_false : {"x < 1 mm", "n == 3 and x > 1 m", "not n == 3 and n == 3"})
    EXPECT_EQ(value(is_false), 0) << is_false;
}

TEST_F(AnExpression, takes_names_of_parameters_with_dots_and_hyphens) {
  parameter("epoxy.radius-ratio", "0.25");
  parameter("a", "7");
  parameter("b", "2");
  parameter("a-b", "100");
  EXPECT_EQ(value("epoxy.radius-ratio*2"), 0.5);
  EXPECT_EQ(value("epoxy.radius-ratio-1"), -0.75);
  EXPECT_EQ(value("a-b"), 100);  // the longest name wins
  EXPECT_EQ(value("a - b"), 5);
  EXPECT_EQ(value("b-a"), -5);
  EXPECT_EQ(value("n-a"), -4);
  EXPECT_EQ(value("${a} + ${b - 1}"), 8);
}

TEST_F(AnExpression, refuses_to_add_or_compare_what_has_another_dimension) {
  EXPECT_EQ(complaint("x + n"), "3: the two sides of '+' differ: the left is in m, the right is a plain number");
  EXPECT_EQ(complaint("x < 3"), "3: the two sides of '<' differ: the left is in m, the right is a plain number");
  EXPECT_EQ(complaint("(1 + n)*(x - 25 MPa)"), "12: the two sides of '-' differ: the left is in m, the right is in Pa");
  EXPECT_EQ(complaint("max(x, 2)"), "6: the arguments differ: the left is in m, the right is a plain number");
}

TEST_F(AnExpression, takes_a_zero_without_a_unit_for_any_quantity) {
  parameter("nothing", "0");
  parameter("zero-length", "0 mm");
  for (const char* is_true :
       {"x > 0", "0 < x", "x >= nothing", "x > zero-length", "-x <= -0", "x != 0 and n != 0", "x + 0 == 0 + x"})
    EXPECT_EQ(value(is_true), 1) << is_true;
  EXPECT_EQ(unit("0 - x"), "m");
  EXPECT_EQ(unit("max(0, x)"), "m");
  EXPECT_EQ(unit("if(n > 1, 0, x)"), "m");
  EXPECT_EQ(complaint("x > 0 N"), "3: the two sides of '>' differ: the left is in m, the right is in N");
  EXPECT_EQ(complaint("x > 1"), "3: the two sides of '>' differ: the left is in m, the right is a plain number");
  EXPECT_THAT(complaint("x > n - n"), HasSubstr("the right is a plain number")) << "only what is 0 whatever happens";
  EXPECT_TRUE(compile("0")->has_dimension(find_unit("N")->dimension));
  EXPECT_FALSE(compile("0 m")->has_dimension(find_unit("N")->dimension));
  EXPECT_FALSE(compile("n")->has_dimension(find_unit("N")->dimension));
}

TEST_F(AnExpression, takes_several_signs_before_an_operand) {
  EXPECT_EQ(value("--5"), 5);
  EXPECT_EQ(value("---5"), -5);
  EXPECT_EQ(value("3 - -+-2"), 1);
  EXPECT_EQ(value("2^--2"), 4);
  EXPECT_EQ(value("--2^2"), 4);
  EXPECT_EQ(value("2*--n"), 6);
  EXPECT_EQ(value("abs(- -x)"), 0.002);
  for (const char* is_true :
       {"not -x > 1 mm", "not not n == 3", "not - -n < 0 and n > 0", "not not not n < 1", "n < 1 or not +n == 2",
        "if(not -n > 0, not -n > 0, n > 9)", "(not -x > 1 mm) and not --x < 1 mm"})
    EXPECT_EQ(value(is_true), 1) << is_true;
  for (const char* is_false : {"not -n < 0 or n < 0", "not not -x > 1 mm"}) EXPECT_EQ(value(is_false), 0) << is_false;
  EXPECT_THAT(complaint("--(n < 1)"), HasSubstr("a condition is no number"));
  EXPECT_EQ(complaint("not -"), "5: an operator cannot stand here");
  EXPECT_EQ(complaint("n - - "), "7: cannot be understood");
  EXPECT_EQ(complaint("-not n < 1"), "2: an operator cannot stand here");
}

TEST_F(AnExpression, names_a_sign_that_only_looks_like_the_one_that_is_meant) {
  EXPECT_EQ(complaint("n \u2212 1"), "3: '\u2212' (U+2212; write -) means nothing in an expression");
  EXPECT_EQ(complaint("n \u2264 1"), "3: '\u2264' (U+2264; write <=) means nothing in an expression");
  EXPECT_EQ(complaint("n \u00A7 1"), "3: '\u00A7' (U+00A7) means nothing in an expression");
  EXPECT_EQ(complaint("x < 1 mm\u2212x"), "9: '\u2212' (U+2212; write -) means nothing in an expression");
}

TEST_F(AnExpression, as_deep_and_as_long_as_may_be_harms_nothing) {
  const auto repeated = [](const std::string& piece, int times) {
    std::string text;
    for (int i = 0; i < times; ++i) text += piece;
    return text;
  };
  EXPECT_EQ(value(std::string(1900, '(') + "n" + std::string(1900, ')')), 3);
  EXPECT_EQ(value(std::string(3900, '-') + "n"), 3);
  EXPECT_EQ(value(repeated("abs(", 700) + "n" + std::string(700, ')')), 3);
  EXPECT_EQ(value(repeated("not ", 900) + "n == 3"), 1);
  EXPECT_EQ(value(repeated("n == 3 and ", 350) + "n == 3"), 1);
  EXPECT_EQ(value(repeated("if(n == 3, ", 250) + "n" + repeated(", 2)", 250)), 3);
  EXPECT_EQ(value(repeated("2^", 1500) + "1"), INFINITY);
}

TEST_F(AnExpression, is_checked_in_the_branch_that_is_not_taken_too) {
  EXPECT_THAT(complaint("if(1 < 2, x, n)"), HasSubstr("the arguments differ"));
  EXPECT_THAT(complaint("if(1 < 2, x, x + n)"), HasSubstr("'+' differ"));
  EXPECT_THAT(complaint("n < 1 and x < 1"), HasSubstr("'<' differ"));
}

TEST_F(AnExpression, refuses_functions_and_powers_that_make_no_sense) {
  EXPECT_EQ(complaint("n + sin(x)"), "9: this function wants a plain number, this is in m");
  EXPECT_EQ(complaint("2^x"), "3: an exponent wants a plain number, this is in m");
  EXPECT_EQ(complaint("x^n"), "3: the exponent of a quantity with a unit must be the same everywhere");
  EXPECT_THAT(complaint("1 < n < 3"), HasSubstr("join conditions with and"));
  EXPECT_THAT(complaint("n and x < 1 m"), HasSubstr("this is a plain number"));
}

TEST_F(AnExpression, points_at_the_misspelt_name_with_a_suggestion) {
  parameter("side", "28 um");
  EXPECT_EQ(complaint("2*sied"), "3: no parameter 'sied'. Did you mean 'side'?");
  EXPECT_EQ(complaint("x < 13.5 mmm"), "10: unknown unit \"mmm\". Did you mean \"mm\"?");
  EXPECT_EQ(complaint("x < 3 N/mmm"), "9: unknown unit \"mmm\". Did you mean \"mm\"?");
  EXPECT_EQ(complaint("x < mm"), "5: no parameter 'mm'; a unit needs a number before it: 1 mm");
  EXPECT_EQ(complaint("squirt(x)"), "1: no function 'squirt'");
}

TEST_F(AnExpression, points_at_what_is_wrong_in_the_grammar) {
  EXPECT_EQ(complaint("n + "), "5: the expression ends too early");
  EXPECT_EQ(complaint("* n"), "1: an operator cannot stand here");
  EXPECT_EQ(complaint("n n"), "3: an operator is missing before this");
  EXPECT_EQ(complaint("2 n"), "3: an operator is missing between '2' and 'n'");
  EXPECT_EQ(complaint("2*(n"), "3: this bracket is not closed");
  EXPECT_EQ(complaint("n)"), "2: no bracket is open that ')' could close");
  EXPECT_EQ(complaint("0,3"), "2: a comma cannot stand here; decimals have a point");
  EXPECT_EQ(complaint("(0,3)"), "3: a comma cannot stand here; decimals have a point");
  EXPECT_EQ(complaint(""), "1: an expression is wanted here");
  EXPECT_THAT(complaint("sqrt(n, n)"), HasSubstr("too many arguments"));
  EXPECT_THAT(complaint("if(n > 1, 2)"), HasSubstr("too few arguments"));
  EXPECT_THAT(complaint("n = 3"), HasSubstr("write =="));
  EXPECT_THAT(complaint("n > 1 ? 2 : 3"), HasSubstr("write if("));
  EXPECT_THAT(complaint("1e999"), HasSubstr("out of range"));
  EXPECT_THAT(complaint("3 mm^n"), HasSubstr("write (3 mm)^"));
  EXPECT_THAT(complaint(std::string(200'000, '(')), HasSubstr("longer than"));
}

TEST_F(AnExpression, is_spelt_out_without_parameters_in_si) {
  parameter("L", "12 mm"), parameter("notch", "-1.6 mm"), parameter("k", "3"), parameter("debt", "-2");
  parameter("per", "${1/(3 mm)^2/7 s}"), parameter("M", "0.1 N.mm"), parameter("odd", "${2 MPa*(3 mm)^0.5}");
  const auto spelt = [&](const std::string& text) { return compile(text)->text(); };
  EXPECT_EQ(spelt("x<L/2 and not(n>=k||x==0 m)"), "x < 0.012 m / 2 and not (n >= 3 or x == 0 m)");
  EXPECT_EQ(spelt("L-notch"), "0.012 m - (-0.0016 m)");
  EXPECT_EQ(spelt("-L^2"), "-(0.012 m) ^ 2");
  EXPECT_EQ(spelt("${debt^2}*30 percent"), "((-2) ^ 2) * 0.3");
  EXPECT_EQ(spelt("max( L ,2 um,-x)*pi"), "max(0.012 m, 2e-06 m, -x) * pi");
  EXPECT_EQ(spelt("2*M"), "2 * 1e-04 J");
  EXPECT_EQ(spelt("per*x"), "15873.015873015873 m^-2.s^-1 * x");
  const Scope nothing;
  for (const std::string text : {"x<L/2", "L-notch", "-L^2", "debt^k^2/7", "if(x>L,odd*3,odd)^2", "per*per/odd", "k-n",
                                 "2*-debt", "atan2(notch,x)*1/3", "sqrt(L*L+x^2)/0.1 um", "1e-7 m*n",
                                 "x>0.3 mm or n<k and x<L", "(x<L)&&not(n<debt)", "25.4 min * per * x"}) {
    const auto first = compile(text);
    ASSERT_TRUE(first) << text << complaints.text();
    const auto again = Expression::compile(first->text(), place(first->text()), nothing, variables, complaints);
    ASSERT_TRUE(again) << first->text() << complaints.text();
    EXPECT_EQ(again->text(), first->text());
    EXPECT_TRUE(again->dimension() == first->dimension());
    for (const double x : {0.0, 1e-3 / 3, -7.7, 1e12}) {
      const std::vector<double> at{x, 3 * x - 1};
      const double wanted = first->evaluate(at), got = again->evaluate(at);
      EXPECT_TRUE(wanted == got || (std::isnan(wanted) && std::isnan(got)))
          << text << " " << first->text() << " " << wanted << " " << got;
    }
  }
}

TEST_F(AnExpression, asks_back_where_a_name_is_both_a_unit_and_a_parameter) {
  parameter("t", "2 mm");
  EXPECT_THAT(complaint("10 mm/t"), HasSubstr("both a unit and a name"));
  EXPECT_EQ(value("10 mm / t"), 5);
}

TEST_F(AnExpression, asks_back_where_a_parameter_hides_behind_a_variable) {
  parameter("n", "2");
  EXPECT_THAT(complaint("n + 1"), HasSubstr("rename the parameter"));
}

TEST_F(AnExpression, gives_the_column_behind_entities_and_line_ends) {
  const std::string text = "n &gt; 1 and\n  x";
  EXPECT_FALSE(Expression::compile("n > 1 and\n  x", place(text), scope, variables, complaints));
  EXPECT_THAT(complaints.text(), HasSubstr("deck.xml:2:3: "));
}

TEST_F(AnExpression, tells_a_nan_instead_of_calling_it_false) {
  EXPECT_TRUE(std::isnan(value("sqrt(-n) < 1")));
  EXPECT_TRUE(std::isnan(value("not sqrt(-n) < 1")));
  EXPECT_TRUE(std::isnan(value("min(1, sqrt(-n))")));
  EXPECT_TRUE(std::isinf(value("1/(n - n)")));
  EXPECT_EQ(value("if(n > 0, 1, sqrt(-n))"), 1);  // the branch that is not taken does no harm
}

TEST_F(AnExpression, says_on_which_variables_it_depends) {
  EXPECT_TRUE(compile("2*x")->uses(0));
  EXPECT_FALSE(compile("2*x")->uses(1));
}

TEST_F(AnExpression, of_any_length_is_evaluated) {
  std::string sum = "n";
  for (int i = 0; i < 500; ++i) sum += " + n";
  EXPECT_EQ(value(sum), 501 * 3);
}

// Each slope against the quotient of differences at places where nothing bends.
TEST_F(AnExpression, knows_its_slope) {
  for (const std::string text :
       {"n^2 + 3*n - 1/n", "2^n", "n^n", "sqrt(n)*n", "sin(n)*cos(2*n) + tan(n/5)", "asin(n/9) + acos(n/8) + atan(n)",
        "atan2(n, 2) + atan2(2, n)", "exp(-n) + ln(n) + log10(n)", "abs(1 - n) + abs(n)", "min(n, 4) + max(2*n, 1)",
        "if(n > 2, n^2, 7)", "floor(n + 0.3) + sign(n) + n", "-n*(x/1 mm)", "(n^2)^0.5"}) {
    const auto expression = compile(text);
    ASSERT_TRUE(expression) << text << complaints.text();
    const double n = 2.6, h = 1e-5;
    const auto at = [&](double value) { return expression->evaluate(std::vector<double>{0.002, value}); };
    const auto found = expression->evaluate_with_slope(std::vector<double>{0.002, n}, 1);
    EXPECT_EQ(found.value, at(n)) << text;
    EXPECT_NEAR(found.slope, (at(n + h) - at(n - h)) / (2 * h), 1e-8 * std::max(1.0, std::abs(found.slope))) << text;
  }
}

TEST_F(AnExpression, what_does_not_change_has_no_slope_where_others_have_none_that_is_finite) {
  EXPECT_EQ(compile("sqrt(0*n) + 0^1.5 + abs(n)")->evaluate_with_slope(std::vector<double>{0, 0}, 1).slope, 1);
  EXPECT_EQ(compile("n^2")->evaluate_with_slope(std::vector<double>{0, 0}, 1).slope, 0);
}

TEST_F(AnExpression, knows_where_it_bends) {
  using testing::ElementsAre;
  using testing::IsEmpty;
  EXPECT_THAT(compile("if(n < 5, 1, 2) + abs(3 - n)")->kinks(1), ElementsAre(3, 5));
  EXPECT_THAT(compile("max(2*n - 1, 0)*min(n/4, (n - 3)*2)")->kinks(1), ElementsAre(0.5, 24.0 / 7));
  EXPECT_THAT(compile("if(n > 1 and n <= 1.5 or not (n + 1) == 9, 1, 2)")->kinks(1), ElementsAre(1, 1.5, 8));
  EXPECT_THAT(compile("abs(sin(n)) + n^2 + if(x > 1 mm, 1, 2)")->kinks(1), IsEmpty());
  EXPECT_THAT(compile("if(n/0 < 5, 1, 2)")->kinks(1), IsEmpty());
}

}  // namespace
}  // namespace beadwork
