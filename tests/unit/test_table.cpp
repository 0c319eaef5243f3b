// Columns: where each number stands, also in tables of more than 2^31 bytes.

#include "core/domain/table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <fstream>

#include "core/domain/domain.hpp"
#include "core/domain/vocabulary.hpp"

namespace beadwork {
namespace {

constexpr std::size_t two_to_the_31 = std::size_t{1} << 31;

/// Bytes of the process that lie in memory.
std::size_t resident() {
  std::ifstream file("/proc/self/statm");
  std::size_t all = 0, there = 0;
  file >> all >> there;
  return there * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

Vec3 mark(Index row) { return {Real(row), Real(row) + 0.25, Real(row) + 0.5}; }

// Rows that 32 bits of an offset could not tell apart, and those at both ends.
std::vector<Index> telling_rows(Index rows, std::size_t bytes_a_row) {
  const auto wrapped = static_cast<Index>(two_to_the_31 / bytes_a_row);
  return {0, 1, wrapped - 1, wrapped, wrapped + 1, rows - 2, rows - 1};
}

void write_and_read_back(Table& table, const std::vector<Index>& rows) {
  const auto position = table.column("position").view<Vec3>();
  const auto orientation = table.column("orientation").view<Quat>();
  for (const Index row : rows) {
    position.set(row, mark(row));
    orientation.set(row, {Real(row), mark(row)});
  }
  for (const Index row : rows) {
    EXPECT_EQ(position[row], mark(row)) << row;
    EXPECT_EQ(orientation[row].w, Real(row)) << row;
    EXPECT_EQ(orientation[row].v, mark(row)) << row;
  }
  EXPECT_EQ(position[rows[1] + 1], zero<Vec3>()) << "a row far behind was written to one in front";
}

template <class V>
concept its_row_can_be_added_to = requires(V view) {
  view[0] += Vec3(1, 0, 0);
};
template <class V>
concept its_row_can_be_set = requires(V view) {
  view[0] = 1.0;
};

TEST(View, tells_vectors_and_lends_numbers) {
  static_assert(!its_row_can_be_added_to<View<Vec3>>, "what is told is a copy: adding to it would be lost");
  static_assert(its_row_can_be_set<View<Real>>);
  static_assert(!its_row_can_be_set<View<const Real>>);
}

TEST(View, adds_to_every_component_of_a_tensor) {
  Table table(Table::Layout::planes);
  Column& column = table.add({"stress", On::bonds, Type::sym3, "Pa", "Stress", ""});
  table.resize(3);
  const auto stress = column.view<Sym3>();
  stress.set(1, {1, 2, 3, 4, 5, 6});
  stress.add(1, {10, 20, 30, 40, 50, 60});
  const Sym3 sum = stress[1];
  EXPECT_THAT((std::array{sum.xx, sum.xy, sum.xz, sum.yy, sum.yz, sum.zz}),
              ::testing::ElementsAre(11, 22, 33, 44, 55, 66));
  EXPECT_EQ(Sym3(stress[0]).zz + Sym3(stress[2]).xx, 0);
}

TEST(Table, holds_its_numbers_in_a_line_of_more_than_2_to_the_31_bytes) {
  const std::size_t before = resident();
  Table table(Table::Layout::rows);
  table.add(field::position);
  table.add(field::orientation);
  constexpr Index rows = 40'000'000;
  table.resize(rows);
  ASSERT_GT(table.memory(), two_to_the_31);
  write_and_read_back(table, telling_rows(rows, table.column("position").stride()));
  EXPECT_LT(resident(), before + (std::size_t{64} << 20)) << "pages that nobody wrote to take memory";
}

TEST(Table, holds_its_numbers_in_planes_of_more_than_2_to_the_31_bytes) {
  const std::size_t before = resident();
  Table table(Table::Layout::planes);
  table.add(field::position);
  table.add(field::orientation);
  constexpr Index rows = 100'000'000;
  table.resize(rows);
  ASSERT_GT(3 * table.column("orientation").plane(), two_to_the_31);
  write_and_read_back(table, telling_rows(rows, 3 * sizeof(Real)));
  const Index last[] = {rows - 1, rows - 2};
  table.permute_range(rows - 2, last);
  EXPECT_EQ(table.column("position").view<Vec3>()[rows - 1], mark(rows - 2));
  EXPECT_EQ(table.column("orientation").view<Quat>()[rows - 2].w, Real(rows - 1));
  EXPECT_LT(resident(), before + (std::size_t{64} << 20)) << "pages that nobody wrote to take memory";
}

TEST(Table, keeps_the_rows_through_growing_a_new_neighbour_in_the_line_and_a_new_order) {
  Table table(Table::Layout::rows);
  table.add(field::position);
  table.resize(3);
  for (Index row = 0; row < 3; ++row) table.column("position").view<Vec3>().set(row, mark(row));
  table.resize(4);
  table.add(field::orientation);  // it shares the line
  table.reserve_beyond("pose", 2);
  const Index order[] = {2, 0};
  table.permute(order);
  ASSERT_EQ(table.size(), 2);
  EXPECT_EQ(table.column("position").view<Vec3>()[0], mark(2));
  EXPECT_EQ(table.column("position").view<Vec3>()[1], mark(0));
  EXPECT_EQ(table.column("orientation").view<Quat>()[1].v, zero<Vec3>());
}

// Each element has a row, each of up to twelve bonds an id and at most a row beyond the elements.
TEST(Domain, can_number_the_bonds_of_the_most_elements) {
  EXPECT_LE((1 + 12) * std::int64_t{most_elements}, std::int64_t{std::numeric_limits<Index>::max()});
}

}  // namespace
}  // namespace beadwork
