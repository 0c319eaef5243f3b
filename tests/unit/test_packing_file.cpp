#include "core/io/packing_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/base/failure.hpp"
#include "core/io/packing_columns.hpp"

namespace beadwork {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::filesystem::path file_with(const std::string& text) {
  const auto file = std::filesystem::temp_directory_path() / ("packing-" + std::to_string(::getpid()) + ".csv");
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

StoredPacking packing_in(const std::string& text, const TextForm& form = {}) {
  return read_packing(file_with(text), form);
}

std::string refusal_of(const std::string& text, const TextForm& form = {}) {
  try {
    packing_in(text, form);
  } catch (const DeckFailure& failure) {
    return failure.what();
  }
  return "it was read";
}

void expect_two_elements(const std::string& text, const TextForm& form = {}) {
  const StoredPacking packing = packing_in(text, form);
  ASSERT_EQ(packing.position.size(), 2u) << text;
  EXPECT_EQ(packing.position[0], Vec3(0, 0, 0)) << text;
  EXPECT_EQ(packing.position[1], Vec3(2e-3, 0.5e-3, -1e-3)) << text;
  EXPECT_THAT(packing.radius, ElementsAre(1e-3, 0.75e-3)) << text;
}

TEST(PackingFile, lines_of_four_numbers_are_elements_in_the_unit_asked_for) {
  expect_two_elements("0,0,0,1\n# a remark\n2,0.5,-1,0.75\n", {.unit = "mm"});
  expect_two_elements("0 0 0 .001\n\n  2e-3\t0.5e-3 -1e-3 0.75e-3");
}

TEST(PackingFile, columns_are_told_by_their_names_in_any_order) {
  const TextForm mm{.unit = "mm"};
  expect_two_elements("x,y,z,r\n0,0,0,1\n2,0.5,-1,0.75\n", mm);
  expect_two_elements("r,x,y,z\n1,0,0,0\n0.75,2,0.5,-1\n", mm);
  expect_two_elements("x,y,z,diameter\n0,0,0,2\n2,0.5,-1,1.5\n", mm);
  expect_two_elements("Radius Z Y X\n1 0 0 0\n.75 -1 .5 2\n", mm);
  expect_two_elements("\"id\";\"x\";\"y\";\"z\";\"D\"\n17;0;0;0;2\n4;2;0.5;-1;1.5\n", mm);
}

TEST(PackingFile, columns_state_their_units) {
  expect_two_elements("x [m],y [m],z [m],r [m]\n0,0,0,0.001\n0.002,0.0005,-0.001,0.00075\n");
  expect_two_elements("x [mm] y [mm] z [mm] r [um]\n0 0 0 1000\n2 .5 -1 750\n");
  expect_two_elements("x (mm)\ty (mm)\tz (mm)\tr (mm)\n0\t0\t0\t1\n2\t.5\t-1\t.75\n", {.unit = "mm"});
  expect_two_elements("x_mm;y_mm;z_mm;d_mm\n0;0;0;2\n2;.5;-1;1.5\n");
  expect_two_elements("x/mm, y/mm, z/mm, r / mm\n0,0,0,1\n2,.5,-1,.75\n");
}

TEST(PackingFile, a_unit_that_is_not_that_of_the_deck_is_refused) {
  EXPECT_THAT(refusal_of("x [m],y [m],z [m],r [m]\n0,0,0,1\n", {.unit = "mm"}),
              HasSubstr(":1:1: error: column 'x' is in m, but the deck says unit=\"mm\""));
  EXPECT_THAT(refusal_of("x [mm],y [mm],z [mm],r\n0,0,0,1\n"),
              HasSubstr(":1:22: error: column 'r' has no unit, others have one"));
  EXPECT_THAT(refusal_of("x [mm],y [mm],z [mm],r [kg]\n0,0,0,1\n"),
              HasSubstr(":1:22: error: column 'r' wants a unit of length"));
}

TEST(PackingFile, columns_that_make_no_element_are_refused) {
  EXPECT_THAT(refusal_of("x,y,z,size\n0,0,0,1\n"),
              HasSubstr(":1:1: error: the columns lack radius (r) or diameter (d)"));
  EXPECT_THAT(refusal_of("x,y,r\n0,0,1\n"), HasSubstr("the columns lack z"));
  EXPECT_THAT(refusal_of("x,y,z,r,d\n0,0,0,1,2\n"), HasSubstr("name radius (r) or diameter (d) more than once"));
}

TEST(PackingFile, a_column_of_something_else_is_passed_over_with_a_word) {
  const StoredPacking packing = packing_in("x,y,z,r,temperature\n0,0,0,1,hot\n2,0,0,1,cold\n");
  EXPECT_EQ(packing.position.size(), 2u);
  EXPECT_THAT(packing.warnings, ElementsAre(HasSubstr("not read: column 'temperature'")));
}

TEST(PackingFile, the_deck_may_say_what_the_columns_hold) {
  expect_two_elements("1,0,0,0\n.75,2,.5,-1\n", {.unit = "mm", .columns = {"r", "x", "y", "z"}});
  expect_two_elements("a,b,c,e,f\n9,0,0,0,1\n9,2,.5,-1,.75\n",
                      {.unit = "mm", .columns = {"-", "x", "y", "z", "radius"}});
  expect_two_elements("# x y z r, or so\n2,0,0,0\n1.5,2,.5,-1\n", {.columns = {"d_mm", "x_mm", "y_mm", "z_mm"}});
  EXPECT_THAT(refusal_of("x,y,z,r\n0,0,0,1\n", {.columns = {"r", "x", "y", "z"}}),
              HasSubstr(":1:1: error: this column is called \"x\" here, and \"r\" by 'columns'"));
  EXPECT_THAT(refusal_of("0,0,0,1\n", {.columns = {"x", "y", "z", "r", "id"}}),
              HasSubstr(":1:1: error: a line holds 5 columns, x y z r id, here are 4"));
  EXPECT_THAT(why_no_columns({"x", "y", "z"}), HasSubstr("lack radius"));
  EXPECT_THAT(why_no_columns({"x", "y", "z", "mass"}), HasSubstr("no column is called \"mass\""));
  EXPECT_EQ(why_no_columns({"-", "x", "y", "z_um", "D"}), "");
}

TEST(PackingFile, a_remark_names_the_columns_where_it_can) {
  expect_two_elements("# columns: x y z r\n0 0 0 0.001\n0.002 0.0005 -0.001 0.00075\n");
  expect_two_elements("# made by a script\n# r x y z\n1 0 0 0\n.75 2 .5 -1\n", {.unit = "mm"});
  expect_two_elements("# x of the elements stands first\n0 0 0 1\n2 .5 -1 .75\n", {.unit = "mm"});
  EXPECT_THAT(refusal_of("# x y z and the radius\n0 0 0 1\n"), HasSubstr(":2:1: error: a line holds 6 columns"));
}

TEST(PackingFile, names_stand_in_front_of_all_elements_and_only_there) {
  EXPECT_THAT(refusal_of("0 0 0 1\nx y z r\n"), HasSubstr(":2:1: error"));
  EXPECT_THAT(refusal_of("x y z r\nin mm and mm\n0 0 0 1\n"),
              HasSubstr(":2:1: error: a line holds 4 numbers, x y z r (as line 1 names them), got \"in\""));
}

TEST(PackingFile, a_first_element_with_a_slip_is_not_taken_for_names) {
  EXPECT_THAT(refusal_of("O,0,0,1\n2,0,0,1\n"),
              HasSubstr(":1:1: error: a line holds 4 numbers, x y z radius, got \"O\""));
}

TEST(PackingFile, a_comma_in_a_number_is_named) {
  EXPECT_THAT(refusal_of("0,5;0;0;1\n"),
              HasSubstr(":1:1: error: a line holds 4 numbers, x y z radius, got \"0,5\"; a decimal has a point: 0.5"));
  EXPECT_THAT(refusal_of("0,5;0,5;0,5;1,0\n"), HasSubstr("a decimal has a point: 0.5"));
  EXPECT_THAT(refusal_of("0,5 0,5 0,5 1,0\n"), HasSubstr("here are 5; a decimal has a point"));
}

TEST(PackingFile, the_mark_that_spreadsheets_put_first_costs_no_element) {
  EXPECT_EQ(packing_in("\xEF\xBB\xBF"
                       "0,0,0,1\r\n2,0,0,1\r\n")
                .position.size(),
            2u);
  EXPECT_EQ(packing_in("\xEF\xBB\xBF"
                       "x,y,z,r\r\n0,0,0,1\r\n2,0,0,1\r\n")
                .position.size(),
            2u);
}

TEST(PackingFile, a_line_that_is_no_element_is_named) {
  EXPECT_THAT(refusal_of("0 0 0 1\n1 2 3\n"),
              HasSubstr(":2:1: error: a line holds 4 numbers, x y z radius, here are 3"));
  EXPECT_THAT(refusal_of("0 0 0 1\n1 2 3 r\n"), HasSubstr(":2:7: error"));
  EXPECT_THAT(refusal_of("0 0 0 1\n1 2 nan 1\n"), HasSubstr(":2:5: error"));
  EXPECT_THAT(refusal_of("3\nLattice=\"1 0 0\"\nA 0 0 0 1\n"),
              HasSubstr(":1:1: error: a line holds 4 numbers, x y z radius, here are 1"));
}

TEST(PackingFile, elements_without_extent_and_empty_files_are_refused) {
  EXPECT_THAT(refusal_of("0 0 0 -1\n"), HasSubstr(":1:7: error: a radius must be > 0, got \"-1\""));
  EXPECT_THAT(refusal_of("x y z d\n0 0 0 0\n"), HasSubstr(":2:7: error: a diameter must be > 0"));
  EXPECT_THAT(refusal_of("# nothing\n"), HasSubstr("no element"));
}

TEST(PackingFile, a_line_that_stands_there_twice_is_warned_of) {
  EXPECT_THAT(packing_in("0 0 0 1\n2 0 0 1\n0 0 0 1\n").warnings,
              ElementsAre(HasSubstr(":3: the element of line 1 has the same place")));
  EXPECT_TRUE(packing_in("0 0 0 1\n2 0 0 1\n").warnings.empty());
}

TEST(PackingFile, a_column_names_the_set_of_each_element) {
  const StoredPacking packing = packing_in("x y z r set\n0 0 0 1 fibre\n2 0 0 1 resin\n4 0 0 1 fibre\n");
  EXPECT_THAT(packing.sets.at("fibre"), ElementsAre(0u, 2u));
  const StoredPacking fibre = part_of(packing, "fibre", "balls.csv");
  EXPECT_THAT(fibre.position, ElementsAre(Vec3(0, 0, 0), Vec3(4, 0, 0)));
  EXPECT_THAT(fibre.sets.at("fibre"), ElementsAre(0u, 1u));
  try {
    part_of(packing, "fiber", "balls.csv");
    FAIL() << "there is no such set";
  } catch (const NoSuchSet& failure) {
    EXPECT_STREQ(failure.what(), "balls.csv has no set 'fiber'. Did you mean 'fibre'?");
  }
}

TEST(PackingFile, reading_can_be_interrupted) {
  EXPECT_THROW(read_packing(file_with("0 0 0 1\n"), {}, [] { throw Interrupted("enough"); }), Interrupted);
}

TEST(PackingFile, a_file_that_is_not_there_is_the_machines_fault) {
  EXPECT_THROW(read_packing("/nowhere/packing.csv", {}), MachineFailure);
  EXPECT_THROW(read_packing("/nowhere/packing.h5", {}), MachineFailure);
}

}  // namespace
}  // namespace beadwork
