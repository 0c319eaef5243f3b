#include "core/loop/quality.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace beadwork {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

QualityFigures told(const Quality& quality) {
  QualityFigures figures;
  quality.tell(figures);
  return figures;
}

TEST(Quality, of_what_is_sound_counts_from_when_it_is_loaded) {
  Quality quality;
  quality.look({.stored = 1, .kinetic = 3, .load = 10, .imbalance = 5, .broken = false});  // the start wave
  quality.look({.stored = 150, .kinetic = 3, .load = 100, .imbalance = 2, .broken = false});
  quality.look({.stored = 400, .kinetic = 2, .load = 200, .imbalance = 1, .broken = false});
  EXPECT_DOUBLE_EQ(told(quality).kinetic, 3.0 / 150);
  EXPECT_DOUBLE_EQ(told(quality).imbalance, 2.0 / 200);
  EXPECT_EQ(told(quality).kinetic_cracking, 0);
}

TEST(WorstLoaded, forgets_what_was_small_once_more_is_stored) {
  WorstLoaded worst;
  worst.note(0, 9);
  EXPECT_EQ(worst.worst(), 0);
  worst.note(1, 7);
  worst.note(0.05, 8);
  EXPECT_EQ(worst.worst(), 7);
  worst.note(5, 2);
  EXPECT_EQ(worst.worst(), 7);
  worst.note(20, 1);
  EXPECT_EQ(worst.worst(), 2);
  worst.note(1e9, 0.5);
  EXPECT_EQ(worst.worst(), 0.5);
}

TEST(Quality, compares_moments_while_it_cracks) {
  Quality quality;
  quality.note_load(200, false);
  quality.look({.stored = 400, .kinetic = 2, .load = 200, .imbalance = 1, .broken = false});
  quality.look({.stored = 300, .kinetic = 6, .load = 150, .imbalance = 3, .broken = true});
  quality.look({.stored = 39, .kinetic = 39, .load = 150, .imbalance = 90, .broken = true});  // hardly loaded any more
  EXPECT_DOUBLE_EQ(told(quality).kinetic, 2.0 / 400);
  EXPECT_DOUBLE_EQ(told(quality).kinetic_cracking, 6.0 / 300);
  EXPECT_DOUBLE_EQ(told(quality).imbalance_cracking, 3.0 / 200);
}

TEST(Quality, leaves_out_what_comes_when_the_specimen_has_failed_and_the_look_just_before) {
  Quality quality;
  quality.note_load(200, false);
  quality.look({.stored = 400, .kinetic = 2, .load = 200, .imbalance = 1, .broken = false});
  quality.look({.stored = 200, .kinetic = 150, .load = 200, .imbalance = 100, .broken = true});  // a wave on its way to the grips
  quality.note_load(19, true);
  quality.look({.stored = 200, .kinetic = 150, .load = 100, .imbalance = 100, .broken = true});
  quality.note_load(100, true);
  EXPECT_EQ(told(quality).kinetic_cracking, 0);
  EXPECT_DOUBLE_EQ(told(quality).kinetic, 2.0 / 400);
}

TEST(Quality, goes_on_where_nothing_broke_and_the_load_is_taken_off) {
  Quality quality;
  quality.note_load(200, false);
  quality.note_load(0, false);
  quality.look({.stored = 400, .kinetic = 2, .load = 0, .imbalance = 0, .broken = false});
  EXPECT_DOUBLE_EQ(told(quality).kinetic, 2.0 / 400);
}

TEST(Quality, is_the_same_after_a_restart) {
  Quality before, after;
  before.note_load(200, false);
  before.look({.stored = 400, .kinetic = 2, .load = 200, .imbalance = 1, .broken = false});
  before.look({.stored = 300, .kinetic = 6, .load = 150, .imbalance = 3, .broken = true});
  before.note_free_motion(2, 8);
  std::vector<Real> kept;
  before.each([&](const std::string&, Real& number) { kept.push_back(number); });
  auto next = kept.begin();
  after.each([&](const std::string&, Real& number) { number = *next++; });
  EXPECT_EQ(quality_json(told(after)).dump(), quality_json(told(before)).dump());
  EXPECT_EQ(told(after).free_motion_share, 0.25);
}

TEST(Quality, is_good_only_when_every_figure_is) {
  EXPECT_EQ(judged({}).word, "good");
  EXPECT_THAT(judged({}).remarks, IsEmpty());
  for (Real QualityFigures::*figure : {&QualityFigures::residual, &QualityFigures::kinetic, &QualityFigures::kinetic_cracking, &QualityFigures::imbalance,
                                       &QualityFigures::imbalance_cracking, &QualityFigures::free_motion_share}) {
    QualityFigures some;
    some.*figure = 0.06;
    EXPECT_NE(judged(some).word, "good");
    EXPECT_THAT(judged(some).remarks, ElementsAre(HasSubstr("is 6 % (good: up to ")));
  }
}

TEST(Quality, of_a_dynamic_scene_is_its_balance) {
  QualityFigures flight{.kinetic = 1, .imbalance = 1, .free_motion_share = 100, .dynamic = true};
  EXPECT_EQ(judged(flight).word, "dynamic");
  EXPECT_THAT(judged(flight).remarks, IsEmpty());
  flight.residual = 0.03;
  EXPECT_EQ(judged(flight).word, "poor");
  EXPECT_EQ(judged({.kinetic = 0.9, .imbalance = 0.8}).word, "dynamic");
  EXPECT_THAT(judged({.kinetic = 0.9, .imbalance = 0.8}).remarks, ElementsAre(HasSubstr("90 %")));
  EXPECT_EQ(judged({.kinetic = 0.9}).word, "poor") << "it moves, and not in waves between what holds it";
}

}  // namespace
}  // namespace beadwork
