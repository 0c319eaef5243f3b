#include "core/loop/quality.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/io/checkpoint.hpp"
#include "tests/support/scratch.hpp"

namespace beadwork {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::Scratch;

QualityFigures told(const Quality& quality) {
  QualityFigures figures;
  quality.tell(figures, 1);
  return figures;
}

void note(Quality& quality, Real load, bool broken, int steps = 1) {
  quality.follow(1);
  for (int k = 0; k < steps; ++k)
    quality.note_load(
        1, [load](std::size_t) { return load; }, broken);
}

// Full swings about nothing.
void note_swings(Quality& quality, Real load) {
  quality.follow(1);
  for (int k = 0; k < 1000; ++k)
    quality.note_load(
        1, [&](std::size_t) { return load * std::sin(0.1 * k); }, true);
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
  note(quality, 200, false);
  quality.look({.stored = 400, .kinetic = 2, .load = 200, .imbalance = 1, .broken = false});
  quality.look({.stored = 300, .kinetic = 6, .load = 150, .imbalance = 3, .broken = true});
  quality.look({.stored = 39, .kinetic = 39, .load = 150, .imbalance = 90, .broken = true});  // hardly loaded any more
  EXPECT_DOUBLE_EQ(told(quality).kinetic, 2.0 / 400);
  EXPECT_DOUBLE_EQ(told(quality).kinetic_cracking, 6.0 / 300);
  EXPECT_DOUBLE_EQ(told(quality).imbalance_cracking, 3.0 / 200);
}

TEST(Quality, leaves_out_what_comes_when_the_specimen_has_failed_and_the_look_just_before) {
  Quality quality;
  note(quality, 200, false);
  quality.look({.stored = 400, .kinetic = 2, .load = 200, .imbalance = 1, .broken = false});
  quality.look({.stored = 200,
                .kinetic = 150,
                .load = 200,
                .imbalance = 100,
                .broken = true});  // a wave on its way to the grips
  for (int k = 0; k < 3; ++k) {
    note_swings(quality, 200);
    quality.look({.stored = 200, .kinetic = 150, .load = 100, .imbalance = 100, .broken = true});
  }
  EXPECT_EQ(told(quality).kinetic_cracking, 0);
  EXPECT_DOUBLE_EQ(told(quality).kinetic, 2.0 / 400);
}

TEST(Quality, leaves_out_what_was_seen_last_where_the_run_ends_with_the_load) {
  Quality quality;
  note(quality, 200, false);
  quality.look({.stored = 400, .kinetic = 2, .load = 200, .imbalance = 1, .broken = false});
  note(quality, 150, true, 100);
  quality.look({.stored = 200, .kinetic = 150, .load = 200, .imbalance = 100, .broken = true});
  note(quality, 2, true, 10);
  quality.look({.stored = 200, .kinetic = 150, .load = 2, .imbalance = 2, .broken = true});
  EXPECT_EQ(told(quality).kinetic_cracking, 0);
}

TEST(Quality, goes_on_after_a_moment_without_load) {
  Quality quality;
  note(quality, 200, false);
  quality.look({.stored = 400, .kinetic = 2, .load = 200, .imbalance = 1, .broken = false});
  note(quality, 200, true, 499);
  note(quality, 0, true);
  note(quality, 200, true, 500);
  quality.look({.stored = 300, .kinetic = 150, .load = 200, .imbalance = 100, .broken = true});
  EXPECT_DOUBLE_EQ(told(quality).kinetic_cracking, 0.5);
}

TEST(Quality, goes_on_once_it_is_loaded_anew) {
  Quality quality;
  note(quality, 200, false);
  quality.look({.stored = 400, .kinetic = 2, .load = 200, .imbalance = 1, .broken = false});
  note(quality, 5, true, 1000);
  quality.look({.stored = 2, .kinetic = 0, .load = 5, .imbalance = 0, .broken = true});
  note(quality, 300, true, 40);  // at once, and hard
  quality.look({.stored = 100, .kinetic = 110, .load = 300, .imbalance = 100, .broken = true});
  EXPECT_DOUBLE_EQ(told(quality).kinetic_cracking, 1.1);
}

TEST(Quality, goes_on_where_nothing_broke_and_the_load_is_taken_off) {
  Quality quality;
  note(quality, 200, false);
  note(quality, 0, false, 1000);
  quality.look({.stored = 400, .kinetic = 2, .load = 0, .imbalance = 0, .broken = false});
  EXPECT_DOUBLE_EQ(told(quality).kinetic, 2.0 / 400);
}

TEST(Quality, is_the_same_after_a_restart) {
  const Scratch scratch;
  Domain saved, loaded;
  Quality before(saved, 1);
  note(before, 200, false);
  before.look({.stored = 400, .kinetic = 2, .load = 200, .imbalance = 1, .broken = false});
  before.look({.stored = 300, .kinetic = 6, .load = 150, .imbalance = 3, .broken = true});
  note(before, 15, true, 60);
  before.note_free_motion(2, 8);
  save_checkpoint(scratch / "c.h5", saved, {});
  Quality after(loaded, 1);
  load_checkpoint(scratch / "c.h5", loaded);
  EXPECT_EQ(quality_json(told(after)).dump(), quality_json(told(before)).dump());
  EXPECT_EQ(told(after).free_motion_share, 0.25);
  for (Quality* each : {&before, &after}) {
    note(*each, 15, true, 40);
    each->look({.stored = 300, .kinetic = 9, .load = 150, .imbalance = 3, .broken = true});
    EXPECT_EQ(told(*each).kinetic_cracking, 0) << "its mean load is too little";
  }
}

TEST(Quality, compares_a_free_motion_with_the_farthest_prescribed_one) {
  Quality quality;
  quality.note_free_motion(0, 0);
  quality.note_free_motion(2, 50);
  quality.note_free_motion(3, 1e-6);  // back again
  EXPECT_DOUBLE_EQ(told(quality).free_motion_share, 3.0 / 50);
  Quality pushed;
  pushed.note_free_motion(3, 0);
  EXPECT_DOUBLE_EQ(told(pushed).free_motion_share, 3) << "of the mean radius, where nothing is prescribed to move";
}

TEST(Quality, of_what_no_look_saw_is_not_judged) {
  Quality quality;
  note(quality, 200, false);
  quality.look({.stored = 0, .kinetic = 0, .load = 0, .imbalance = 0, .broken = false});
  note(quality, 200, true, 1000);
  quality.look({.stored = 300, .kinetic = 6, .load = 150, .imbalance = 3, .broken = true});
  EXPECT_TRUE(told(quality).unseen);
  EXPECT_EQ(judged(told(quality)).word, "not judged");
  EXPECT_THAT(judged(told(quality)).remarks, ElementsAre(HasSubstr("whether it was slow enough is not known")));
  EXPECT_EQ(judged({.residual = 0.01, .unseen = true}).word, "not judged");
  EXPECT_EQ(judged({.kinetic_cracking = 0.9, .unseen = true}).word, "poor");
  EXPECT_EQ(judged({.dynamic = true, .unseen = true}).word, "dynamic");
}

TEST(Quality, is_good_only_when_every_figure_is) {
  EXPECT_EQ(judged({}).word, "good");
  EXPECT_THAT(judged({}).remarks, IsEmpty());
  for (Real QualityFigures::*figure :
       {&QualityFigures::residual, &QualityFigures::kinetic, &QualityFigures::kinetic_cracking,
        &QualityFigures::imbalance, &QualityFigures::imbalance_cracking, &QualityFigures::free_motion_share}) {
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
}

TEST(Quality, of_a_worse_run_is_no_better) {
  EXPECT_EQ(judged({.kinetic = 0.9}).word, "poor");
  EXPECT_EQ(judged({.kinetic = 0.9, .imbalance = 0.8}).word, "poor");
  EXPECT_THAT(judged({.kinetic = 0.9, .imbalance = 0.8}).remarks,
              ElementsAre(HasSubstr("90 %"), HasSubstr("80 %"), HasSubstr("looks like waves")));
}

TEST(Quality, of_what_rang_and_came_to_rest_is_fair_unless_something_broke) {
  Quality quality;
  quality.look({.stored = 100, .kinetic = 50, .load = 10, .imbalance = 9});
  EXPECT_EQ(judged(told(quality)).word, "poor");
  quality.look({.stored = 100, .kinetic = 0.5, .load = 10, .imbalance = 0.1});
  EXPECT_EQ(judged(told(quality)).word, "fair");
  quality.look({.stored = 90, .kinetic = 0.5, .load = 10, .imbalance = 0.1, .broken = true});
  EXPECT_EQ(judged(told(quality)).word, "poor");
}

TEST(Quality, of_a_run_that_failed_is_never_good) {
  QualityFigures figures;
  figures.failed = true;
  EXPECT_EQ(judged(figures).word, "not judged");
  figures.dynamic = true;
  EXPECT_EQ(judged(figures).word, "not judged");
  figures.residual = 1;
  EXPECT_EQ(judged(figures).word, "poor");
}

TEST(Quality, tells_what_breaks_lost_by_the_size_of_the_step) {
  QualityFigures figures;
  figures.lost_at_breaks = 0.04;
  EXPECT_EQ(judged(figures).word, "good");
  figures.lost_at_breaks = 0.06;
  EXPECT_EQ(judged(figures).word, "fair");
}

}  // namespace
}  // namespace beadwork
