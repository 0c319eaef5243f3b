#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <thread>

#include "core/base/units.hpp"

namespace beadwork {
namespace {

double si(double value, const std::string& unit) {
  const auto found = find_unit(unit);
  EXPECT_TRUE(found) << unit;
  return found ? found->to_si(value) : 0;
}

TEST(Units, those_of_the_trade_are_known) {
  EXPECT_EQ(si(1, "N/mm"), 1000);
  EXPECT_EQ(si(1, "N/mm^3"), 1e9);
  EXPECT_EQ(si(1, "t/mm^3"), 1e12);  // t is the tonne
  EXPECT_EQ(si(1.2, "g/cm^3"), 1200);
  EXPECT_EQ(si(36, "km/h"), 10);
  EXPECT_EQ(si(2, "percent"), 0.02);
  EXPECT_EQ(si(3.9, "GPa"), 3.9e9);
  EXPECT_DOUBLE_EQ(si(1, "MPa.m^0.5"), 1e6);
  EXPECT_DOUBLE_EQ(si(180, "degree"), std::numbers::pi);
  EXPECT_DOUBLE_EQ(si(180, "deg"), si(180, "degree"));
  for (const char* same : {"um", "\u00B5m", "\u03BCm"}) EXPECT_EQ(si(1, same), 1e-6);
}

TEST(Units, one_unit_may_be_spelt_in_several_ways) {
  const auto energy = find_unit("J/m2");
  ASSERT_TRUE(energy);
  for (const char* same : {"J/m^2", "J.m-2", "J*m^-2", "N/m", "kg.s-2", "kg/s/s", "1/m*N"})
    EXPECT_TRUE(find_unit(same) && find_unit(same)->dimension == energy->dimension) << same;
  EXPECT_TRUE(find_unit("1/s")->dimension == find_unit("Hz")->dimension);
}

TEST(Units, a_small_one_gives_the_number_that_a_reader_would_write) {
  EXPECT_EQ(si(14, "um"), 14e-6);
  EXPECT_EQ(si(19, "um"), 19e-6);  // 19 * 1e-6 is another number
  EXPECT_EQ(si(13.5, "mm"), 13.5e-3);
}

TEST(Units, what_is_none_is_refused) {
  for (const char* bad : {"", "mmm", "N mm", "m)", "5 m", "mm@5", "lg(re 1 mW)", "m^", "m/", "/s", "degC", "\xff", "2",
                          "m^x", "m//s", "m^999999", "seconds since 1970"})
    EXPECT_FALSE(find_unit(bad)) << bad;
}

TEST(Units, a_misspelt_one_is_answered_with_a_suggestion) {
  EXPECT_EQ(why_no_unit("MPA"), "unknown unit \"MPA\". Did you mean \"MPa\"?");
  EXPECT_EQ(why_no_unit("N/mmm"), "unknown unit \"N/mmm\" ('mmm'). Did you mean \"mm\"?");
  EXPECT_THAT(why_no_unit("degC"), testing::HasSubstr("offset"));
}

TEST(Units, angles_are_plain_numbers) {
  EXPECT_TRUE(find_unit("rad")->dimension.is_plain());
  EXPECT_EQ(find_unit("rad/s")->dimension.name(), "1/s");
}

TEST(Units, a_dimension_has_a_name_that_reads_back) {
  for (const char* unit : {"Pa", "N/m", "Pa/m", "N", "J", "W", "m^2", "m/s^2", "kg/m^3", "kg.m^2/s", "1/s", "1",
                           "Pa.m^0.5", "mol/m^3", "cd", "A.s", "J/kg/K"}) {
    const Dimension dimension = find_unit(unit)->dimension;
    ASSERT_TRUE(find_unit(dimension.name())) << dimension.name();
    EXPECT_EQ(find_unit(dimension.name())->dimension, dimension) << unit;
    EXPECT_EQ(find_unit(dimension.name())->scale, 1) << unit;
  }
  EXPECT_EQ(find_unit("MPa")->dimension.name(), "Pa");
  EXPECT_EQ(find_unit("m/s")->dimension.name(), "m/s");
}

TEST(Units, roots_and_powers_of_dimensions_come_back) {
  const Dimension length = find_unit("m")->dimension;
  EXPECT_EQ(power(power(length, 0.5), 2), length);
  EXPECT_EQ(power(length * length * length, 1.0 / 3), length);
  EXPECT_FALSE(power(length, 0.5) == length);
}

TEST(Units, a_value_is_written_in_the_unit_that_is_asked_for) {
  EXPECT_EQ(format_quantity(0.014, "mm"), "14 mm");
  EXPECT_EQ(format_quantity(0.3, "1"), "0.3");
  EXPECT_EQ(format_quantity(Quantity{2.5e7, find_unit("Pa")->dimension}), "2.5e+07 Pa");
}

TEST(Units, a_number_with_its_unit_is_read_and_written) {
  const auto amount = parse_amount(" 30\tGPa ");
  ASSERT_TRUE(amount);
  EXPECT_EQ(amount->value, 30);
  EXPECT_EQ(amount->quantity().value, 30e9);
  EXPECT_EQ(amount->text(), "30 GPa");
  ASSERT_TRUE(parse_amount("3"));
  EXPECT_EQ(parse_amount("3")->text(), "3");
  EXPECT_TRUE(parse_amount("3")->quantity().dimension.is_plain());
  for (const char* none : {"", " ", "GPa", "30 GPA", "30GPa", "2 * 15 GPa", "30 GPa 2", "0,3 m"})
    EXPECT_FALSE(parse_amount(none)) << none;
}

TEST(Units, in_an_expression_the_unit_ends_where_it_must) {
  EXPECT_EQ(find_leading_unit("mm)")->length, 2u);
  EXPECT_EQ(find_leading_unit("N/mm^3 + x")->length, 6u);
  EXPECT_EQ(find_leading_unit("N*xyz")->length, 1u);
  EXPECT_EQ(find_leading_unit("mm-2 mm")->length, 2u);  // a difference, not mm^-2
  EXPECT_EQ(find_leading_unit("s^-1")->length, 4u);
  EXPECT_FALSE(find_leading_unit("xyz"));
  EXPECT_THAT(find_leading_unit("N/mm")->later_names, testing::ElementsAre("mm"));
}

TEST(Units, several_threads_may_ask_at_once) {
  const auto ask = [] {
    for (int i = 0; i < 2000; ++i) EXPECT_EQ(find_unit(i % 2 ? "kN/mm" : "mJ/cm^2")->dimension.name(), "N/m");
  };
  std::thread other(ask);
  ask();
  other.join();
}

}  // namespace
}  // namespace beadwork
