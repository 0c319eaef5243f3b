#include "core/loop/ledger.hpp"

#include <gtest/gtest.h>

#include "core/domain/domain.hpp"

namespace beadwork {
namespace {

using Verdict = Ledger::Verdict;

EnergySums sums(Real work, Real there) {
  EnergySums all;
  all.work("", work);
  all.stored("", there);
  return all;
}

TEST(Ledger, is_content_with_what_was_brought) {
  Ledger ledger;
  EXPECT_EQ(ledger.look(sums(2, 2), 0, 0, 0), Verdict::balanced);
  EXPECT_EQ(ledger.look(sums(2, 2.019), 0, 0, 0), Verdict::balanced);
  EXPECT_EQ(ledger.look(sums(2, 0), 0, 0, 0), Verdict::balanced);  // lost, not made
  EXPECT_DOUBLE_EQ(ledger.deviation(), 2);
}

TEST(Ledger, warns_from_a_hundredth_of_it_and_stops_what_doubles_it_and_gains_more) {
  Ledger ledger;
  EXPECT_EQ(ledger.look(sums(2, 2.021), 0, 0, 0), Verdict::gains);
  EXPECT_TRUE(ledger.tells());
  EXPECT_FALSE(ledger.tells());
  EXPECT_EQ(ledger.look(sums(2, 4.1), 0, 0, 0), Verdict::runs_away);
  EXPECT_EQ(ledger.look(sums(2, 4.05), 0, 0, 0), Verdict::gains) << "it has gained less than at the look before";
  EXPECT_EQ(ledger.look(sums(2, 4.2), 0, 0, 0), Verdict::runs_away);
}

TEST(Ledger, compares_with_the_largest_that_was_brought_not_with_what_is_left_of_it) {
  Ledger ledger;
  ledger.note_work(5, 0);
  EXPECT_EQ(ledger.look(sums(0, 0.01), 0, 0, 0), Verdict::balanced);
  EXPECT_EQ(ledger.brought(), 5);
  ledger.note_work(-6, 1);
  EXPECT_EQ(ledger.brought(), 7);
}

TEST(Ledger, leaves_the_swing_of_the_scheme_and_round_off_alone) {
  Ledger ledger;
  EXPECT_EQ(ledger.look(sums(1, 3), 0, 2, 0), Verdict::balanced);
  EXPECT_EQ(ledger.deviation(), 0);
  EXPECT_EQ(ledger.look(sums(1, -0.5), 0, 0, 0), Verdict::balanced);
  EXPECT_EQ(ledger.deviation(), 0) << "1.5 less than the 2 by which it may have swung when it began";
  Ledger damped;  // forces of damping make the swing begin below zero
  EXPECT_EQ(damped.look(sums(1, 1), 0, -0.5, 0), Verdict::balanced);
  EXPECT_EQ(damped.look(sums(1, 1.5), 0, 0, 0), Verdict::balanced);
  EXPECT_EQ(damped.look(sums(1, 1.52), 0, 0, 0), Verdict::gains);
  EXPECT_EQ(Ledger().look(sums(0, 1e-30), 0, 0, 1e-29), Verdict::balanced);
  EXPECT_EQ(Ledger().look(sums(0, 1e-28), 0, 0, 1e-29), Verdict::runs_away);
}

TEST(Ledger, knows_what_a_break_costs_by_the_size_of_the_step) {
  Ledger ledger;
  ledger.note_break(0.1, 0.4);
  EXPECT_EQ(ledger.look(sums(2, 1.7), 0, 0, 0), Verdict::balanced);
  EXPECT_NEAR(ledger.deviation(), 0, 1e-15);
  EXPECT_NEAR(ledger.lost_at_breaks(), 0.3, 1e-15);
}

TEST(Ledger, is_the_same_after_a_restart) {
  Domain domain;
  Ledger before(domain.scene());
  before.look(sums(2, 2.5), 0.1, 0.01, 0);
  before.tells();
  before.note_break(0, 0.2);
  for (const Column* column : domain.scene().columns()) EXPECT_TRUE(column->kept()) << column->field().name;
  Ledger after(domain.scene());
  EXPECT_EQ(after.brought(), before.brought());
  EXPECT_EQ(after.gained(), before.gained());
  EXPECT_EQ(after.deviation(), before.deviation());
  EXPECT_EQ(after.lost_at_breaks(), before.lost_at_breaks());
  EXPECT_FALSE(after.tells());
}

}  // namespace
}  // namespace beadwork
