#include "core/io/packing_file.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/base/failure.hpp"

namespace beadwork {
namespace {

std::filesystem::path file_with(const std::string& text) {
  const auto file = std::filesystem::temp_directory_path() / ("packing-" + std::to_string(::getpid()) + ".csv");
  std::ofstream(file) << text;
  return file;
}

std::string refusal_of(const std::string& text) {
  try {
    read_packing(file_with(text), 1);
  } catch (const DeckFailure& failure) {
    return failure.what();
  }
  return "";
}

TEST(PackingFile, lines_of_four_numbers_are_elements_in_the_unit_asked_for) {
  const StoredPacking packing = read_packing(file_with("x,y,z,r\n# two of them\n0,0,0,1\n2 0.5 -1 0.75\n"), 1e-3);
  ASSERT_EQ(packing.position.size(), 2u);
  EXPECT_EQ(packing.position[1], Vec3(2e-3, 0.5e-3, -1e-3));
  EXPECT_EQ(packing.radius[1], 0.75e-3);
}

TEST(PackingFile, names_of_columns_come_first_or_behind_remarks) {
  EXPECT_EQ(read_packing(file_with("\n# places\nx [m], y [m], z [m], r [m]\n0,0,0,1\n"), 1).position.size(), 1u);
  EXPECT_NE(refusal_of("0 0 0 1\nx y z r\n").find(":2: error"), std::string::npos);
  EXPECT_NE(refusal_of("x y z r\nin mm and mm\n0 0 0 1\n").find(":2: error"), std::string::npos);
}

TEST(PackingFile, a_first_element_with_a_slip_is_not_taken_for_names) {
  EXPECT_NE(refusal_of("O,0,0,1\n2,0,0,1\n").find(":1: error: a line holds four numbers"), std::string::npos);
  EXPECT_NE(refusal_of("0,5;0;0;1\n").find(":1: error"), std::string::npos);
}

TEST(PackingFile, the_mark_that_spreadsheets_put_first_costs_no_element) {
  EXPECT_EQ(read_packing(file_with("\xEF\xBB\xBF" "0,0,0,1\r\n2,0,0,1\r\n"), 1).position.size(), 2u);
  EXPECT_EQ(read_packing(file_with("\xEF\xBB\xBF" "x,y,z,r\r\n0,0,0,1\r\n2,0,0,1\r\n"), 1).position.size(), 2u);
}

TEST(PackingFile, a_line_that_is_no_element_is_named) {
  EXPECT_NE(refusal_of("0 0 0 1\n1 2 3\n").find(":2: error: a line holds four numbers"), std::string::npos);
  EXPECT_NE(refusal_of("0 0 0 1\n1 2 3 r\n").find(":2: error"), std::string::npos);
}

TEST(PackingFile, elements_without_extent_and_empty_files_are_refused) {
  EXPECT_NE(refusal_of("0 0 0 -1\n").find("element 0"), std::string::npos);
  EXPECT_NE(refusal_of("# nothing\n").find("no element"), std::string::npos);
}

TEST(PackingFile, a_file_that_is_not_there_is_the_machines_fault) {
  EXPECT_THROW(read_packing("/nowhere/packing.csv", 1), MachineFailure);
  EXPECT_THROW(read_packing("/nowhere/packing.h5", 1), MachineFailure);
}

}  // namespace
}  // namespace beadwork
