#include <gtest/gtest.h>

#include <cmath>

#include "core/plugin/reading.hpp"

namespace beadwork {
namespace {

/// A force that rises to 12 N at 3 mm, falls to 1 N, and ends at 2 N.
CurveTable curve() {
  return parse_table(
      "step [1],displacement [mm],force [N],damaged share [1]\n"
      "0,0,0,0\n1,1,4,0\n2,2,8,0.1\n3,3,12,0.4\n4,4,6,0.8\n5,5,1,1\n6,6,2,1\n");
}

double read(const std::string& phrase) {
  const auto reading = parse_reading(phrase);
  EXPECT_TRUE(reading) << phrase;
  const NumberRead number = reading ? read_from(curve(), *reading) : NumberRead{};
  return reading && number.why == NumberRead::Why::read ? number.number.value : NAN;
}

TEST(Reading, of_values) {
  EXPECT_EQ(read("largest force"), 12);
  EXPECT_EQ(read("last force"), 2);
  EXPECT_EQ(read("last damaged share"), 1);
  EXPECT_EQ(read("displacement at the largest force"), 3e-3);
}

TEST(Reading, at_a_place_lies_between_the_rows) {
  EXPECT_DOUBLE_EQ(read("force at displacement 2.5 mm"), 10);
  EXPECT_DOUBLE_EQ(read("force at displacement 500 um"), 2);
  EXPECT_EQ(read("damaged share at displacement 3 mm"), 0.4);
  EXPECT_TRUE(std::isnan(read("force at displacement 7 mm")));
}

TEST(Reading, of_thresholds) {
  EXPECT_EQ(read("displacement where damaged share rises above 0"), 2e-3);
  EXPECT_EQ(read("displacement where force rises above 50 percent of its largest"), 2e-3);
  EXPECT_EQ(read("displacement where force rises above 11 N"), 3e-3);
  EXPECT_EQ(read("displacement where force falls below 60 percent of its largest"), 4e-3);  // behind the peak
  EXPECT_EQ(read("displacement where force falls below 1.5 N"), 5e-3);
  EXPECT_TRUE(std::isnan(read("displacement where force falls below 0.5 N")));
}

TEST(Reading, of_slopes_and_means_weights_by_the_way) {
  EXPECT_NEAR(read("slope of force over displacement from 0 mm to 3 mm"), 4000, 1e-9);
  EXPECT_NEAR(read("mean force for displacement from 3 mm to 5 mm"), (9 + 3.5) / 2, 1e-12);
}

TEST(Reading, has_the_dimension_of_what_is_read) {
  const auto dimension = [](const std::string& phrase) {
    return read_from(curve(), *parse_reading(phrase)).number.dimension.name();
  };
  EXPECT_EQ(dimension("largest force"), "N");
  EXPECT_EQ(dimension("displacement at the largest force"), "m");
  EXPECT_EQ(dimension("displacement where damaged share rises above 0.3"), "m");
  EXPECT_EQ(dimension("slope of force over displacement from 0 mm to 3 mm"), "N/m");
}

TEST(Reading, of_what_is_not_there_gives_nothing) {
  EXPECT_TRUE(std::isnan(read("largest stress")));
  EXPECT_TRUE(std::isnan(read("force at time 1 s")));
  EXPECT_TRUE(std::isnan(read("force at displacement 2 N")));  // a displacement is no force
  EXPECT_TRUE(std::isnan(read("displacement where force rises above 3 mm")));
  const auto why = [](const std::string& phrase) { return read_from(curve(), *parse_reading(phrase)); };
  EXPECT_EQ(read_from(CurveTable{}, *parse_reading("largest force")).reason, "there is no column 'force'");
  EXPECT_EQ(why("force at displacement 2 N").reason, "'displacement' is in mm");
  EXPECT_EQ(why("force at displacement 2 N").why, NumberRead::Why::not_there);
  EXPECT_EQ(why("force at displacement 7 mm").why, NumberRead::Why::not_reached);
}

TEST(Reading, of_a_force_that_presses_takes_shares_of_its_size) {
  const CurveTable pressed = parse_table("displacement [mm],force [N]\n0,0\n1,-4\n2,-8\n3,-12\n4,-6\n5,-0.5\n");
  const auto place = [&](const std::string& phrase) { return read_from(pressed, *parse_reading(phrase)).number.value; };
  EXPECT_EQ(place("displacement where force rises above 50 percent of its largest"), 2e-3);
  EXPECT_EQ(place("displacement where force falls below 5 percent of its largest"), 5e-3);
  EXPECT_EQ(place("largest force"), -12);
}

TEST(Reading, of_a_range_wants_all_of_it_and_takes_the_first_way_through) {
  EXPECT_TRUE(std::isnan(read("mean force for displacement from 5 mm to 7 mm")));
  EXPECT_DOUBLE_EQ(read("mean force for displacement from 0.5 mm to 1.5 mm"), 4);
  const CurveTable cycle = parse_table("displacement [mm],force [N]\n0,0\n1,10\n2,20\n3,30\n2,2\n1,1\n0,0\n");
  const auto of_cycle = [&](const std::string& phrase) {
    return read_from(cycle, *parse_reading(phrase)).number.value;
  };
  EXPECT_NEAR(of_cycle("slope of force over displacement from 0 mm to 2 mm"), 1e4, 1e-8);
  EXPECT_NEAR(of_cycle("mean force for displacement from 0 mm to 3 mm"), 15, 1e-12);
}

TEST(Reading, refuses_other_phrases) {
  for (const char* wrong :
       {"", "force", "largest", "largest ", "biggest force", "force at 3", "slope of force",
        "slope of force over displacement from 0 mm to 3 N", "mean force for displacement from 3 mm to 1 mm",
        "displacement where force is 3 N", "displacement where force rises above 3 N of its largest", "mean force"})
    EXPECT_FALSE(parse_reading(wrong)) << wrong;
}

}  // namespace
}  // namespace beadwork
