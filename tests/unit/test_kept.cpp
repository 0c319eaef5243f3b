#include "core/domain/kept.hpp"

#include <gtest/gtest.h>

#include "core/domain/domain.hpp"

namespace beadwork {
namespace {

TEST(Kept, stands_in_a_row_of_a_column_that_checkpoints_save) {
  Domain domain;
  Table& list = domain.list("watchers");
  list.resize(3);
  Kept last(list, "last-look", "1", "Step", 2);
  last = 7;
  last += 1;
  EXPECT_EQ(list.column("last-look").view<Real>()[2], 8);
  EXPECT_EQ(list.column("last-look").view<Real>()[0], 0);
  EXPECT_TRUE(list.column("last-look").kept());
  EXPECT_EQ(&domain.list("watchers"), &list);
}

TEST(Kept, stays_where_it_is_when_others_come) {
  Domain domain;
  Kept first(domain.scene(), "first", "J", "Energy");
  first = 3;
  for (int k = 0; k < 100; ++k) Kept(domain.scene(), "other-" + std::to_string(k), "J", "Energy") = k;
  EXPECT_EQ(first, 3);
  first = 4;
  EXPECT_EQ(domain.scene().column("first").view<Real>()[0], 4);
}

TEST(Kept, is_a_number_of_its_own_until_it_has_a_place_and_then_what_stands_there) {
  Domain domain;
  Kept(domain.scene(), "n", "1", "Number") = 5;
  Kept number;
  number = 2;
  const Kept copy = number;
  number += 1;
  EXPECT_EQ(copy, 2);
  number.stand_in(domain.scene(), "n", "1", "Number");
  EXPECT_EQ(number, 5);
  Kept same = number;
  same = 6;
  EXPECT_EQ(number, 6);
}

}  // namespace
}  // namespace beadwork
